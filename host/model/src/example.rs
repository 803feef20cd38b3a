//! Examples: runs and advice that a service makes by itself, each of which shows one finding.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::{AdviceInfo, AdviceSpec, Measure, RunInfo, RunSpec};

/// An example of this service.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Example {
    /// Its id.
    pub id: String,
    /// The question that it answers.
    pub title: String,
    /// What to look for, and the reason.
    pub text: String,
    /// What the service does for it.
    pub work: ExampleWork,
}

/// What answers an example's question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum ExampleWork {
    /// A run.
    Run {
        /// The measure of its heatmap.
        measure: Measure,
        /// The algorithm whose heatmap is shown.
        algorithm: String,
        /// The run that is measured.
        spec: Box<RunSpec>,
    },
    /// Advice about levels of detail.
    Advice {
        /// What is asked.
        spec: AdviceSpec,
    },
}

/// An example with what this service found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExampleInfo {
    /// The example.
    pub example: Example,
    /// Its newest run; absent until the service was idle.
    pub run: Option<RunInfo>,
    /// Its newest advice; absent until the service was idle.
    pub advice: Option<AdviceInfo>,
}
