//! What the answers of a way are worth, seen beside the truth.

use ocb_advice::{Point, Question, Share};
use ocb_core::configuration::{Configuration, Placed};
use ocb_core::lod::Interval;
use rayon::prelude::*;

use crate::question::Told;

/// The errors of a way that gives certified distances, where these are asked.
pub(crate) fn certified(
    mut point: Point,
    question: Question,
    sample: &[Placed],
    ask: impl Fn(&Configuration) -> Interval + Sync,
) -> Point {
    if matches!(question, Question::Distance { .. }) {
        let errors = sample.par_iter().map(|placed| {
            let found = ask(&placed.configuration);
            (found.width() / 2.0, off(found.middle(), placed))
        });
        let (guaranteed, observed) = errors.reduce(|| (0.0, 0.0), |x, y| (x.0.max(y.0), x.1.max(y.1)));
        (point.guaranteed_error, point.observed_error) = (Some(guaranteed), Some(observed));
    }
    point
}

/// The errors that were seen of a way which promises nothing: of distances the largest, of "is it clear?" both kinds of
/// wrong answers, each counted among the configurations where it is possible.
pub(crate) fn seen(mut point: Point, question: Question, sample: &[Placed], told: &[Option<Told>]) -> Point {
    let answers = || told.iter().zip(sample).filter_map(|(told, placed)| Some((told.as_ref()?, placed)));
    let distances = answers().filter_map(|(told, placed)| match told {
        Told::Distance(found) => Some(off(found.middle(), placed)),
        Told::Clear(_) => None,
    });
    point.observed_error = distances.reduce(f64::max);
    let share = |clear: bool| {
        let these = || {
            answers().filter_map(|(told, placed)| match told {
                Told::Clear(told) => Some(*told).filter(|_| (placed.truth.distance_lo > question.reach()) == clear),
                Told::Distance(_) => None,
            })
        };
        Share::of(these().filter(|told| *told != clear).count() as u32, these().count() as u32)
    };
    if told.iter().any(|told| matches!(told, Some(Told::Clear(_)))) {
        (point.false_alarms, point.missed) = (Some(share(true)), Some(share(false)));
    }
    point
}

/// How far a number is from the oracle's, at most.
fn off(distance: f64, placed: &Placed) -> f64 {
    (distance - placed.truth.distance_lo).abs().max((distance - placed.truth.distance_hi).abs())
}
