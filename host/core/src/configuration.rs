//! The poses of A and B for one query, and sets of them.

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use crate::oracle::U64;
use crate::pose::Pose;
use crate::query::Semantics;
use crate::validation::Precision;

/// The poses of A and B for one query: a point of the pair's configuration space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Configuration {
    /// Pose of object A.
    pub pose_a: Pose,
    /// Pose of object B.
    pub pose_b: Pose,
}

/// A pair of points, one on each object (world frame), that realises the distance, and the triangles they lie on.
///
/// For colliding configurations: an intersecting pair of triangles and one common point twice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Witness {
    /// Point on A.
    pub point_a: Point3<f64>,
    /// Point on B.
    pub point_b: Point3<f64>,
    /// Triangle of A.
    pub triangle_a: u32,
    /// Triangle of B.
    pub triangle_b: u32,
}

/// What may be asked of an answer at one precision: `CLEAR` and `COLLIDING` are scored, `GRAZING` is reported only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Class {
    /// Distance certainly above tau.
    Clear,
    /// The crossing certainly survives any perturbation by tau.
    Colliding,
    /// Neither: touching, coplanar, or closer to the decision than the precision can tell.
    Grazing,
}

/// Is a closed object, or a part of it that hangs together, wholly inside the other? Asked where the surfaces do not meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Containment {
    /// Neither; as solid bodies the objects are apart, too.
    Apart,
    /// A part of A is inside B.
    AInB,
    /// A part of B is inside A.
    BInA,
    /// Both: nested parts of either object.
    Both,
}

impl Containment {
    /// Every case with its name in files.
    pub const NAMES: [(Self, &'static str); 4] =
        [(Self::Apart, "apart"), (Self::AInB, "a_in_b"), (Self::BInA, "b_in_a"), (Self::Both, "both")];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }
}

/// The oracle's answer for one configuration, about the surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Do the surfaces meet (closed triangles, touching counts).
    pub hit: bool,
    /// Lower bound of the distance; 0 when `hit`.
    pub distance_lo: f64,
    /// Upper bound of the distance; 0 when `hit`.
    pub distance_hi: f64,
    /// How far every vertex may move and the crossing still holds (lower bound); 0 when not `hit`.
    pub margin: f64,
    /// Class for plugins that compute in f64.
    pub class64: Class,
    /// Class for plugins that compute in f32.
    pub class32: Class,
    /// Certified; absent when it is no question: the surfaces meet, or an object is not closed.
    #[serde(default)]
    pub containment: Option<Containment>,
    /// Where; a colliding configuration names one intersecting pair.
    pub witness: Witness,
    /// Whether exact arithmetic was needed.
    pub exact_used: bool,
}

impl Truth {
    /// Does one body lie inside the other, in a scene that asks for solid ones?
    pub fn is_inside(&self, semantics: Semantics) -> bool {
        semantics == Semantics::Solid && !matches!(self.containment, None | Some(Containment::Apart))
    }

    /// By how much a distance misses the certified interval of what the scene asks; 0 inside it.
    pub fn distance_error(&self, distance: f64, semantics: Semantics) -> f64 {
        let [lo, hi] = if self.is_inside(semantics) { [0.0; 2] } else { [self.distance_lo, self.distance_hi] };
        (lo - distance).max(distance - hi).max(0.0)
    }
}

/// A configuration with its truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placed {
    /// The poses.
    pub configuration: Configuration,
    /// The oracle's answer.
    pub truth: Truth,
    /// The same about the objects with their coordinates rounded to single precision; absent where no coordinate changes,
    /// or nothing of an object is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounded: Option<Truth>,
    /// 0: the first position from outside on the ray through the centres of both bounding boxes; 1: a further one.
    pub root_index: u32,
    /// What was looked for; `None` where the pose was given.
    pub wanted: Option<Separation>,
}

impl Placed {
    /// The same with the truth about the numbers that an algorithm of this arithmetic gets.
    pub fn seen_in(&self, precision: Precision) -> Self {
        match (precision, self.rounded) {
            (Precision::Single, Some(truth)) => Self { truth, ..*self },
            (Precision::Single, None) | (Precision::Double, _) => *self,
        }
    }
}

/// How far apart, or how deep in each other, the surfaces shall be.
///
/// Each configuration of a set aims at a place of its own in the window, so that no distance is right for all of them.
///
/// One rule for all: a wanted *step* `x` of the scene's size S ([`Pair::scene_size`](crate::oracle::Pair::scene_size))
/// is met by a certified value in `(x S, 2 x S]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Separation {
    /// So far apart, as a share of L (the longest side of A's bounding box), within 1 % of it or `tau32`, whichever is
    /// more; at 0 the certified distance is in `(2 tau32, 4 tau32]`, the step `2 tau32 / S`, so that the question is fair
    /// even in single precision.
    Relative {
        /// Surface distance divided by L; at least 0.
        distance: f64,
    },
    /// A share `x` of the scene's size S. Above 0: the certified distance is in `(x S, 2 x S]`. Below 0: the objects
    /// cross, with a certified margin in `(|x| S, 2 |x| S]` where that can be reached.
    Step {
        /// `x`; its size is at least [`Separation::SMALLEST_STEP`].
        of_size: f64,
    },
    /// The [`Separation::LADDER`] of steps, one configuration each in turn.
    Ladder,
}

impl Separation {
    /// `2 tau64 / S`: what an algorithm in f64 must still be able to tell from touching.
    pub const SMALLEST_STEP: f64 = 64.0 * U64;
    /// The largest step.
    pub const LARGEST_STEP: f64 = 0.1;
    /// The steps on which the resolution of decisions is measured, apart and crossing in turn.
    pub const LADDER: [f64; 10] =
        [1e-2, -1e-2, 1e-4, -1e-4, 1e-6, -1e-6, 1e-8, -1e-8, Self::SMALLEST_STEP, -Self::SMALLEST_STEP];

    /// What configuration `index` shall meet: a distance or a step.
    pub fn of(self, index: u64) -> Self {
        match self {
            Self::Ladder => Self::Step { of_size: Self::LADDER[(index % Self::LADDER.len() as u64) as usize] },
            one => one,
        }
    }
}

/// How the configurations of a set were found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Method {
    /// B comes from a sphere around A until the relative distance is met [OpenCollBench 2020, 3.1].
    Sphere {
        /// How directions and rotations are chosen.
        sampling: Sampling,
        /// Seed of the low-discrepancy sequences.
        #[serde(default)]
        seed: u64,
    },
    /// B stands at every free node of a grid around A and is moved to the separation from there, so that concavities and
    /// further roots are reached [Trenkel 2007].
    Grid {
        /// How rotations and the grid's spacing are chosen.
        sampling: Sampling,
        /// Seed of the low-discrepancy sequences.
        #[serde(default)]
        seed: u64,
    },
    /// B tumbles about z and x at a fixed distance of the centres; the order is kept [Zachmann 1998].
    Trajectory {
        /// Distance of the bounding boxes' centres divided by L.
        center_distance: f64,
        /// Number of frames of the full turn.
        #[serde(default = "published_frames")]
        count: u32,
    },
    /// B anywhere and anyhow in a cube around A, of which a share collides [van den Bergen 1997].
    Random {
        /// Number of poses.
        count: u32,
        /// Share of poses that collide; the cube is chosen for it.
        hit_share: f64,
        /// Seed of the low-discrepancy sequence.
        #[serde(default)]
        seed: u64,
    },
    /// Read from a file.
    File {
        /// Content hash (SHA-256, hex) of the file.
        sha256: String,
    },
}

/// Zachmann's run.
fn published_frames() -> u32 {
    5000
}

/// How many directions and rotations, and in which pattern.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Sampling {
    /// As many low-discrepancy samples as the paper's steps would give.
    Steps {
        /// Rotate-by, degrees.
        rotate: f64,
        /// Move-by, degrees.
        #[serde(rename = "move")]
        move_by: f64,
    },
    /// The paper's own pattern: latitude and longitude by `move`, Euler angles by `rotate` (degrees).
    PaperCompat {
        /// Rotate-by, degrees.
        rotate: f64,
        /// Move-by, degrees.
        #[serde(rename = "move")]
        move_by: f64,
    },
    /// So many low-discrepancy samples.
    Count {
        /// Number of configurations.
        count: u32,
    },
}

/// The sampled configurations of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConfigurationSet {
    /// How they were found.
    pub method: Method,
    /// How far apart the surfaces shall be; `None` where the method does not ask for it.
    pub separation: Option<Separation>,
    /// L: the longest side of A's bounding box.
    pub longest_side: f64,
    /// The configurations with their truth, in the set's own order.
    pub placed: Vec<Placed>,
    /// Rays on which no position was found (B never came that close).
    pub missed_rays: u32,
    /// Side of the cube of [`Method::Random`], in the objects' lengths.
    pub box_side: Option<f64>,
    /// Distance between the nodes of [`Method::Grid`], in the objects' lengths.
    pub spacing: Option<f64>,
}
