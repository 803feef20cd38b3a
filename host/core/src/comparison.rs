//! What several processes say together: intervals, the ratio to the reference, ranks with ties.
//!
//! A process is one draw of layout, instance and machine state, so the processes are what is resampled (Efron 1979, the
//! percentile bootstrap). Where an algorithm has measured only a part of the set, or in one process only, its
//! configurations are resampled as well: then they are a sample, too.

use rayon::prelude::*;

use crate::numbers::Numbers;
use crate::statistics::{Statistic, quantile};

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
    let sample = |seed: Option<u64>| -> (f64, Option<f64>) {
        let mut draw = Draw::new(seed, rounds, whole);
        let mean = draw.mean(&mine, |weights, i| weights.median(&times[i]));
        let ratio = reference.and_then(|reference| {
            let ratio =
                |weights: &Weights, i: usize| Some((weights.median(&times[i])? / weights.median(&reference[i])?).ln());
            draw.mean(&both, ratio).map(f64::exp)
        });
        (mean.unwrap_or(f64::NAN), ratio)
    };
    if mine.is_empty() {
        return None;
    }
    let (mean, ratio) = sample(None);
    let resampled: Vec<(f64, Option<f64>)> = (1..=RESAMPLES).into_par_iter().map(|seed| sample(Some(seed))).collect();
    let interval = |value: f64, mut all: Vec<f64>| {
        all.retain(|x| x.is_finite());
        all.sort_by(f64::total_cmp);
        let at = |q| if all.is_empty() { value } else { quantile(&all, q) };
        Interval { value, lo: at(0.025), hi: at(0.975) }
    };
    Some(Comparison {
        mean_ns: interval(mean, resampled.iter().map(|(mean, _)| *mean).collect()),
        ratio: ratio.map(|value| interval(value, resampled.iter().filter_map(|(_, ratio)| *ratio).collect())),
    })
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

    /// Mean over the configurations for which there is a value.
    fn mean(&mut self, configurations: &[usize], value: impl Fn(&Weights, usize) -> Option<f64>) -> Option<f64> {
        let (mut sum, mut n) = (0.0, 0u32);
        for place in 0..configurations.len() {
            let place = if self.configurations { self.numbers.below(configurations.len()) } else { place };
            if let Some(x) = value(&self.weights, configurations[place]) {
                sum += x;
                n += 1;
            }
        }
        (n > 0).then(|| sum / f64::from(n))
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

    #[test]
    fn a_round_counts_as_often_as_it_was_drawn() {
        let times = [(0, 10.0), (1, 20.0), (2, 40.0)];
        assert_eq!(Weights(vec![1, 1, 1]).median(&times), Some(20.0));
        assert_eq!(Weights(vec![0, 1, 2]).median(&times), Some(40.0));
        assert_eq!(Weights(vec![2, 1, 0]).median(&times), Some(10.0));
        assert_eq!(Weights(vec![3, 0, 0]).median(&times[1..]), None);
    }
}
