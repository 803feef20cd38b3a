//! How the times of a run came about.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The algorithm that takes part in every round of every run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Reference {
    /// Algorithm id.
    pub algorithm: String,
    /// SHA-256 (hex) of its plugin file.
    pub plugin_sha256: String,
}

/// Where the seed of a run comes from. A drawn one is the first 53 bits of SHA-256 over the text `secret`, followed by the
/// SHA-256 of the configuration set and of every plugin file in the run's order; `commitment` is the SHA-256 of `secret`
/// and was published when the run was asked for, before anything was measured. A run of the public suite draws its configurations,
/// too: their seed is the same with the word `configurations` in place of the configuration set's hash.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Draw {
    /// The seed.
    pub seed: u64,
    /// Revealed with the result; absent when whoever asked for the run chose the seed.
    pub secret: Option<String>,
    /// What was published before.
    pub commitment: Option<String>,
}

/// How the timed passes of one algorithm went.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Timing {
    /// Fresh processes.
    pub processes: u32,
    /// Blocks of questions that were disturbed, of all; a time from one counts only where its configuration has no other.
    pub disturbed_blocks: u32,
    /// All blocks.
    pub blocks: u32,
    /// Mean time per question in batches, nanoseconds; absent without batches.
    pub warm_ns: Option<f64>,
    /// Questions in batches.
    pub warm_n: u32,
    /// The integrity checks for which there was enough to go by.
    pub checks: Vec<TimingCheck>,
}

/// One integrity check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TimingCheck {
    /// Name of the check.
    pub check: String,
    /// What was measured.
    pub found: f64,
    /// What honest plugins stay within.
    pub allowed: [f64; 2],
}
