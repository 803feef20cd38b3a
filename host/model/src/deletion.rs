//! Deleting an account.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What becomes of an account's things when it is deleted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(example = json!({
    "goes": { "runs": 12, "objects": 3, "configurations": 2, "advice": 1, "stability": 1, "workloads": 1, "plugins": 1 },
    "stays": { "runs": 2, "objects": 1, "configurations": 0, "advice": 0, "stability": 0, "workloads": 0, "plugins": 1 },
    "bytes": 7_340_032,
    "blocked_by": null
}))]
pub struct DeletionPreview {
    /// What is not public is deleted, with everything that the account was told and has chosen.
    pub goes: OwnedCounts,
    /// What is public stays, because it is cited, and belongs to a former account without a name. A plugin stays once it was public.
    pub stays: OwnedCounts,
    /// Bytes of the stored files that go: those that nobody else uses.
    pub bytes: u64,
    /// Why the account cannot be deleted now, and how to mend that.
    pub blocked_by: Option<String>,
}

/// How many of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct OwnedCounts {
    /// Runs with their results.
    pub runs: u32,
    /// Objects.
    pub objects: u32,
    /// Saved configurations.
    pub configurations: u32,
    /// Pieces of advice.
    pub advice: u32,
    /// Stability runs.
    pub stability: u32,
    /// Workloads with their recordings.
    pub workloads: u32,
    /// Plugins, each version by itself.
    pub plugins: u32,
}

/// Deleting one's account.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "password": "correct horse battery staple" }))]
pub struct DeleteAccount {
    /// The password, once more.
    pub password: String,
}
