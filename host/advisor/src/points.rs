//! Ways to answer a question, measured on the same configurations.

use std::cell::RefCell;

use ocb_advice::{Kind, LeftOut, Levels, Point, Question, Share, Watch};
use ocb_core::configuration::{Configuration, Placed};
use ocb_core::lod::Interval;
use rayon::prelude::*;

use crate::choice::Ladders;
use crate::errors::{certified, seen};
use crate::proxy::{self, Proxy};
use crate::question::Told;
use crate::stand_ins::{leave_out, stand_ins};
use crate::timing::{Way, mean, ratio, times, way, way_of};

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

/// All ways, measured.
pub(crate) struct Plot {
    pub(crate) points: Vec<Point>,
    pub(crate) left_out: Vec<LeftOut>,
    pub(crate) times: Times,
}

/// All ways; `None` when it was stopped.
pub(crate) fn points(
    ladders: &Ladders,
    question: Question,
    advised: &[Levels],
    sample: &[Placed],
    passes: usize,
    watch: &dyn Watch,
) -> Option<Plot> {
    let (whole, just) = (ladders.pair([0, 0]), ladders.hybrid(&[]));
    let count = whole.triangles() as u32;
    let stages = ladders.diagonal().into_iter().skip(1).map(|levels| (Kind::Levels, vec![levels]));
    let stages: Vec<_> = stages.chain([(Kind::Advised, advised.to_vec())]).collect();
    let hybrids: Vec<_> = stages.iter().map(|(_, stages)| ladders.hybrid(stages)).collect();
    let meshes = [&ladders.a[0].mesh, &ladders.b[0].mesh];
    let (stand_ins, mut left_out) = stand_ins(meshes, question, sample, watch)?;
    let make = [(Kind::Hulls, "convex hulls", Proxy::hull as fn(&_) -> _), (Kind::Boxes, "boxes", Proxy::around)];
    let mut proxies: Vec<(Kind, [Proxy; 2])> = Vec::new();
    for (kind, name, make) in make {
        match meshes.map(|mesh| make(mesh)) {
            [Some(a), Some(b)] => proxies.push((kind, [a, b])),
            [a, _] => {
                let which = if a.is_none() { "A" } else { "B" };
                leave_out(&mut left_out, name.to_owned(), format!("there is none around {which}"));
            }
        }
    }
    let mut all: Vec<Candidate> = Vec::new();
    let mut exact = Point::new(Kind::Whole, &[], count);
    exact.guaranteed_error = Some(0.0);
    all.push(Candidate { point: exact, way: way(|c| whole.distance(c, 0.0)) });
    let same = Point::new(Kind::SameQuestion, &[], count);
    let same = certified(same, question, sample, |c| whole.distance(c, width(question)));
    all.push(Candidate { point: same, way: way(|c| just.answer(question, c)) });
    for ((kind, stages), hybrid) in stages.iter().zip(&hybrids) {
        let first = hybrid.stages.first().unwrap_or(&whole);
        let mut point = Point::new(*kind, stages, first.triangles() as u32);
        point.advised = *kind == Kind::Advised;
        let fell_back = sample.par_iter().filter(|p| !stages.is_empty() && hybrid.answer(question, &p.configuration).1);
        point.falls_back = Some(Share::of(fell_back.count() as u32, sample.len() as u32));
        let alone = *kind == Kind::Levels && matches!(question, Question::Distance { .. });
        let asked = if alone { 0.0 } else { width(question) };
        point = certified(point, question, sample, |c| first.distance(c, asked));
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
        all.push(Candidate { point: Point::new(Kind::YesNo, &[], count), way });
    }
    for (kind, [a, b]) in &proxies {
        let triangles = (a.triangles() + b.triangles()) as u32;
        let tell = move |configuration: &Configuration| {
            let distance = proxy::distance([a, b], configuration);
            match question {
                Question::Distance { .. } => Told::Distance(Interval { lo: distance, hi: distance }),
                Question::Clearance { clearance } => Told::Clear(distance > clearance),
            }
        };
        let told: Vec<_> = sample.par_iter().map(|placed| Some(tell(&placed.configuration))).collect();
        all.push(Candidate { point: seen(Point::new(*kind, &[], triangles), question, sample, &told), way: way(tell) });
    }
    for stand_in in stand_ins {
        let mut point = Point::new(stand_in.kind, &[], stand_in.elements as u32);
        point.algorithm = Some(stand_in.algorithm);
        let asked: Vec<bool> = stand_in.told.iter().map(Option::is_some).collect();
        let some = asked.iter().filter(|asked| **asked).count();
        point.asked = (some < sample.len()).then_some(some as u32);
        let ask = RefCell::new(stand_in.ask);
        let way = way_of(asked, move |c| (ask.borrow_mut())(c));
        all.push(Candidate { point: seen(point, question, sample, &stand_in.told), way });
    }
    let (mut points, ways): (Vec<Point>, Vec<Way>) = all.into_iter().map(|c| (c.point, c.way)).unzip();
    let configurations: Vec<Configuration> = sample.iter().map(|placed| placed.configuration).collect();
    let mut measured = times(&ways, &configurations, passes, watch)?;
    for (point, own) in points.iter_mut().zip(&measured) {
        let both = || own.iter().zip(&measured[0]).filter_map(|(own, whole)| Some([(*own)?, (*whole)?]));
        let [own, whole]: [Vec<f64>; 2] = [0, 1].map(|i| both().map(|both| both[i]).collect());
        let micros: Vec<f64> = own.iter().map(|ns| ns / 1000.0).collect();
        (point.micros, point.faster) = (mean(&micros), ratio(&whole, &own));
    }
    let advised = points.iter().position(|p| p.advised).expect("the advice is among the ways");
    // All configurations of these.
    let mut of = |way: usize| std::mem::take(&mut measured[way]).into_iter().flatten().collect();
    let times = Times { distance: of(0), same_question: of(1), advised: of(advised) };
    Some(Plot { points, left_out, times })
}

/// How wide an interval may be.
fn width(question: Question) -> f64 {
    match question {
        Question::Distance { tolerance } => 2.0 * tolerance,
        Question::Clearance { .. } => 0.0,
    }
}
