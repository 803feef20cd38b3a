//! What a run that measured a part of its configurations says of all of them.

use ocb_core::sequential::Standing;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Estimated;

/// A run that measured a part of its configurations, evenly spread over all. Its wrong answers are those that were seen;
/// of none seen in n it is only known that fewer than 3/n are to be expected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Preview {
    /// Configurations measured.
    pub n: u32,
    /// Configurations of the whole run; of a sampled set that was not found as a whole: before any is missed.
    pub of: u64,
    /// Differences below this share count as none.
    pub precision: f64,
    /// How often it was looked whether the comparison is settled.
    pub looks: u32,
    /// Every comparison is settled. All that is said of them together is false with a probability of at most 2 %.
    pub settled: bool,
    /// Each algorithm beside the fastest of its contract class, as far as both answered and were not wrong.
    pub beside: Vec<Beside>,
    /// What was found, in words.
    pub finding: String,
    /// What measuring all configurations would add, in words.
    pub more: String,
}

/// An algorithm beside the fastest one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Beside {
    /// The algorithm.
    pub algorithm: String,
    /// The fastest one of its contract class.
    pub fastest: String,
    /// Its time divided by the fastest one's, geometric mean over the configurations. The interval allows for every look
    /// and every comparison; absent when too little was measured of both.
    pub ratio: Option<Estimated>,
    /// The interval to be expected of all configurations, should the value stay.
    pub whole: Option<Estimated>,
    /// What follows.
    pub standing: Standing,
}
