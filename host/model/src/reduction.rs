//! No more model than a recording needs: what stands for each object of its scene, and what that does to answers.

mod frontier;

use ocb_advice::Share;
use ocb_chart::Chart;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::WorkloadResult;
pub use frontier::frontier;

/// What a reduced scene may do to answers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ReduceTerms {
    /// An answer may be the right one for a distance that differs from the true one by this, in the unit of the scene.
    pub tolerance: f64,
    /// The same holds for every query of which one object, with what stands for it, is moved relative to the other by less than
    /// this, in the unit of the scene; less than half of the tolerance.
    #[serde(default)]
    pub near: f64,
    /// Whatever stands for an object contains it, so that no collision is ever missed.
    #[serde(default)]
    pub outside_only: bool,
    /// Also choose and measure bodies for a half, a quarter and an eighth of the tolerance, and for two, four and eight times as much,
    /// with neighbourhoods in proportion.
    #[serde(default)]
    pub frontier: bool,
}

/// The other tolerances of a frontier, in tolerances.
pub const FRONTIER: [f64; 6] = [0.125, 0.25, 0.5, 2.0, 4.0, 8.0];

impl ReduceTerms {
    /// How many replays about bodies a reduction measures.
    pub fn replays(&self) -> usize {
        2 + if self.frontier { FRONTIER.len() } else { 0 }
    }

    /// The same for another tolerance.
    pub fn times(&self, factor: f64) -> Self {
        Self { tolerance: factor * self.tolerance, near: factor * self.near, ..*self }
    }

    /// # Errors
    /// What is wrong with them, in one sentence.
    pub fn check(&self) -> Result<(), String> {
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            return Err("The tolerance must be a positive length.".to_owned());
        }
        if !(self.near >= 0.0 && 2.0 * self.near < self.tolerance) {
            return Err("The neighbourhood must be 0 or more, and less than half of the tolerance.".to_owned());
        }
        Ok(())
    }
}

/// A reduced scene, certified for each recorded query.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Reduction {
    /// Largest change of a distance, in the unit of the scene; a yes-or-no answer is right for such a distance.
    pub tolerance: f64,
    /// The same holds where one object, with what stands for it, is moved relative to the other by less than this.
    pub near: f64,
    /// Does everything contain the object that it stands for?
    pub outside_only: bool,
    /// The objects, in the order of the scene.
    pub objects: Vec<ReducedObject>,
    /// Recorded queries that were certified, about the objects and about what stands for them.
    pub queries: u64,
    /// Queries that were left out because a pose is no rotation.
    pub left_out: u64,
    /// Queries in which the objects certainly collide.
    pub hits: u64,
    /// Those of them in which what stands for the objects is apart, by less than the tolerance.
    pub grazing: u64,
    /// The largest change of a distance that was asked for, as far as it is certain; absent where none was asked.
    pub largest_change: Option<f64>,
    /// The choice without the last fifth of the recording, asked about that fifth; absent for very short recordings.
    pub held_out: Option<LaterQueries>,
}

/// The kinds of bodies that stand for objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum BodyKind {
    /// The object itself.
    Object,
    /// A ball around it.
    Sphere,
    /// A capsule around it.
    Capsule,
    /// A box around it.
    Box,
    /// Its convex hull.
    Hull,
    /// Convex hulls of a few parts.
    Hulls,
    /// A mesh with fewer triangles, near its surface or around it.
    Level,
}

/// What stands for an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ReducedObject {
    /// Its name.
    pub name: String,
    /// What stands for it.
    pub body: BodyKind,
    /// Elements of the object: triangles; 1 for a ball, 2 for a capsule, 6 for a box or a cylinder.
    pub before: u64,
    /// Elements of what stands for it.
    pub after: u64,
    /// Queries about it.
    pub queries: u64,
}

/// Later queries, which the choice had not seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LaterQueries {
    /// How many.
    pub queries: u64,
    /// Those whose answer changed by more than the tolerance.
    pub changed: Share,
    /// Those of them in which a certain collision was missed.
    pub missed: u64,
    /// The worst of them.
    pub examples: Vec<ChangedAnswer>,
}

/// A query whose answer changed by more than the tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ChangedAnswer {
    /// Its place in the recording, from 0.
    pub row: u32,
    /// The objects.
    pub objects: [u32; 2],
    /// Their distance is in here.
    pub distance: [f64; 2],
    /// The distance of what stands for them is in here.
    pub reduced: [f64; 2],
    /// A certain collision was missed.
    pub missed: bool,
}

impl ChangedAnswer {
    /// By how much the distance changed at most.
    pub fn off(&self) -> f64 {
        (self.reduced[1] - self.distance[0]).max(self.distance[1] - self.reduced[0])
    }
}

/// A reduced scene, and what algorithms gain by it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ReducedScene {
    /// The scene.
    #[serde(flatten)]
    pub reduction: Reduction,
    /// What the reduced scene saves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub speed: Vec<ReducedSpeed>,
    /// Speed against tolerance, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frontier: Option<Chart>,
}

/// An algorithm on both scenes. Each was replayed twice, in the order objects, bodies, bodies, objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ReducedSpeed {
    /// Algorithm id.
    pub algorithm: String,
    /// Mean time of a query about the objects, nanoseconds; absent, as the next two, if not every replay was complete.
    pub before_ns: Option<f64>,
    /// Mean time of a query about what stands for them, nanoseconds.
    pub after_ns: Option<f64>,
    /// How many times faster, of either half of the replays.
    pub faster: Option<[f64; 2]>,
    /// Wrong answers about what stands for them.
    pub wrong: u64,
}

impl ReducedSpeed {
    /// Of each algorithm, in the first order of these replays: of the objects, of what stands for them twice, and of the objects
    /// again, all of them with the same algorithms.
    pub fn of(replays: [&WorkloadResult; 4]) -> Vec<Self> {
        let algorithms = replays.map(|replay| &replay.tracks[0].algorithms[..]);
        (0..algorithms[0].len()).map(|at| Self::compared(algorithms.map(|all| &all[at]))).collect()
    }

    fn compared(all: [&crate::AlgorithmOnWorkload; 4]) -> Self {
        // Means over different queries are not compared.
        let complete = all.iter().all(|it| it.n == it.of);
        let means = all.map(|it| it.total.filter(|_| complete).map(|total| total.ns / it.n as f64));
        let times = match means {
            [Some(first), Some(second), Some(third), Some(last)] => Some([first, second, third, last]),
            _ => None,
        };
        Self {
            algorithm: all[0].algorithm.clone(),
            before_ns: times.map(|[first, .., last]| f64::midpoint(first, last)),
            after_ns: times.map(|[_, second, third, _]| f64::midpoint(second, third)),
            faster: times.map(|[first, second, third, last]| [first / second, last / third]),
            wrong: all[1].wrong.max(all[2].wrong),
        }
    }
}
