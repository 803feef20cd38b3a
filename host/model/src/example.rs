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
    /// What to look for, and why it is so.
    pub text: String,
    /// What its heatmap shows.
    pub measure: Measure,
    /// The algorithm whose heatmap is shown.
    pub algorithm: String,
    /// What is measured.
    pub spec: RunSpec,
}

/// An example, and its run on this machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExampleInfo {
    /// What it is.
    pub example: Example,
    /// Its newest run; absent until the service was idle.
    pub run: Option<RunInfo>,
}
