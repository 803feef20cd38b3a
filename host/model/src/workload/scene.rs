//! The scene of a recording as it stands in space, with its pairs.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::WorkloadObject;
use crate::workload_job::PosedObject;

/// The scene of a recording: its objects, where they stand, and which pairs were asked or are disabled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PosedScene {
    /// What the objects are, in their order in the scene.
    pub about: Vec<WorkloadObject>,
    /// Where they stand, in the same order.
    pub objects: Vec<PosedObject>,
    /// The scene places every object at its origin, as recorders do, so each stands where its first query places it.
    pub placed_by_queries: bool,
    /// The pairs that were asked or are disabled, those with the most queries first; at most 10,000.
    pub pairs: Vec<ScenePair>,
    /// Pairs that were asked.
    pub asked: u64,
    /// Pairs that the scene disables.
    pub disabled: u64,
    /// Pairs that were asked although the scene disables them.
    pub asked_though_disabled: u64,
}

/// A pair of objects of a scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct ScenePair {
    /// The objects, by their place in the scene, the smaller first.
    pub objects: [u32; 2],
    /// Queries about it in the recording.
    pub queries: u64,
    /// Why the scene disables it (the reason of an SRDF file, the same link, adjacent links); absent where it does not.
    pub disabled: Option<String>,
}
