//! What colours an object, and what stands beside it.

use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

/// What to colour an object by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Time per query, nanoseconds.
    Time,
    /// BV tests per query.
    BvTests,
    /// Primitive tests per query.
    PrimitiveTests,
    /// How many configurations have their witness point on a triangle of the vertex.
    Density,
}

/// Which object of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The fixed object.
    #[default]
    A,
    /// The moving object.
    B,
}

/// Which map; the query string of every heatmap route.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct HeatmapRequest {
    /// Algorithm id (ignored for density).
    pub algorithm: String,
    /// Which object.
    #[serde(default)]
    pub side: Side,
    /// What to show.
    pub measure: Measure,
    /// Which statistic.
    pub statistic: ocb_core::statistics::Statistic,
    /// What to do with outliers.
    pub outliers: ocb_core::statistics::Outliers,
}

/// Values on the vertices of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Heatmap {
    /// What was asked.
    pub request: HeatmapRequest,
    /// Unit of the values (`ns`, `tests`, `configurations`).
    pub unit: String,
    /// One per vertex, in the object's vertex order; null where there is none.
    pub values: Vec<Option<f64>>,
    /// Values that went into each vertex after outlier removal.
    pub counts: Vec<u32>,
    /// Values that outlier removal took from each vertex.
    pub dropped: Vec<u32>,
    /// Configurations that went in.
    pub n: u32,
    /// Smallest and largest value; absent when no vertex has one.
    pub range: Option<[f64; 2]>,
}

/// The value at one vertex of a heatmap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct VertexValue {
    /// Vertex index, from 0, in the object's order.
    pub vertex: u32,
    /// The value; null where there is none.
    pub value: Option<f64>,
    /// Values that went into it after outlier removal.
    pub count: u32,
    /// Values that outlier removal took from it.
    pub dropped: u32,
    /// Unit of the value (`ns`, `tests`, `configurations`).
    pub unit: String,
}

impl Heatmap {
    /// The value at one vertex; none beyond the last vertex.
    pub fn vertex(&self, vertex: u32) -> Option<VertexValue> {
        let i = usize::try_from(vertex).ok()?;
        Some(VertexValue {
            vertex,
            value: *self.values.get(i)?,
            count: *self.counts.get(i)?,
            dropped: *self.dropped.get(i)?,
            unit: self.unit.clone(),
        })
    }
}

/// Empirical distribution of the time per query.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Ecdf {
    /// Algorithm id.
    pub algorithm: String,
    /// Number of values.
    pub n: u32,
    /// Times in nanoseconds, ascending, at most 512 points.
    pub time_ns: Vec<f64>,
    /// Share of queries at most that long, 0 to 1.
    pub share: Vec<f64>,
}
