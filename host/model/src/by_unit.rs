//! What an algorithm does in each unit of length.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Estimated;

/// Time and answers in one unit. The rank comes from the unit of the files alone, except that a wrong answer in any unit
/// takes it away.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct InUnit {
    /// All coordinates were multiplied by two to this power, which rounds nothing; 0 is the unit of the files.
    pub exponent: i32,
    /// Fresh processes that were timed in this unit.
    pub processes: u32,
    /// Configurations that were timed in it.
    pub n: u32,
    /// Mean time per query, nanoseconds. In the unit of the files its 95 % interval is over the processes, elsewhere over the
    /// configurations.
    pub mean_ns: Option<Estimated>,
    /// Time divided by the time in the unit of the files on the same configurations, geometric mean, after dividing by the same
    /// of the reference algorithm. The ends are the fastest and the slowest process, not an interval. Absent where no process was
    /// asked 20 questions.
    pub pace: Option<Estimated>,
    /// Answers, control questions not included. A configuration may have several.
    pub answers: u32,
    /// Wrong ones of them.
    pub wrong: u32,
    /// Wrong ones that miss a collision.
    pub missed: u32,
}

/// That time or answers depend on the unit of length. A time does when every process in another unit takes more than 1.5
/// times as long as every process in the unit of the files, or the other way round, and the means are 500 ns apart or more. Wrong
/// answers do when, on the configurations asked in both units, chance would distribute them so unevenly with a probability
/// below 1 %.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct UnitDependence {
    /// Units in which the time differs, as exponents.
    pub time: Vec<i32>,
    /// Units in which another share of the answers is wrong.
    pub answers: Vec<i32>,
    /// Both as one sentence.
    pub message: String,
}
