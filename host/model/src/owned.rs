//! What somebody has made, and what goes with it.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A run or an object, as lists call it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct OwnedItem {
    /// Its id.
    pub id: String,
    /// Its name; of a run, those of its objects.
    pub name: String,
}

/// Runs, objects, saved configurations, advice, stability runs and workloads of one owner: all of them, or those that go with one of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct OwnedItems {
    /// Runs with their results, newest first.
    pub runs: Vec<OwnedItem>,
    /// Objects, newest first.
    pub objects: Vec<OwnedItem>,
    /// Saved configurations, newest first.
    pub configurations: Vec<OwnedItem>,
    /// How many pieces of advice.
    pub advice: u32,
    /// How many stability runs.
    pub stability: u32,
    /// How many workloads.
    pub workloads: u32,
    /// Bytes of the stored files that go with them: those that nobody else uses.
    pub bytes: u64,
    /// When a guest's things go by themselves; absent for accounts, whose things stay.
    pub kept_until_us: Option<i64>,
}
