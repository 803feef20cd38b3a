//! A recording that was replayed: what the recorded program was answered, and what each algorithm does with its queries.

mod heatmap;
mod order;
mod scene;

use ocb_core::workload::Claim;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::outcome::OutcomeInfo;
use crate::reduction::ReducedScene;
use crate::workload_job::Timeline;

pub use heatmap::{ObjectHeatmap, ObjectHeatmapRequest, ObjectMeasure};
pub use order::{OrderGain, order_gains};
pub use scene::{PosedScene, ScenePair};

/// In which order the queries are put, and to how many processes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Track {
    /// Pair by pair of objects, in another order in each process.
    Shuffled,
    /// Pair by pair, as recorded: algorithms may use that a query is like the one before.
    Recorded,
    /// All as recorded, to one process that has loaded every object once. Only for algorithms that offer `ocb.scene/1`.
    Scene,
}

/// A replayed recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorkloadResult {
    /// The recorded program.
    pub program: String,
    /// Its libraries, with their versions.
    pub libraries: Vec<String>,
    /// The objects of the scene.
    pub objects: Vec<WorkloadObject>,
    /// Queries that the recorder saw.
    pub seen: u64,
    /// Queries that were replayed.
    pub queries: u64,
    /// Queries that were seen and not replayed, by reason.
    pub left_out: Vec<LeftOut>,
    /// Groups of the queries: robot states, planner calls or simulation steps.
    pub groups: u64,
    /// Replayed queries whose objects certainly collide, as surfaces.
    pub hits: u64,
    /// The program's own answers.
    pub recorded: RecordedAnswers,
    /// What each algorithm does, in each order.
    pub tracks: Vec<TrackResult>,
    /// The same along the recording.
    pub timeline: Timeline,
    /// What the order of the recording is worth to each algorithm that was asked everything in both orders, the largest gain
    /// first.
    #[serde(default)]
    pub order_gains: Vec<OrderGain>,
    /// The simplest scene that keeps the answers, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedScene>,
    /// Processes per algorithm, order and pair of objects; for a whole scene, per algorithm.
    pub passes: u32,
    /// Seed of the orders and of the equivalent instances.
    pub seed: u64,
}

/// An object of the scene, as algorithms get it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorkloadObject {
    /// Its name in the scene.
    pub name: String,
    /// Number of triangles.
    pub triangles: u64,
    /// For a primitive: the triangles enclose it, and none of them is further from its surface; in the unit of the scene.
    pub bound: Option<f64>,
}

/// Queries that were left out for one reason.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = QueriesLeftOut)]
pub struct LeftOut {
    /// Why.
    pub reason: String,
    /// How many.
    pub count: u64,
}

/// What the recorded program was answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecordedAnswers {
    /// Answers by what they are worth; those that do not occur are left out.
    pub claims: Vec<ClaimCount>,
    /// Largest amount by which a distance misses the truth; in the unit of the scene.
    pub largest_error: f64,
    /// The first false answers, missed collisions first.
    pub false_answers: Vec<FalseAnswer>,
    /// How long the program's library took, in seconds, where that was recorded for every query.
    pub seconds: Option<f64>,
}

/// Count of one claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ClaimCount {
    /// What the answers are worth.
    pub claim: Claim,
    /// How many.
    pub count: u64,
}

/// A false answer in the recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FalseAnswer {
    /// Number of the query in the recording.
    pub sequence: u64,
    /// The objects, by their place in the scene.
    pub objects: [u32; 2],
    /// In what it is false.
    pub claim: Claim,
    /// The distance that was answered.
    pub answered: Option<f64>,
    /// The certified interval of the distance; 0 for a collision.
    pub distance: [f64; 2],
}

/// All algorithms in one order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TrackResult {
    /// The order.
    pub track: Track,
    /// One entry per algorithm.
    pub algorithms: Vec<AlgorithmOnWorkload>,
}

/// One algorithm on the queries of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AlgorithmOnWorkload {
    /// Algorithm id.
    pub algorithm: String,
    /// Display name.
    pub name: String,
    /// Queries of the kinds that it answers.
    pub of: u64,
    /// Those that it was asked before its budget ended, or it did.
    pub n: u64,
    /// Time of these queries together.
    pub total: Option<TotalTime>,
    /// Time to build the structures of all objects, nanoseconds: median over the processes. Once per pair; of a whole scene, once.
    pub build_ns: f64,
    /// Wrong answers.
    pub wrong: u64,
    /// Collisions that it missed; part of `wrong`.
    pub missed: u64,
    /// Answers that cannot be scored in its precision.
    pub undecided: u64,
    /// Queries on which it gave up, or which it did not support after all.
    pub silent: u64,
    /// Time of a group: median, 95th percentile and most, nanoseconds. Only groups of which every query was asked.
    pub groups: Option<GroupTimes>,
    /// Each pair of objects, the most expensive first.
    pub pairs: Vec<PairTime>,
    /// Pairs, or the whole scene, on which its process ended before all was asked.
    pub ended: Vec<EndedPair>,
}

/// A sum of times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TotalTime {
    /// Sum of the medians over the processes, nanoseconds.
    pub ns: f64,
    /// Smallest sum of one round of processes.
    pub lowest_ns: f64,
    /// Largest sum of one round of processes.
    pub highest_ns: f64,
}

/// Distribution of the time of a group.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GroupTimes {
    /// How many groups.
    pub n: u64,
    /// Median, nanoseconds.
    pub median_ns: f64,
    /// 95th percentile.
    pub p95_ns: f64,
    /// Maximum.
    pub max_ns: f64,
    /// The group that took so long.
    pub worst: u64,
}

/// One pair of objects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PairTime {
    /// The objects, by their place in the scene.
    pub objects: [u32; 2],
    /// Queries asked.
    pub n: u64,
    /// Of these, certainly colliding.
    pub hits: u64,
    /// Wrong answers.
    pub wrong: u64,
    /// Time of the queries together, nanoseconds.
    pub ns: f64,
}

/// Where a process ended early.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct EndedPair {
    /// The objects, by their place in the scene; absent when it held the whole scene.
    pub objects: Option<[u32; 2]>,
    /// How it ended.
    pub outcome: OutcomeInfo,
}

impl AlgorithmOnWorkload {
    /// It answered all queries that it can be asked, none of them wrongly: its time may be compared.
    pub fn is_fair(&self) -> bool {
        self.n == self.of && self.n > 0 && self.wrong == 0 && self.silent == 0 && self.ended.is_empty()
    }
}
