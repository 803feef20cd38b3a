//! Ways to answer a question, each a point in a plot of time and error against triangles.

use ocb_core::configuration::{Configuration, Placed};
use ocb_core::lod::Interval;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::choice::{Ladders, Levels};
use crate::proxy::{self, Proxy};
use crate::question::Question;
use crate::share::Share;
use crate::timing::{Measured, Way, mean, ratio, times, way};
use crate::watch::Watch;

/// What kind of model a way asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = AdviceKind)]
pub enum Kind {
    /// The objects themselves, for their distance.
    Whole,
    /// The objects themselves, for no more than is asked.
    SameQuestion,
    /// The objects themselves: further apart than the tolerance, yes or no, instead of a distance.
    YesNo,
    /// Levels of detail; for a yes or no with the whole objects behind them.
    Levels,
    /// The advice, with the whole objects behind it.
    Advised,
    /// Convex hulls.
    Hulls,
    /// Boxes along the axes of the objects' files.
    Boxes,
}

/// A way to answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = AdvicePoint)]
pub struct Point {
    /// What is asked.
    pub kind: Kind,
    /// Numbers of the levels, coarsest stage first; none for what is no level.
    #[schema(value_type = Vec<Vec<u32>>)]
    pub stages: Vec<Levels>,
    /// Triangles of the first model asked, of both objects together.
    pub triangles: u32,
    /// Time of a query, microseconds.
    pub micros: Measured,
    /// How many times faster than the whole objects asked for their distance.
    pub faster: Measured,
    /// No answer was or could have been further off (half the widest interval); absent where nothing is certified.
    pub guaranteed_error: Option<f64>,
    /// The largest error seen.
    pub observed_error: Option<f64>,
    /// How often the whole objects had to be asked, or would have to be.
    pub falls_back: Option<Share>,
    /// "Not clear" of configurations that are clear, of these.
    pub false_alarms: Option<Share>,
    /// "Clear" of configurations that are not, of these.
    pub missed: Option<Share>,
    /// Can it not be wrong by more than it says?
    pub certified: bool,
    /// Is it the advice?
    pub advised: bool,
}

/// Nanoseconds of every configuration.
pub(crate) struct Times {
    pub(crate) distance: Vec<f64>,
    pub(crate) same_question: Vec<f64>,
    pub(crate) advised: Vec<f64>,
}

/// A way that is not measured yet.
struct Candidate<'a> {
    point: Point,
    way: Way<'a>,
}

/// All ways, measured; `None` when it was stopped.
pub(crate) fn points(
    ladders: &Ladders,
    question: Question,
    advised: &[Levels],
    sample: &[Placed],
    passes: usize,
    watch: &dyn Watch,
) -> Option<(Vec<Point>, Times)> {
    let (whole, just) = (ladders.pair([0, 0]), ladders.hybrid(&[]));
    let count = whole.triangles() as u32;
    let stages = ladders.diagonal().into_iter().skip(1).map(|levels| (Kind::Levels, vec![levels]));
    let stages: Vec<_> = stages.chain([(Kind::Advised, advised.to_vec())]).collect();
    let hybrids: Vec<_> = stages.iter().map(|(_, stages)| ladders.hybrid(stages)).collect();
    let make = [(Kind::Hulls, Proxy::hull as fn(&_) -> _), (Kind::Boxes, Proxy::around)];
    let proxies: Vec<(Kind, [Proxy; 2])> = make
        .into_iter()
        .filter_map(|(kind, make)| Some((kind, [make(&ladders.a[0].mesh)?, make(&ladders.b[0].mesh)?])))
        .collect();
    let mut all: Vec<Candidate> = Vec::new();
    let mut exact = blank(Kind::Whole, &[], count);
    exact.guaranteed_error = Some(0.0);
    all.push(Candidate { point: exact, way: way(|c| whole.distance(c, 0.0)) });
    let same = blank(Kind::SameQuestion, &[], count);
    let same = with_errors(same, question, sample, |c| whole.distance(c, width(question)));
    all.push(Candidate { point: same, way: way(|c| just.answer(question, c)) });
    for ((kind, stages), hybrid) in stages.iter().zip(&hybrids) {
        let first = hybrid.stages.first().unwrap_or(&whole);
        let mut point = blank(*kind, stages, first.triangles() as u32);
        point.advised = *kind == Kind::Advised;
        let fell_back = sample.par_iter().filter(|p| !stages.is_empty() && hybrid.answer(question, &p.configuration).1);
        point.falls_back = Some(Share::of(fell_back.count() as u32, sample.len() as u32));
        let alone = *kind == Kind::Levels && matches!(question, Question::Distance { .. });
        let asked = if alone { 0.0 } else { width(question) };
        point = with_errors(point, question, sample, |c| first.distance(c, asked));
        let way = match alone {
            true => way(move |c| first.distance(c, 0.0)),
            false => way(move |c| hybrid.answer(question, c)),
        };
        all.push(Candidate { point, way });
        if watch.stopped() {
            return None;
        }
    }
    if let Question::Distance { tolerance } = question {
        let way = way(move |c| whole.clearance(c, tolerance));
        all.push(Candidate { point: blank(Kind::YesNo, &[], count), way });
    }
    for (kind, [a, b]) in &proxies {
        let triangles = (a.triangles() + b.triangles()) as u32;
        let point = proxied(blank(*kind, &[], triangles), question, sample, |c| proxy::distance([a, b], c));
        let way = way(move |c| proxy::distance([a, b], c));
        all.push(Candidate { point, way });
    }
    let (mut points, ways): (Vec<Point>, Vec<Way>) = all.into_iter().map(|c| (c.point, c.way)).unzip();
    let mut measured = times(&ways, sample, passes, watch)?;
    for (point, own) in points.iter_mut().zip(&measured) {
        let micros = own.iter().map(|ns| ns / 1000.0).collect::<Vec<_>>();
        (point.micros, point.faster) = (mean(&micros), ratio(&measured[0], own));
    }
    let advised = points.iter().position(|p| p.advised).expect("the advice is among the ways");
    let advised = std::mem::take(&mut measured[advised]);
    let mut measured = measured.into_iter();
    let times = Times {
        distance: measured.next().unwrap_or_default(),
        same_question: measured.next().unwrap_or_default(),
        advised,
    };
    Some((points, times))
}

fn blank(kind: Kind, stages: &[Levels], triangles: u32) -> Point {
    let none = Measured { value: 0.0, lo: 0.0, hi: 0.0 };
    Point {
        kind,
        stages: stages.to_vec(),
        triangles,
        micros: none,
        faster: none,
        guaranteed_error: None,
        observed_error: None,
        falls_back: None,
        false_alarms: None,
        missed: None,
        certified: !matches!(kind, Kind::Hulls | Kind::Boxes),
        advised: false,
    }
}

/// How wide an interval may be.
fn width(question: Question) -> f64 {
    match question {
        Question::Distance { tolerance } => 2.0 * tolerance,
        Question::Clearance { .. } => 0.0,
    }
}

/// The errors of a way that gives distances, where these are asked.
fn with_errors(
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

/// What a proxy's distances are worth.
fn proxied(
    mut point: Point,
    question: Question,
    sample: &[Placed],
    ask: impl Fn(&Configuration) -> f64 + Sync,
) -> Point {
    let told: Vec<(f64, &Placed)> = sample.par_iter().map(|placed| (ask(&placed.configuration), placed)).collect();
    match question {
        Question::Distance { .. } => {
            point.observed_error = Some(told.iter().map(|(d, placed)| off(*d, placed)).fold(0.0, f64::max));
        }
        Question::Clearance { clearance } => {
            let share = |clear: bool| {
                let these = || told.iter().filter(|(_, placed)| (placed.truth.distance_lo > clearance) == clear);
                let wrong = these().filter(|(told, _)| (*told > clearance) != clear);
                Some(Share::of(wrong.count() as u32, these().count() as u32))
            };
            (point.false_alarms, point.missed) = (share(true), share(false));
        }
    }
    point
}

/// How far a number is from the oracle's, at most.
fn off(distance: f64, placed: &Placed) -> f64 {
    (distance - placed.truth.distance_lo).abs().max((distance - placed.truth.distance_hi).abs())
}
