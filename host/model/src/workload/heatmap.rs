//! Where on an object of a recording an algorithm is slow or wrong.

use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use super::Track;
use crate::workload_job::Stretch;

/// What to colour an object of a recording by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ObjectMeasure {
    /// Mean time per query, nanoseconds.
    Time,
    /// Share of the answers that are wrong.
    Wrong,
    /// How many queries.
    Queries,
}

impl ObjectMeasure {
    /// Its name in requests and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Wrong => "wrong",
            Self::Queries => "queries",
        }
    }

    /// Its unit, as files and pages name it.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Time => "ns",
            Self::Wrong => "share",
            Self::Queries => "queries",
        }
    }
}

/// Which queries about an object, and what is shown of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct ObjectHeatmapRequest {
    /// Algorithm id.
    pub algorithm: String,
    /// The order in which it was asked.
    pub order: Track,
    /// What to show.
    pub measure: ObjectMeasure,
    /// Number of the first query; the first of the recording when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<u64>,
    /// Number of the query behind the last one; the end of the recording when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<u64>,
}

impl ObjectHeatmapRequest {
    /// The stretch of the recording.
    pub fn stretch(&self) -> Stretch {
        Stretch { from: self.from, to: self.to }
    }
}

/// Values on the vertices of an object of a recording, from all queries that it takes part in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ObjectHeatmap {
    /// The object, by its place in the scene.
    pub object: u32,
    /// What is shown.
    pub request: ObjectHeatmapRequest,
    /// Unit of the values (`ns`, `share`, `queries`).
    pub unit: String,
    /// One per vertex, in the object's vertex order; null where no query has its closest or crossing triangle.
    pub values: Vec<Option<f64>>,
    /// Queries that went into each vertex.
    pub counts: Vec<u32>,
    /// Queries that went in.
    pub n: u64,
    /// Smallest and largest value; absent when no vertex has one.
    pub range: Option<[f64; 2]>,
}
