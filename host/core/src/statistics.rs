//! Statistics over measured values.
//!
//! NaN never enters: a measured value is a finite number, and what was not measured is left out before. The functions
//! that sort say so; comparisons use the total order, so that a NaN could not make a panic either.

use serde::{Deserialize, Serialize};

use crate::numbers::Numbers;

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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outliers {
    /// All values count.
    Keep,
    /// The fence of each vertex, where it has at least 8 values.
    #[default]
    PerVertex,
    /// One fence over all configurations, as in the 2020 paper.
    Global,
}

impl Statistic {
    /// The statistic of finite values; `None` when there are none. Reorders them.
    pub fn of(self, values: &mut [f64]) -> Option<f64> {
        if values.is_empty() {
            return None;
        }
        Some(match self {
            Self::Mean => mean(values),
            Self::Median => median(values),
            Self::Min => values.iter().copied().fold(f64::INFINITY, f64::min),
            Self::Max => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            Self::StandardDeviation => {
                // Two passes: the textbook one-pass formula cancels when values differ little.
                let mean = mean(values);
                (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
            }
            Self::Mad => {
                let median = median(values);
                values.iter_mut().for_each(|x| *x = (*x - median).abs());
                self::median(values)
            }
        })
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn median(values: &mut [f64]) -> f64 {
    select_quantile(values, 0.5)
}

/// As [`quantile`] of the sorted values, by selection instead of sorting; reorders them.
pub fn select_quantile(values: &mut [f64], q: f64) -> f64 {
    assert!(!values.is_empty() && (0.0..=1.0).contains(&q), "a quantile needs values and 0 <= q <= 1");
    let position = q * (values.len() - 1) as f64;
    let below = position.floor() as usize;
    let (_, &mut lower, above) = values.select_nth_unstable_by(below, f64::total_cmp);
    match above.iter().copied().min_by(f64::total_cmp) {
        Some(upper) => lower + (position - below as f64) * (upper - lower),
        None => lower,
    }
}

/// Quantile of ascending values, `q` from 0 to 1: linear between order statistics at position q (n-1), which is type 7
/// of Hyndman and Fan (1996), the default of R and NumPy. Panics when there are no values.
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    assert!(!sorted.is_empty() && (0.0..=1.0).contains(&q), "a quantile needs values and 0 <= q <= 1");
    let position = q * (sorted.len() - 1) as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (position - below as f64) * (sorted[above] - sorted[below])
}

/// Q1 - 1.5 IQR .. Q3 + 1.5 IQR: values outside count as outliers [OpenCollBench 2020, 3.2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fence {
    /// Lower end; values below it are outliers.
    pub lo: f64,
    /// Upper end; values above it are outliers.
    pub hi: f64,
}

impl Fence {
    /// Is the value no outlier? The ends themselves are none.
    pub fn contains(&self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }
}

/// The fence of ascending values, with quartiles by [`quantile`]. Without values it contains everything.
pub fn iqr_fence(sorted: &[f64]) -> Fence {
    if sorted.is_empty() {
        return Fence { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    }
    let (q1, q3) = (quantile(sorted, 0.25), quantile(sorted, 0.75));
    let reach = 1.5 * (q3 - q1);
    Fence { lo: q1 - reach, hi: q3 + reach }
}

/// How sure the ends of an interval are: 95 %, two-sided.
const LEVEL: f64 = 0.95;
/// Resamples of the bootstrap.
const RESAMPLES: usize = 1_000;

/// 95 % percentile bootstrap interval of a statistic (Efron 1979): its 2.5 % and 97.5 % quantiles over 1,000 resamples
/// with replacement. The same values, statistic and seed give the same interval on every machine.
///
/// Meant for smooth statistics such as the mean; for the maximum the bootstrap is wrong, see [`maximum_interval`]. Panics when
/// there are no values.
pub fn bootstrap_interval(values: &[f64], stat: impl Fn(&mut [f64]) -> f64, seed: u64) -> (f64, f64) {
    assert!(!values.is_empty(), "an interval needs values");
    let mut numbers = Numbers::new(seed);
    let mut resample = vec![0.0; values.len()];
    let mut stats: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            resample.iter_mut().for_each(|x| *x = values[numbers.below(values.len())]);
            stat(&mut resample)
        })
        .collect();
    stats.sort_unstable_by(f64::total_cmp);
    (quantile(&stats, (1.0 - LEVEL) / 2.0), quantile(&stats, (1.0 + LEVEL) / 2.0))
}

/// 95 % interval of a share of which `count` of `n` were seen: Wilson's (1927); when none was seen, from 0 to `3 / n`, the
/// rule of three. Panics when `n` is 0 or less than `count`.
pub fn share_interval(count: u64, n: u64) -> (f64, f64) {
    assert!(n > 0 && count <= n, "a share needs n of at least 1 and of at least the count");
    if count == 0 {
        return (0.0, (3.0 / n as f64).min(1.0));
    }
    // Square of the normal distribution's 97.5 % point.
    let (z2, n, p) = (3.841_458_820_694_124, n as f64, count as f64 / n as f64);
    let middle = p + z2 / (2.0 * n);
    let reach = (z2 * (p * (1.0 - p) / n + z2 / (4.0 * n * n))).sqrt();
    (((middle - reach) / (1.0 + z2 / n)).max(0.0), ((middle + reach) / (1.0 + z2 / n)).min(1.0))
}

/// What a sample says about its maximum, from ascending values: another sample of the same size has a maximum of at
/// least the sixth largest value here, with probability 1 - 2^-6 = 98 %, whatever the distribution.
///
/// Upwards nothing can be said without assuming a distribution (every second such sample exceeds this maximum), so the
/// upper end is the observed maximum itself: read it as "at least". Panics when there are no values.
pub fn maximum_interval(sorted: &[f64]) -> (f64, f64) {
    (sorted[sorted.len().saturating_sub(6)], sorted[sorted.len() - 1])
}

/// The empirical distribution of ascending values: points (x, share of values <= x), at most `max_points` (at least 2)
/// of them, always with the first and the last. Between two points lie equally many values, give or take ties.
pub fn ecdf(sorted: &[f64], max_points: usize) -> Vec<(f64, f64)> {
    assert!(max_points >= 2, "a distribution needs its two ends");
    let n = sorted.len();
    let points = n.min(max_points);
    let mut result: Vec<(f64, f64)> = Vec::with_capacity(points);
    for i in 0..points {
        let x = sorted[if points == 1 { 0 } else { i * (n - 1) / (points - 1) }];
        if result.last().is_none_or(|&(last, _)| last < x) {
            result.push((x, sorted.partition_point(|&y| y <= x) as f64 / n as f64));
        }
    }
    result
}

#[cfg(test)]
mod tests;
