//! What colours an object, and what stands beside it.

use ocb_core::selection::Column;
use ocb_core::statistics::{Outliers, Statistic};
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
    /// In how many primitive tests a triangle takes part, per query; a vertex shows the statistic over its triangles.
    TriangleTests,
    /// How many configurations have their witness point on a triangle of the vertex.
    Density,
    /// Share of the answers that are wrong.
    Wrong,
    /// Share of the answers that miss a collision.
    Missed,
    /// Share of the answers that report a collision where there is none.
    FalseAlarms,
    /// How far the answered distance lies outside the certified interval, in u S (unit roundoff of the algorithm's
    /// arithmetic, size of the scene's coordinates).
    DistanceError,
    /// Share of the configurations whose equivalent instances got answers that contradict each other.
    Flips,
    /// Share of the run's other algorithms whose answer contradicts this one's.
    Disagreement,
}

impl Measure {
    /// A share of answers: a mean of zeros and ones, of which no value is an outlier.
    pub fn is_share(self) -> bool {
        matches!(self, Self::Wrong | Self::Missed | Self::FalseAlarms | Self::Flips | Self::Disagreement)
    }

    /// Its unit, as files and pages name it.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Time => "ns",
            Self::BvTests | Self::PrimitiveTests => "tests",
            Self::TriangleTests => "tests per query",
            Self::Density => "configurations",
            Self::DistanceError => "u S",
            Self::Wrong | Self::Missed | Self::FalseAlarms | Self::Flips | Self::Disagreement => "share",
        }
    }

    /// The column of a record that it shows; density and the tests per triangle show none.
    pub fn column(self) -> Option<Column> {
        Some(match self {
            Self::Time => Column::Time,
            Self::BvTests => Column::BvTests,
            Self::PrimitiveTests => Column::PrimitiveTests,
            Self::Density | Self::TriangleTests => return None,
            Self::Wrong => Column::Wrong,
            Self::Missed => Column::Missed,
            Self::FalseAlarms => Column::FalseAlarm,
            Self::DistanceError => Column::Error,
            Self::Flips => Column::Flipped,
            Self::Disagreement => Column::Disputed,
        })
    }
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
    /// What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped.
    #[serde(default)]
    #[param(default = "per_vertex")]
    pub outliers: ocb_core::statistics::Outliers,
    /// Show the difference to this algorithm: the values of `algorithm` minus its values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub against: Option<String>,
    /// Subtract the values of another run on the same object; of the same algorithm unless `against` names another one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub against_run: Option<String>,
    /// Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`.
    #[serde(default, rename = "where", skip_serializing_if = "Option::is_none")]
    #[param(rename = "where")]
    pub selection: Option<String>,
}

impl HeatmapRequest {
    /// Object A, all configurations, nothing subtracted.
    pub fn new(algorithm: &str, measure: Measure, statistic: Statistic, outliers: Outliers) -> Self {
        Self {
            algorithm: algorithm.to_owned(),
            side: Side::A,
            measure,
            statistic,
            outliers,
            against: None,
            against_run: None,
            selection: None,
        }
    }

    /// With what the measure leaves no choice of: a share is a mean, and of failures and counts none is dropped as an outlier.
    pub fn settled(&self) -> Self {
        let mut settled = self.clone();
        if self.measure.is_share() {
            settled.statistic = Statistic::Mean;
        }
        if self.measure.is_share() || matches!(self.measure, Measure::DistanceError | Measure::TriangleTests) {
            settled.outliers = Outliers::Keep;
        }
        settled
    }

    /// What is subtracted: a run, when it is another one, and an algorithm.
    pub fn subtrahend(&self) -> Option<(Option<&str>, &str)> {
        (self.against.is_some() || self.against_run.is_some())
            .then(|| (self.against_run.as_deref(), self.against.as_deref().unwrap_or(&self.algorithm)))
    }
}

/// Values on the vertices of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Heatmap {
    /// What is shown: what was asked, but for what the measure leaves no choice of.
    pub request: HeatmapRequest,
    /// Unit of the values (`ns`, `tests`, `tests per query`, `configurations`, `share`, `u S`).
    pub unit: String,
    /// One per vertex, in the object's vertex order; null where there is none.
    pub values: Vec<Option<f64>>,
    /// Values that went into each vertex after outlier removal.
    pub counts: Vec<u32>,
    /// Values that outlier removal took from each vertex.
    pub dropped: Vec<u32>,
    /// Configurations that went in; of a difference, those of the map that has fewer.
    pub n: u32,
    /// Smallest and largest value; absent when no vertex has one.
    pub range: Option<[f64; 2]>,
    /// The run is still being measured and this will change: it comes from the answers so far.
    #[serde(default)]
    #[schema(required = true)]
    pub preliminary: bool,
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
    /// Unit of the value, as in the heatmap.
    pub unit: String,
    /// As the heatmap is.
    #[serde(default)]
    #[schema(required = true)]
    pub preliminary: bool,
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
            preliminary: self.preliminary,
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
    /// The run is still being measured and this will change: it comes from the answers so far.
    #[serde(default)]
    #[schema(required = true)]
    pub preliminary: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_without_outliers_gets_what_the_page_shows() {
        let request = r#"{ "algorithm": "a", "measure": "time", "statistic": "median" }"#;
        let request: HeatmapRequest = serde_json::from_str(request).unwrap();
        assert_eq!((request.outliers, request.side), (Outliers::PerVertex, Side::A));
    }
}
