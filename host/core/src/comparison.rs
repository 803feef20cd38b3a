//! What several processes say together: intervals, the ratio to the reference, ranks with ties.
//!
//! A process is one draw of layout, instance and machine state, so the processes are what is resampled (Efron 1979, the
//! percentile bootstrap). Where an algorithm has measured only a part of the set, or in one process only, its
//! configurations are resampled as well: then they are a sample, too.

use rayon::prelude::*;

use crate::numbers::Numbers;
use crate::statistics::{Statistic, quantile, select_quantile};

/// Official times of one algorithm: for every configuration, round and nanoseconds; nothing where it was not measured.
pub type Times = [Vec<(u32, f64)>];

/// A value with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// Resamples of the processes.
const RESAMPLES: u64 = 400;

/// An algorithm's times as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Mean over the configurations of the median over the processes, nanoseconds.
    pub mean_ns: Interval,
    /// Median over the configurations of the same.
    pub median_ns: Interval,
    /// 95th percentile over the configurations of the same.
    pub p95_ns: Interval,
    /// Geometric mean of the time divided by the reference's on the same configuration in the same round; absent where
    /// both have nothing in common.
    pub ratio: Option<Interval>,
}

/// Compares an algorithm with the reference, which may be itself, over so many rounds, on `of` configurations of which these
/// may be a part; `None` when it has no times.
pub fn compare(times: &Times, reference: Option<&Times>, rounds: u32, of: u64) -> Option<Comparison> {
    let mine: Vec<usize> = (0..times.len()).filter(|i| !times[*i].is_empty()).collect();
    let both: Vec<usize> = match reference {
        Some(reference) => mine.iter().copied().filter(|i| !reference[*i].is_empty()).collect(),
        None => Vec::new(),
    };
    let whole = rounds > 1 && mine.len() as u64 >= of;
    // Mean, median, 95th percentile, ratio; each where there is something to go by.
    let sample = |seed: Option<u64>| -> [Option<f64>; 4] {
        let mut draw = Draw::new(seed, rounds, whole);
        let mut all = draw.values(&mine, |weights, i| weights.median(&times[i]));
        let [mean, median, p95] = match all.is_empty() {
            true => [None; 3],
            false => [mean(&all), select_quantile(&mut all, 0.5), select_quantile(&mut all, 0.95)].map(Some),
        };
        let ratio = reference.and_then(|reference| {
            let ratio =
                |weights: &Weights, i: usize| Some((weights.median(&times[i])? / weights.median(&reference[i])?).ln());
            let all = draw.values(&both, ratio);
            (!all.is_empty()).then(|| self::mean(&all).exp())
        });
        [mean, median, p95, ratio]
    };
    let values = sample(None);
    let resampled: Vec<[Option<f64>; 4]> = (1..=RESAMPLES).into_par_iter().map(|seed| sample(Some(seed))).collect();
    let interval = |which: usize| {
        let value = values[which]?;
        let mut all: Vec<f64> = resampled.iter().filter_map(|sample| sample[which]).collect();
        all.sort_by(f64::total_cmp);
        let at = |q| if all.is_empty() { value } else { quantile(&all, q) };
        Some(Interval { value, lo: at(0.025), hi: at(0.975) })
    };
    Some(Comparison { mean_ns: interval(0)?, median_ns: interval(1)?, p95_ns: interval(2)?, ratio: interval(3) })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// How often each round was drawn.
struct Weights(Vec<u32>);

impl Weights {
    /// Median of the times of the drawn rounds; a round drawn twice counts twice.
    fn median(&self, times: &[(u32, f64)]) -> Option<f64> {
        let mut drawn: Vec<f64> = Vec::with_capacity(self.0.len());
        for (round, ns) in times {
            drawn.extend(std::iter::repeat_n(*ns, self.0[*round as usize] as usize));
        }
        Statistic::Median.of(&mut drawn)
    }
}

struct Draw {
    weights: Weights,
    numbers: Numbers,
    configurations: bool,
}

impl Draw {
    /// Without a seed everything is taken once.
    fn new(seed: Option<u64>, rounds: u32, whole: bool) -> Self {
        let mut numbers = Numbers::new(seed.unwrap_or(0));
        let mut weights = vec![u32::from(seed.is_none()); rounds as usize];
        if seed.is_some() {
            (0..rounds).for_each(|_| weights[numbers.below(rounds as usize)] += 1);
        }
        Draw { weights: Weights(weights), numbers, configurations: seed.is_some() && !whole }
    }

    /// Of the drawn configurations, where there is a value.
    fn values(&mut self, configurations: &[usize], value: impl Fn(&Weights, usize) -> Option<f64>) -> Vec<f64> {
        let draw = |place: usize| if self.configurations { self.numbers.below(configurations.len()) } else { place };
        (0..configurations.len()).map(draw).filter_map(|place| value(&self.weights, configurations[place])).collect()
    }
}

/// Ranks from 1, by intervals: as many as are surely better stand before it, so that those whose intervals overlap with
/// the best of them are tied. What has no interval has no rank.
pub fn ranks(all: &[Option<Interval>]) -> Vec<Option<u32>> {
    let before = |mine: &Interval| all.iter().flatten().filter(|other| other.hi < mine.lo).count() as u32;
    all.iter().map(|interval| interval.as_ref().map(|mine| 1 + before(mine))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(lo: f64, hi: f64) -> Option<Interval> {
        Some(Interval { value: 0.5 * (lo + hi), lo, hi })
    }

    #[test]
    fn overlapping_intervals_are_tied_and_nothing_has_no_rank() {
        let all = [interval(1.0, 2.0), interval(1.5, 2.5), None, interval(2.2, 3.0), interval(9.0, 9.5)];
        assert_eq!(ranks(&all), [Some(1), Some(1), None, Some(2), Some(4)]);
    }

    /// A process that is 20 % slower than another, on whatever it is asked, moves the median as well as the mean: the ends of
    /// all intervals are as far apart as the processes are.
    #[test]
    fn every_interval_covers_the_processes() {
        let pace = [1.0, 1.2, 1.1, 1.05, 1.15];
        let time = |i: usize| 1000.0 + i as f64;
        let times: Vec<Vec<(u32, f64)>> =
            (0..500).map(|i| (0..5).map(|round| (round, pace[round as usize] * time(i))).collect()).collect();
        let found = compare(&times, None, 5, 500).unwrap();
        for (interval, usual) in [(found.mean_ns, 1249.5), (found.median_ns, 1249.5), (found.p95_ns, 1474.05)] {
            assert!((interval.value - 1.1 * usual).abs() < 1e-9 * usual, "{interval:?}");
            assert!(interval.lo < 1.051 * usual && interval.hi > 1.149 * usual, "{interval:?}");
        }
        assert_eq!(found.ratio, None);
        assert_eq!(compare(&[vec![], vec![]], None, 5, 2), None);
    }

    #[test]
    fn a_round_counts_as_often_as_it_was_drawn() {
        let times = [(0, 10.0), (1, 20.0), (2, 40.0)];
        assert_eq!(Weights(vec![1, 1, 1]).median(&times), Some(20.0));
        assert_eq!(Weights(vec![0, 1, 2]).median(&times), Some(40.0));
        assert_eq!(Weights(vec![2, 1, 0]).median(&times), Some(10.0));
        assert_eq!(Weights(vec![3, 0, 0]).median(&times[1..]), None);
    }
}
