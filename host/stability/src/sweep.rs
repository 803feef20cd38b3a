//! Where a family starts to fail: from the sweep over its parameter, and by bisection between two steps.

use serde::{Deserialize, Serialize};

use crate::{Harder, Parameter};

/// Between what holds and what fails, on one side of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// The last value before it, from the easy side, at which nothing fails; absent when the easiest fails already.
    pub holds: Option<f64>,
    /// The first value at which something fails.
    pub fails: f64,
}

/// The thresholds of a sweep, given whether something fails at each step: none when nothing does, two at most (a sweep
/// that gets harder to both sides).
pub fn thresholds(parameter: &Parameter, failed: &[bool]) -> Vec<Threshold> {
    let steps: Vec<(f64, bool)> = parameter.steps.iter().copied().zip(failed.iter().copied()).collect();
    let rising = |from: &mut dyn Iterator<Item = &(f64, bool)>| {
        let mut holds = None;
        for &(at, failed) in from {
            if failed {
                return Some(Threshold { holds, fails: at });
            }
            holds = Some(at);
        }
        None
    };
    let sides = match parameter.harder {
        Harder::Up => vec![rising(&mut steps.iter())],
        Harder::Down => vec![rising(&mut steps.iter().rev())],
        Harder::Outward => vec![
            rising(&mut steps.iter().rev().filter(|(at, _)| *at <= 0.0)),
            rising(&mut steps.iter().filter(|(at, _)| *at >= 0.0)),
        ],
    };
    let mut found: Vec<Threshold> = sides.into_iter().flatten().collect();
    found.dedup();
    found
}

/// Halves the way between what holds and what fails so many times; by ratio, for positive values.
pub fn bisect(between: Threshold, times: u32, mut fails: impl FnMut(f64) -> bool) -> Threshold {
    let Threshold { holds: Some(mut holds), fails: mut failing } = between else { return between };
    for _ in 0..times {
        let middle = (holds * failing).sqrt();
        if !(middle > holds.min(failing) && middle < holds.max(failing)) {
            break;
        }
        if fails(middle) {
            failing = middle;
        } else {
            holds = middle;
        }
    }
    Threshold { holds: Some(holds), fails: failing }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [f64; 5] = [1e-4, 1e-3, 1e-2, 1e-1, 1.0];

    fn parameter(harder: Harder, steps: &'static [f64]) -> Parameter {
        Parameter { name: "", steps, harder, continuous: true }
    }

    #[test]
    fn the_threshold_is_met_from_the_easy_side() {
        let found = |harder, failed: [bool; 5]| thresholds(&parameter(harder, &STEPS), &failed);
        let one = |holds, fails| vec![Threshold { holds, fails }];
        assert_eq!(found(Harder::Down, [true, true, false, false, false]), one(Some(1e-2), 1e-3));
        // What holds again behind the first failure is luck.
        assert_eq!(found(Harder::Down, [false, true, false, true, false]), one(Some(1.0), 1e-1));
        assert_eq!(found(Harder::Up, [true, false, false, false, false]), one(None, 1e-4));
        assert_eq!(found(Harder::Up, [false; 5]), []);
    }

    #[test]
    fn a_sweep_to_both_sides_has_two_ends() {
        let parameter = parameter(Harder::Outward, &[-20.0, -10.0, 0.0, 10.0, 20.0]);
        let [low, high] = [Threshold { holds: Some(-10.0), fails: -20.0 }, Threshold { holds: Some(0.0), fails: 10.0 }];
        assert_eq!(thresholds(&parameter, &[true, false, false, true, true]), [low, high]);
        assert_eq!(thresholds(&parameter, &[false, false, false, true, true]), [high]);
        let all = Threshold { holds: None, fails: 0.0 };
        assert_eq!(thresholds(&parameter, &[false, false, true, false, false]), [all]);
    }

    #[test]
    fn bisection_closes_in() {
        let mut asked = 0;
        let found = bisect(Threshold { holds: Some(1e-3), fails: 1e-4 }, 8, |at| {
            asked += 1;
            at < 3e-4
        });
        assert_eq!(asked, 8);
        assert!(found.fails < 3e-4 && found.holds.unwrap() >= 3e-4 && found.holds.unwrap() / found.fails < 1.02);
        let none = Threshold { holds: None, fails: 1.0 };
        assert_eq!(bisect(none, 8, |_| true), none);
    }
}
