//! The controls of a run: drawn on all CPUs before anything is measured, and what came of them.

use std::ops::Range;

use ocb_core::guessing::Guessing;
use ocb_core::record::Verdict;
use ocb_core::sampling::controls::{self, Control, LEAST, Plan};
use rayon::prelude::*;

use super::summary::Seen;
use super::{is_coherent, weave};
use crate::model::{Controls, Unranked, UnrankedCause};
use crate::pairing::Pairing;

/// The controls that go with the first `measured` configurations of the set's own order, in the order in which they are asked;
/// fewer where the objects allow no more. `stopped` ends it early.
pub fn draw(
    plan: &Plan,
    pairing: &Pairing,
    of: &ocb_core::configuration::ConfigurationSet,
    measured: usize,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Vec<Control> {
    let n = controls::count(measured as u64);
    let coherent = is_coherent(&of.method);
    // A control of a trajectory departs from a frame of its own block, so that it can stand behind it.
    let blocks = if coherent { weave::blocks(measured, n as usize) } else { Vec::new() };
    let among = |number: u64| -> Range<usize> {
        blocks.get(number as usize).map_or(0..of.placed.len(), |block| {
            let start = block.start.min(measured - 1);
            start..block.end.max(start + 1)
        })
    };
    let certified = |control: Control| Control { placed: pairing.certified(control.placed), ..control };
    let one = |number: u64| if stopped() { None } else { plan.draw(number, among(number)).map(certified) };
    let mut all: Vec<Control> = (0..n).into_par_iter().filter_map(one).collect();
    if coherent {
        all.sort_by_key(|control| control.from);
    }
    all
}

/// What an algorithm made of the controls: for each the gravest verdict, absent where it was not asked.
pub fn summary(verdicts: &[Option<Verdict>], asked: &Seen) -> Controls {
    let of: &[Control] = &asked.controls;
    let answered = || verdicts.iter().zip(of).filter_map(|(verdict, control)| Some(((*verdict)?, *control)));
    let all: Vec<Control> = answered().map(|(_, control)| control).collect();
    let count = |is: fn(Verdict) -> bool| answered().filter(|(verdict, _)| is(*verdict)).count() as u32;
    let hit = |c: &&Control| asked.pair.asked(&c.placed.configuration, &c.placed.truth, asked.semantics).hit;
    let guessing = Guessing {
        controls: all.len() as u32,
        alike: controls::alike(&asked.pair, &all, asked.query, asked.semantics),
    };
    Controls {
        n: all.len() as u32,
        of: of.len() as u32,
        crossing: all.iter().filter(hit).count() as u32,
        wrong: count(Verdict::is_wrong),
        silent: count(Verdict::is_silent),
        guess: guessing.keeps_rank(0.5),
    }
}

/// Why there is no rank, as far as controls tell, of an algorithm that did all that it was asked.
pub fn unranked(controls: &Controls) -> Option<Unranked> {
    let Controls { n, of, wrong, silent, .. } = *controls;
    let cause = if wrong > 0 {
        UnrankedCause::WrongControls { wrong, n }
    } else if silent > 0 {
        UnrankedCause::SilentControls { silent, n }
    } else if n < LEAST {
        UnrankedCause::FewControls { n, of, least: LEAST }
    } else {
        return None;
    };
    Some(cause.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_one_weighs_more_than_a_missing_one_and_that_more_than_too_few() {
        let why = |n, wrong, silent| {
            let controls = Controls { n, of: 30, crossing: 0, wrong, silent, guess: 0.0 };
            unranked(&controls).map(|unranked| unranked.cause)
        };
        assert_eq!(why(30, 0, 0), None);
        assert_eq!(why(LEAST, 0, 0), None);
        assert_eq!(why(20, 1, 1), Some(UnrankedCause::WrongControls { wrong: 1, n: 20 }));
        assert_eq!(why(20, 0, 1), Some(UnrankedCause::SilentControls { silent: 1, n: 20 }));
        assert_eq!(why(20, 0, 0), Some(UnrankedCause::FewControls { n: 20, of: 30, least: LEAST }));
        let few = |n, of| Unranked::from(UnrankedCause::FewControls { n, of, least: LEAST }).message;
        assert!(few(20, 30).contains("increase the budget") && few(9, 9).contains("these objects"));
    }
}
