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
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct ChartRequest {
    /// Kind.
    pub kind: ChartKind,
    /// For `accuracy`: what to chart speed against.
    #[serde(default)]
    #[param(inline)]
    pub accuracy: Accuracy,
    /// For `ecdf`, `bv_tests` and `primitive_tests`: only the configurations of this selection, e.g.
    /// `time of parry in [1ms, 1s] & near(vertex 8367, 0.05)`.
    #[serde(default, rename = "where", skip_serializing_if = "Option::is_none")]
    #[param(rename = "where")]
    pub selection: Option<String>,
    /// Algorithm whose columns are meant where the selection names none [default: the run's only one].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub algorithm: Option<String>,
}

impl ChartKind {
    /// Is it made of the records of this run alone, so that some of its configurations can be chosen?
    pub fn takes_selection(self) -> bool {
        matches!(self, Self::Ecdf | Self::BvTests | Self::PrimitiveTests)
    }
}
