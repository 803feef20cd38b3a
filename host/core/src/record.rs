//! One algorithm on one configuration.

use serde::{Deserialize, Serialize};

use crate::query::{Answer, Counters};

/// The comparison of one answer with the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Agrees with the truth.
    Correct,
    /// A missed collision: the worst error.
    FalseNegative,
    /// Says hit where there is none.
    FalsePositive,
    /// Distance above the truth by more than tau.
    DistanceOver,
    /// Distance below the truth by more than tau.
    DistanceUnder,
    /// Witness points or triangles do not realise the claimed answer.
    WrongWitness,
    /// Not a number, negative, or a triangle id out of range.
    Invalid,
    /// Inside the declared precision band, the answer agrees with exact arithmetic or not; not scored.
    Undecidable,
    /// The algorithm said that it could not decide.
    GaveUp,
    /// The algorithm does not answer this query.
    Unsupported,
}

impl Verdict {
    /// Counts as a wrong answer.
    pub fn is_wrong(self) -> bool {
        use Verdict::*;
        matches!(self, FalseNegative | FalsePositive | DistanceOver | DistanceUnder | WrongWitness | Invalid)
    }
}

/// One algorithm on one configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Index of the configuration in its set.
    pub configuration: u32,
    /// Time of the query in nanoseconds by the supervisor's clock, null round trip subtracted; the median over passes.
    pub time_ns: f64,
    /// Whether that time lies below the clock's resolution (then `time_ns` is the resolution, an upper bound).
    pub below_resolution: bool,
    /// How many passes the time is the median of.
    pub passes: u32,
    /// Counters from the separate untimed pass, when the algorithm has them.
    pub counters: Option<Counters>,
    /// The answer of the first timed pass.
    pub answer: Answer,
    /// Its comparison with the truth.
    pub verdict: Verdict,
}
