//! Does an algorithm depend on the unit of length?
//!
//! It does where its time or its answers differ between two units by more than chance explains. Processes are the sample
//! for times, because a process may meet a slow moment of the machine: every process in one unit has to be slower than
//! every process in the other, by more than [`FACTOR`]. For answers the question is how likely the wrong ones would
//! fall so unevenly on the two units if the unit did not matter.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::comparison::{Interval, Times};
use crate::statistics::Statistic;

/// Times in two units differ when every process in one takes more than this many times as long as any in the other. Other units are
/// asked once per configuration and last, which alone makes questions of some microseconds up to 1.3 times as long.
pub const FACTOR: f64 = 1.5;
/// Wrong answers depend on the unit when chance would distribute them so unevenly less often than this.
pub const CHANCE: f64 = 0.01;
/// One process may have met a slow moment.
const LEAST_PROCESSES: usize = 2;
/// The mean of fewer questions says little about a process.
const LEAST_QUESTIONS: usize = 20;

/// Answers in one unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// All answers.
    pub answers: u32,
    /// The wrong ones.
    pub wrong: u32,
    /// The wrong ones that miss a collision.
    pub missed: u32,
}

impl Tally {
    /// Both together.
    pub fn plus(self, other: Self) -> Self {
        Self {
            answers: self.answers + other.answers,
            wrong: self.wrong + other.wrong,
            missed: self.missed + other.missed,
        }
    }

    /// More or fewer of these answers are wrong than of the other unit's, beyond chance. Both are answers to the same questions.
    pub fn differs(self, other: Self) -> bool {
        self.is_worse(other) || other.is_worse(self)
    }

    /// If the unit did not matter, each wrong answer would be one of these with the probability of their share.
    fn is_worse(self, other: Self) -> bool {
        if self.answers == 0 || other.answers == 0 {
            return false;
        }
        let share = f64::from(self.answers) / (f64::from(self.answers) + f64::from(other.answers));
        at_least(self.wrong, self.wrong + other.wrong, share) < CHANCE
    }
}

/// Probability of at least `k` successes in `n` trials of probability `p`, which is neither 0 nor 1.
fn at_least(k: u32, n: u32, p: f64) -> f64 {
    let mut ln_term = f64::from(n) * (1.0 - p).ln();
    let mut sum = 0.0;
    for i in 0..=n {
        if i >= k {
            sum += ln_term.exp();
        }
        ln_term += (f64::from(n - i) / f64::from(i + 1)).ln() + (p / (1.0 - p)).ln();
    }
    sum
}

/// The time of each process in one unit, divided by the time in the unit of the files on the same questions.
#[derive(Clone, Debug, PartialEq)]
pub struct Pace(Vec<f64>);

/// Times in the unit of the files, per configuration the median over the processes.
pub struct Usual(Vec<Option<f64>>);

impl Usual {
    /// From all times in that unit.
    pub fn of(times: &Times) -> Self {
        let median = |times: &Vec<(u32, f64)>| {
            Statistic::Median.of(&mut times.iter().map(|(_, ns)| *ns).collect::<Vec<_>>()).map(f64::ln)
        };
        Self(times.iter().map(median).collect())
    }

    /// How much longer than usual these took, as logarithms: for every configuration the number of the process and the value.
    fn beyond(&self, times: &Times) -> Vec<Vec<(u32, f64)>> {
        let of = |(times, usual): (&Vec<(u32, f64)>, &Option<f64>)| {
            usual.map_or_else(Vec::new, |usual| times.iter().map(|(process, ns)| (*process, ns.ln() - usual)).collect())
        };
        times.iter().zip(&self.0).map(of).collect()
    }
}

impl Pace {
    /// Of the `times` in one unit, each with the number of its process. What the `reference` took beyond its own usual time
    /// is divided out, on the same configuration and in the same process where it has one there: a slow machine slows both.
    pub fn of(times: &Times, usual: &Usual, reference: Option<(&Times, &Usual)>) -> Self {
        let mine = usual.beyond(times);
        let theirs = reference.map(|(times, usual)| usual.beyond(times));
        let mut sums: std::collections::BTreeMap<u32, (f64, usize)> = std::collections::BTreeMap::new();
        for (i, all) in mine.iter().enumerate() {
            for (process, beyond) in all {
                let of_reference = match &theirs {
                    None => Some(0.0),
                    Some(theirs) => at(&theirs[i], *process),
                };
                if let Some(of_reference) = of_reference {
                    let (sum, n) = sums.entry(*process).or_default();
                    *sum += beyond - of_reference;
                    *n += 1;
                }
            }
        }
        let told = sums.into_values().filter(|(_, n)| *n >= LEAST_QUESTIONS);
        Self(told.map(|(sum, n)| (sum / n as f64).exp()).collect())
    }

    /// Geometric mean of the processes, with the least and the most of them; absent when none was asked enough.
    pub fn spread(&self) -> Option<Interval> {
        let value = Statistic::Mean.of(&mut self.0.iter().map(|x| x.ln()).collect::<Vec<_>>())?.exp();
        let [lo, hi] = [Statistic::Min, Statistic::Max].map(|end| end.of(&mut self.0.clone()).unwrap_or(value));
        Some(Interval { value, lo, hi })
    }

    /// Whether it is slower or faster than in the other unit: every process in one takes more than [`FACTOR`] times as long as
    /// every process in the other. Absent otherwise.
    pub fn differs_from(&self, other: &Self) -> Option<Ordering> {
        let enough = self.0.len().min(other.0.len()) >= LEAST_PROCESSES;
        let (one, other) = self.spread().zip(other.spread()).filter(|_| enough)?;
        let slower = (one.lo > FACTOR * other.hi).then_some(Ordering::Greater);
        slower.or((other.lo > FACTOR * one.hi).then_some(Ordering::Less))
    }
}

/// The value of this process, or of the first that there is.
fn at(all: &[(u32, f64)], process: u32) -> Option<f64> {
    all.iter().find(|(of, _)| *of == process).or(all.first()).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `n` configurations that take 1,000 ns and more, by process so many times as long.
    fn times(n: usize, processes: &[(u32, f64)]) -> Vec<Vec<(u32, f64)>> {
        (0..n).map(|i| processes.iter().map(|(p, factor)| (*p, 1000.0 * (i + 1) as f64 * factor)).collect()).collect()
    }

    fn pace(n: usize, elsewhere: &[(u32, f64)]) -> [Pace; 2] {
        let official = times(n, &[(0, 0.95), (1, 1.0), (2, 1.05)]);
        let usual = Usual::of(&official);
        [Pace::of(&official, &usual, None), Pace::of(&times(n, elsewhere), &usual, None)]
    }

    #[test]
    fn a_time_depends_on_the_unit_when_every_process_is_beyond_the_factor() {
        let differs = |n, elsewhere: &[(u32, f64)]| {
            let [official, other] = pace(n, elsewhere);
            assert_eq!(official.differs_from(&other).map(Ordering::reverse), other.differs_from(&official));
            other.differs_from(&official)
        };
        assert_eq!(differs(100, &[(0, 1.7), (2, 1.8)]), Some(Ordering::Greater), "slower");
        assert_eq!(differs(100, &[(0, 0.5), (2, 0.6)]), Some(Ordering::Less), "faster");
        assert_eq!(differs(100, &[(0, 2.5), (2, 1.0)]), None, "one slow moment");
        assert_eq!(differs(100, &[(0, 1.5), (2, 1.55)]), None, "less than the factor above the slowest process");
        assert_eq!(differs(100, &[(0, 9.0)]), None, "a single process");
        assert_eq!(differs(LEAST_QUESTIONS - 1, &[(0, 9.0), (2, 9.0)]), None, "too few questions");
        assert_eq!(differs(LEAST_QUESTIONS, &[(0, 9.0), (2, 9.0)]), Some(Ordering::Greater));
    }

    #[test]
    fn what_slows_the_reference_as_well_is_the_machine() {
        let official = times(50, &[(4, 1.0), (5, 1.0)]);
        let usual = Usual::of(&official);
        let of = |mine: &[(u32, f64)], reference: &[(u32, f64)]| {
            Pace::of(&times(50, mine), &usual, Some((&times(50, reference), &usual))).spread().unwrap()
        };
        let close = |x: f64, y: f64| (x - y).abs() < 1e-9;
        let slow_machine = of(&[(0, 3.0), (2, 2.0)], &[(0, 3.0), (2, 2.0)]);
        assert!(close(slow_machine.lo, 1.0) && close(slow_machine.hi, 1.0), "{slow_machine:?}");
        let slow_algorithm = of(&[(0, 6.0), (2, 2.0)], &[(0, 3.0), (2, 2.0)]);
        assert!(close(slow_algorithm.hi, 2.0) && close(slow_algorithm.lo, 1.0), "{slow_algorithm:?}");
        // Where the reference was not asked nothing can be divided out, so nothing is said.
        let none: Vec<Vec<(u32, f64)>> = vec![Vec::new(); 50];
        assert_eq!(Pace::of(&official, &usual, Some((&none, &usual))).spread(), None);
    }

    #[test]
    fn wrong_answers_depend_on_the_unit_when_chance_does_not_explain_where_they_are() {
        let tally = |answers, wrong| Tally { answers, wrong, missed: 0 };
        let differs = |one: [u32; 2], other: [u32; 2]| {
            let [one, other] = [one, other].map(|[answers, wrong]| tally(answers, wrong));
            assert_eq!(one.differs(other), other.differs(one));
            one.differs(other)
        };
        assert!(differs([5000, 0], [1000, 3]), "three of three in a sixth of the answers");
        assert!(!differs([5000, 0], [1000, 2]), "two may be chance");
        assert!(differs([5000, 30], [1000, 0]), "none where five were to be expected");
        assert!(!differs([5000, 5], [1000, 0]), "one question, wrong in each of five processes");
        assert!(!differs([5000, 500], [1000, 100]), "the same share");
        assert!(differs([5000, 10], [1000, 100]), "wrong in both, but not alike");
        assert!(!differs([5000, 0], [0, 0]) && !differs([5000, 0], [1000, 0]));
        // A long run does not leave the range of numbers.
        assert!(differs([1_000_000, 400_000], [200_000, 200_000]));
    }

    #[test]
    fn the_tail_of_the_binomial_distribution() {
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y}");
        close(at_least(0, 10, 0.3), 1.0);
        close(at_least(10, 10, 0.5), 0.5f64.powi(10));
        close(at_least(2, 3, 0.5), 0.5);
    }
}
