//! Asking for advice about levels of detail.

use ocb_advice::Advice;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::State;

/// What is asked; lengths are shares of L, the longest side of A's bounding box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Asked {
    /// How far apart are they?
    Distance {
        /// Largest error of an answer; more than 0, at most 1.
        tolerance: f64,
    },
    /// Are they further apart than this?
    Clearance {
        /// The distance; 0 asks whether the surfaces meet.
        clearance: f64,
    },
}

/// A request for advice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AdviceSpec {
    /// Object A.
    pub object_a: String,
    /// Object B; absent: the same as A.
    #[serde(default)]
    pub object_b: Option<String>,
    /// What is asked of every configuration.
    pub question: Asked,
}

/// A request for advice and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AdviceInfo {
    /// Id; whoever knows it may look.
    pub id: String,
    /// What was asked.
    pub spec: AdviceSpec,
    /// Names of the objects.
    pub names: [String; 2],
    /// How far it is.
    pub state: State,
    /// What is being done.
    pub step: String,
    /// Steps done of `total`.
    pub done: u64,
    /// All steps.
    pub total: u64,
    /// Why it failed.
    pub message: Option<String>,
    /// The advice, when it is done.
    pub advice: Option<Advice>,
}
