//! The charts of a run.

use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use super::Accuracy;

/// What a chart of a run shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChartKind {
    /// Speed against accuracy.
    Accuracy,
    /// Mean and maximum time against the distance, over the ladder of this run or all runs of the pair of objects.
    Distance,
    /// Mean and maximum time against the number of triangles, over runs at the same distance.
    Triangles,
    /// Empirical distribution of the time per query.
    Ecdf,
    /// Time against BV tests.
    BvTests,
    /// Time against primitive tests.
    PrimitiveTests,
    /// Share of wrong decisions against the true distance, or how far the objects cross.
    Resolution,
}

/// Which chart; the query string of the chart routes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct ChartRequest {
    /// Kind.
    pub kind: ChartKind,
    /// For `accuracy`: what to chart speed against.
    #[serde(default)]
    #[param(inline)]
    pub accuracy: Accuracy,
}
