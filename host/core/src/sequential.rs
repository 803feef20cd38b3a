//! When a comparison needs no more measurements.
//!
//! Times come in looks: after 500 configurations, then after twice as many each time. At a look every algorithm is
//! compared with the fastest on the configurations that both have answered, and the comparison is settled when each of
//! them is surely slower or surely so near that the difference does not matter to whoever asked (an indifference zone;
//! R. E. Bechhofer, *Ann. Math. Stat.* 25:16, 1954). Looking again and again would make chance findings ever more likely,
//! so every look spends half of what is left of one budget of error (K. K. G. Lan and D. L. DeMets, *Biometrika* 70:659,
//! 1983) and shares it among the comparisons (Bonferroni): however often one looks, the chance of any false statement
//! stays below [`ERROR`].
//!
//! A configuration's time has two causes that chance rules, which configurations were drawn and which processes ran. The
//! mean of such crossed effects has the variance of both added up, which is never too small (A. B. Owen, *Ann. Appl.
//! Stat.* 1:386, 2007); the degrees of freedom are Welch and Satterthwaite's. Ratios are compared by their logarithms,
//! whose tails are light where those of times are heavy.

mod student;

use serde::{Deserialize, Serialize};

use crate::comparison::{Interval, Times};
use crate::statistics::Statistic;

/// Chance that any statement of a comparison is false, over all its looks.
pub const ERROR: f64 = 0.02;
/// Configurations of the first look.
const FIRST: usize = 500;

/// After how many configurations one looks, the last time after `most`; no step is smaller than the first.
pub fn looks(most: usize) -> Vec<usize> {
    let doubling = std::iter::successors(Some(FIRST), |n| n.checked_mul(2));
    doubling.take_while(|n| n + FIRST <= most).chain([most]).collect()
}

/// What is compared, and how sure it has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Which look this is, from 1.
    pub number: u32,
    /// Comparisons that share the look's part of the error, with those of other contests.
    pub comparisons: usize,
    /// Differences below this share do not matter.
    pub precision: f64,
    /// Rounds of fresh processes.
    pub rounds: u32,
    /// Configurations that there are in all.
    pub of: u64,
}

/// What is known of an algorithm beside the fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// Surely slower.
    Slower,
    /// The difference is surely below the precision.
    Equal,
    /// Neither.
    Open,
}

/// An algorithm beside the fastest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rival {
    /// Which.
    pub index: usize,
    /// Its time divided by the fastest one's, geometric mean; absent when too little was measured of both.
    pub ratio: Option<Interval>,
    /// The interval that is to be expected of all configurations.
    pub whole: Option<Interval>,
    /// What follows.
    pub standing: Standing,
}

/// How a contest stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Contest {
    /// The fastest, as far as is known.
    pub fastest: usize,
    /// All others.
    pub rivals: Vec<Rival>,
}

impl Contest {
    /// Nothing is open.
    pub fn settled(&self) -> bool {
        self.rivals.iter().all(|rival| rival.standing != Standing::Open)
    }
}

/// Compares the algorithms of one contest; `None` when there is none.
pub fn contest(all: &[&Times], look: &Look) -> Option<Contest> {
    let medians: Vec<Vec<Option<f64>>> = all.iter().map(|times| times.iter().map(|t| median(t)).collect()).collect();
    let fastest = fastest(&medians)?;
    let others = (0..all.len()).filter(|i| *i != fastest);
    let rivals = others.map(|i| {
        let logs = differences(&medians[i], &medians[fastest]);
        look.rival(i, &logs, &by_round(all[i], all[fastest], look.rounds))
    });
    Some(Contest { fastest, rivals: rivals.collect() })
}

impl Look {
    fn rival(&self, index: usize, logs: &[f64], rounds: &[f64]) -> Rival {
        let none = Rival { index, ratio: None, whole: None, standing: Standing::Open };
        let (n, r) = (logs.len() as f64, rounds.len() as f64);
        if logs.len() < 2 || rounds.len() < 2 {
            return none;
        }
        let mean = logs.iter().sum::<f64>() / n;
        // What was drawn without replacement is known the better the less is left.
        let left = (1.0 - n / self.of as f64).max(0.0);
        let (drawn, processes) = (variance(logs) / n * left, variance(rounds) / r);
        let freedom = (drawn + processes).powi(2) / (drawn.powi(2) / (n - 1.0) + processes.powi(2) / (r - 1.0));
        let share = ERROR * 0.5f64.powi(self.number as i32) / self.comparisons.max(1) as f64;
        let sure = student::quantile(share, freedom);
        let around = |variance: f64| {
            let half = sure * variance.sqrt();
            Interval { value: mean.exp(), lo: (mean - half).exp(), hi: (mean + half).exp() }
        };
        let ratio = around(drawn + processes);
        let near = 1.0 + self.precision;
        let standing = match ratio {
            Interval { lo, .. } if lo > 1.0 => Standing::Slower,
            Interval { lo, hi, .. } if lo >= 1.0 / near && hi <= near => Standing::Equal,
            _ => Standing::Open,
        };
        Rival { index, ratio: Some(ratio), whole: Some(around(processes)), standing }
    }
}

/// Logarithm of the median over the processes.
fn median(times: &[(u32, f64)]) -> Option<f64> {
    Statistic::Median.of(&mut times.iter().map(|(_, ns)| *ns).collect::<Vec<_>>()).map(f64::ln)
}

/// Where both were measured.
fn differences(mine: &[Option<f64>], other: &[Option<f64>]) -> Vec<f64> {
    mine.iter().zip(other).filter_map(|(mine, other)| Some((*mine)? - (*other)?)).collect()
}

/// Mean of the differences of each round in which both have times.
fn by_round(mine: &Times, other: &Times, rounds: u32) -> Vec<f64> {
    let mut sums = vec![(0.0, 0u32); rounds as usize];
    for (mine, other) in mine.iter().zip(other) {
        for (round, ns) in mine {
            if let Some((_, reference)) = other.iter().find(|(of, _)| of == round) {
                let (sum, n) = &mut sums[*round as usize];
                *sum += (ns / reference).ln();
                *n += 1;
            }
        }
    }
    sums.into_iter().filter(|(_, n)| *n > 0).map(|(sum, n)| sum / f64::from(n)).collect()
}

/// The algorithm that is slower than the fewest others.
fn fastest(medians: &[Vec<Option<f64>>]) -> Option<usize> {
    let slower_than = |i: &usize| {
        let beats = |other: &&Vec<Option<f64>>| differences(&medians[*i], other).iter().sum::<f64>() > 0.0;
        medians.iter().filter(beats).count()
    };
    (0..medians.len()).min_by_key(slower_than)
}

/// Of a sample, divisor n - 1.
fn variance(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(precision: f64) -> Look {
        Look { number: 1, comparisons: 1, precision, rounds: 3, of: 1_000_000 }
    }

    /// `n` configurations in three rounds; configuration i costs i + 1 times `factor`, rounds differ by up to `jitter`.
    fn times(n: usize, factor: f64, jitter: f64) -> Vec<Vec<(u32, f64)>> {
        let of = |i: usize| (0..3).map(|r| (r, factor * (i + 1) as f64 * (1.0 + jitter * f64::from(r)))).collect();
        (0..n).map(of).collect()
    }

    #[test]
    fn looks_double_and_end_with_everything() {
        assert_eq!(looks(200), [200]);
        assert_eq!(looks(999), [999]);
        assert_eq!(looks(1000), [500, 1000]);
        assert_eq!(looks(5000), [500, 1000, 2000, 4000, 5000]);
        assert_eq!(looks(8200), [500, 1000, 2000, 4000, 8200]);
    }

    #[test]
    fn a_steady_difference_is_seen_and_a_small_one_does_not_matter() {
        let (a, b, c) = (times(50, 2.0, 0.0), times(50, 1.0, 0.0), times(50, 1.01, 1e-5));
        let contest = contest(&[&a, &b, &c], &look(0.05)).expect("three algorithms");
        assert_eq!(contest.fastest, 1);
        let standings: Vec<Standing> = contest.rivals.iter().map(|r| r.standing).collect();
        assert_eq!(standings, [Standing::Slower, Standing::Slower]);
        assert!((contest.rivals[0].ratio.unwrap().value - 2.0).abs() < 1e-12);
        let noisy = times(50, 1.01, 0.005);
        let near = super::contest(&[&b, &noisy], &look(0.2)).expect("two algorithms");
        assert_eq!((near.fastest, near.rivals[0].standing, near.settled()), (0, Standing::Equal, true));
        let open = super::contest(&[&b, &noisy], &look(0.01)).expect("two algorithms");
        assert!(open.rivals[0].standing == Standing::Open && !open.settled());
    }

    #[test]
    fn more_configurations_narrow_what_they_cause_and_nothing_else() {
        // Half of the configurations cost twice as much: their share of the interval shrinks, that of the rounds stays.
        let mut uneven = times(400, 1.0, 0.001);
        uneven.iter_mut().skip(200).flatten().for_each(|(_, ns)| *ns *= 2.0);
        let even = times(400, 1.0, 0.0);
        let rival = contest(&[&even, &uneven], &look(0.05)).unwrap().rivals[0];
        let width = |interval: Option<Interval>| interval.map(|i| (i.hi / i.lo).ln()).unwrap();
        assert!(width(rival.whole) < 0.1 * width(rival.ratio) && width(rival.whole) > 0.0, "{rival:?}");
    }

    #[test]
    fn what_was_not_measured_twice_is_open() {
        let (one, none) = (times(1, 1.0, 0.1), vec![Vec::new()]);
        for other in [times(1, 2.0, 0.1), none] {
            let rival = contest(&[&one, &other], &look(0.5)).unwrap().rivals[0];
            assert_eq!((rival.ratio, rival.standing), (None, Standing::Open));
        }
        assert_eq!(contest(&[], &look(0.5)), None);
    }
}
