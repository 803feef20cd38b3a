//! The poses of A and B for one query, and sets of them.

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use crate::pose::Pose;

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

/// The oracle's answer for one configuration.
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
    /// Where; a colliding configuration names one intersecting pair.
    pub witness: Witness,
    /// Whether exact arithmetic was needed.
    pub exact_used: bool,
}

/// A configuration with its truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placed {
    /// The poses.
    pub configuration: Configuration,
    /// The oracle's answer.
    pub truth: Truth,
    /// Which root along its ray (0 = the first position found from outside).
    pub root_index: u32,
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
    /// Read from a file.
    File {
        /// Content hash (SHA-256, hex) of the file.
        sha256: String,
    },
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

/// The sampled configurations of a scene at one relative distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConfigurationSet {
    /// How they were found.
    pub method: Method,
    /// Surface-to-surface distance divided by `longest_side`.
    pub relative_distance: f64,
    /// L: the longest side of A's bounding box.
    pub longest_side: f64,
    /// The configurations with their truth, in the set's own order.
    pub placed: Vec<Placed>,
    /// Rays on which no position was found (B never came that close).
    pub missed_rays: u32,
}
