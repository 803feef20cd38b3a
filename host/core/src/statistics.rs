//! Statistics over measured values.

use serde::{Deserialize, Serialize};

/// A statistic of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Statistic {
    /// Arithmetic mean.
    Mean,
    /// Median.
    Median,
    /// Smallest value.
    Min,
    /// Largest value.
    Max,
    /// Standard deviation (divisor n).
    StandardDeviation,
    /// Median absolute deviation about the median, unscaled.
    Mad,
}

/// What happens to outliers: values outside Q1 - 1.5 IQR .. Q3 + 1.5 IQR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outliers {
    /// All values count.
    Keep,
    /// The fence of each vertex, where it has at least 8 values.
    PerVertex,
    /// One fence over all configurations, as in the 2020 paper.
    Global,
}
