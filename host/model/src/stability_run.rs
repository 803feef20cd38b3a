//! Stability runs that a service carries out.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Stability, State};

/// Which algorithm is tried, and on what.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "algorithm": "box-tree", "parts": ["vertex-face"] }))]
pub struct StabilitySpec {
    /// The algorithm, with its settings behind it (`box-tree:leaf_size=4`).
    pub algorithm: String,
    /// Families and relations by their short names, `reported`, `tessellations` or `search`; everything when empty.
    #[serde(default)]
    pub parts: Vec<String>,
    /// Seeds per value of a parameter, 1 to 10; 3 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seeds: Option<u32>,
}

/// A stability run and how far it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StabilityRunInfo {
    /// Id; only the owner may look.
    pub id: String,
    /// What was asked.
    pub spec: StabilitySpec,
    /// Name of the algorithm.
    pub name: String,
    /// State.
    pub state: State,
    /// The part that is next or under way; absent when it has ended.
    pub step: Option<String>,
    /// Parts done.
    pub done: u32,
    /// All parts.
    pub total: u32,
    /// Stability runs under way, or carried out before this one if nothing else is requested; 0 when it does not wait.
    pub runs_ahead: u32,
    /// Why it failed or was cancelled, one sentence.
    pub message: Option<String>,
    /// When it was asked for.
    pub created_us: i64,
    /// When it ended.
    pub finished_us: Option<i64>,
    /// What was found so far; absent in lists and before the first part is done.
    pub result: Option<Stability>,
}
