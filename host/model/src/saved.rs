//! Configurations that somebody saved, to measure on them again.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Saved configurations: from a file, or of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct SavedConfigurations {
    /// Their id.
    pub id: String,
    /// The name of the file, or of the objects of the run.
    pub name: String,
    /// SHA-256 of the file: what a run with the method `file` names.
    pub sha256: String,
    /// How many there are.
    pub configurations: u32,
    /// How many matrices were rounded to the nearest rotation.
    pub straightened: u32,
    /// When they were saved.
    pub created_us: i64,
}
