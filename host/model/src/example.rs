//! Examples: runs that a service measures by itself, each of which shows one finding.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::{Measure, RunInfo, RunSpec};

/// An example of this service.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Example {
    /// Its id.
    pub id: String,
    /// The question that it answers.
    pub title: String,
    /// What to look for, and the reason.
    pub text: String,
    /// The measure of its heatmap.
    pub measure: Measure,
    /// The algorithm whose heatmap is shown.
    pub algorithm: String,
    /// The run that it measures.
    pub spec: RunSpec,
}

/// An example with its run on this machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExampleInfo {
    /// The example.
    pub example: Example,
    /// Its newest run; absent until the service was idle.
    pub run: Option<RunInfo>,
}
