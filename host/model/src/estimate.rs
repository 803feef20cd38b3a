//! What a run would cost.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What a run would cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Estimate {
    /// Number of configurations.
    pub configurations: u64,
    /// The set is stored already.
    pub configurations_stored: bool,
    /// Expected seconds to find and certify the configurations.
    pub configuration_seconds: f64,
    /// Expected seconds per algorithm that was asked for.
    pub measuring_seconds: Vec<AlgorithmSeconds>,
    /// All together, with the reference algorithm where nobody asked for it, without waiting.
    pub total_seconds: f64,
    /// Runs ahead in the queue.
    pub runs_ahead: u32,
    /// Expected seconds until those are done.
    pub wait_seconds: f64,
    /// Why whoever asks may not start it, and what to change; absent when they may. A part of it, such as a quick look, may be
    /// allowed.
    #[serde(default)]
    pub refused: Option<String>,
}

/// Seconds of one algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AlgorithmSeconds {
    /// Algorithm id.
    pub algorithm: String,
    /// Seconds.
    pub seconds: f64,
    /// Expected to be cut by the budget.
    pub budget_limited: bool,
}
