//! Adversarial search: from anywhere toward where methods fail.
//!
//! Uniform poses hardly ever stand close to the decision. This search takes one, follows the line between the nearest points
//! and halves the gap again and again, to both sides of touching; it prefers poses at which thin triangles face each other;
//! and from the costliest question so far it tries its neighbours. What is asked is counted; the truth is not.

use nalgebra::Vector3;
use ocb_core::configuration::{Configuration, Truth};
use ocb_core::oracle::Pair;
use ocb_core::pose::Pose;

use crate::draw::Draw;

/// What came of one question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heard {
    /// The answer is wrong, or there is none.
    pub failed: bool,
    /// What it took: time, or tests.
    pub cost: f64,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Questions up to and with the first failure.
    pub first: Option<(u32, Configuration)>,
    /// The costliest question, and what it took.
    pub costliest: (f64, Configuration),
    /// Questions asked.
    pub asked: u32,
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// A wrong answer: the search ends with the first.
    Failure,
    /// The longest time.
    Cost,
}

/// Steps toward touching from one pose; each takes the gap to a tenth.
const CLOSER: u32 = 10;
/// Poses of which the one between the thinnest triangles is taken.
const TRIED: usize = 4;

/// Poses drawn alike from a box around A, for comparison.
pub fn uniform(pair: &Pair, seed: u64, most: u32, goal: Goal, ask: &mut dyn FnMut(&Configuration) -> Heard) -> Found {
    let mut draw = Draw::new(seed);
    let mut found = Ledger::new(goal, most);
    while !found.done() {
        let configuration = anywhere(pair, &mut draw);
        found.hear(configuration, ask(&configuration));
    }
    found.into()
}

/// The search.
pub fn climb(pair: &Pair, seed: u64, most: u32, goal: Goal, ask: &mut dyn FnMut(&Configuration) -> Heard) -> Found {
    let mut draw = Draw::new(seed);
    let mut found = Ledger::new(goal, most);
    while !found.done() {
        if goal == Goal::Cost {
            // A quarter anywhere, then around the costliest so far.
            let best = found.best.filter(|_| found.asked >= most / 4).map(|(_, best)| best);
            let configuration = match best {
                Some(best) => neighbour(best, pair, &mut draw),
                None => anywhere(pair, &mut draw),
            };
            found.hear(configuration, ask(&configuration));
            continue;
        }
        let (mut here, mut truth) = thinnest(pair, &mut draw);
        found.hear(here, ask(&here));
        for _ in 0..CLOSER {
            let Some(next) = closer(&here, &truth) else { break };
            if found.done() {
                break;
            }
            found.hear(next, ask(&next));
            (here, truth) = (next, pair.truth(&next));
            // As far on the other side of touching.
            let through = beyond(&here, &truth);
            if let (Some(through), false) = (through, found.done()) {
                found.hear(through, ask(&through));
            }
        }
    }
    found.into()
}

struct Ledger {
    goal: Goal,
    most: u32,
    asked: u32,
    first: Option<(u32, Configuration)>,
    best: Option<(f64, Configuration)>,
}

impl Ledger {
    fn new(goal: Goal, most: u32) -> Self {
        Self { goal, most: most.max(1), asked: 0, first: None, best: None }
    }

    fn done(&self) -> bool {
        self.asked >= self.most || (self.goal == Goal::Failure && self.first.is_some())
    }

    fn hear(&mut self, configuration: Configuration, heard: Heard) {
        self.asked += 1;
        if heard.failed {
            self.first.get_or_insert((self.asked, configuration));
        }
        if self.best.is_none_or(|(cost, _)| heard.cost > cost) {
            self.best = Some((heard.cost, configuration));
        }
    }
}

impl From<Ledger> for Found {
    fn from(ledger: Ledger) -> Self {
        let costliest = ledger.best.expect("at least one question is asked");
        Self { first: ledger.first, costliest, asked: ledger.asked }
    }
}

/// Somewhere around A, turned any way.
fn anywhere(pair: &Pair, draw: &mut Draw) -> Configuration {
    let reach = |mesh: &[nalgebra::Point3<f64>]| mesh.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let far = reach(pair.a().positions()) + reach(pair.b().positions());
    Configuration {
        pose_a: Pose::identity(),
        pose_b: Pose { linear: draw.rotation(), translation: draw.vector() * far },
    }
}

/// Of some poses, the one at which the nearest triangles are thinnest.
fn thinnest(pair: &Pair, draw: &mut Draw) -> (Configuration, Truth) {
    let some = (0..TRIED).map(|_| {
        let here = anywhere(pair, draw);
        (here, pair.truth(&here))
    });
    let thin = |truth: &Truth| {
        let width = |corners: [nalgebra::Point3<f64>; 3]| {
            let (u, v) = (corners[1] - corners[0], corners[2] - corners[0]);
            u.cross(&v).norm() / u.norm_squared().max(v.norm_squared()).max(f64::MIN_POSITIVE)
        };
        let corners = |shape: &ocb_core::oracle::Shape, t: u32| {
            shape.triangles()[t as usize].map(|i| shape.positions()[i as usize])
        };
        width(corners(pair.a(), truth.witness.triangle_a)).min(width(corners(pair.b(), truth.witness.triangle_b)))
    };
    // A pose in the middle of a collision has no line to follow.
    let apart = |truth: &Truth| if truth.hit { 1.0 } else { 0.0 };
    some.min_by(|(_, one), (_, other)| (apart(one) + thin(one)).total_cmp(&(apart(other) + thin(other))))
        .expect("some poses")
}

/// A tenth of the gap.
fn closer(here: &Configuration, truth: &Truth) -> Option<Configuration> {
    shifted(here, truth, 0.9)
}

/// As deep in each other as they were apart.
fn beyond(here: &Configuration, truth: &Truth) -> Option<Configuration> {
    shifted(here, truth, 2.0)
}

fn shifted(here: &Configuration, truth: &Truth, share: f64) -> Option<Configuration> {
    let line: Vector3<f64> = truth.witness.point_a - truth.witness.point_b;
    if truth.hit || line == Vector3::zeros() {
        return None;
    }
    let mut next = *here;
    next.pose_b.translation += line * share;
    Some(next)
}

/// Close to a pose, at any of several scales.
fn neighbour(mut here: Configuration, pair: &Pair, draw: &mut Draw) -> Configuration {
    let scale = 0.1 * 10f64.powi(-(draw.below(3) as i32));
    here.pose_b.translation += draw.vector() * scale * pair.scene_size(&here);
    here
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ocb_core::oracle::Shape;
    use ocb_core::stock;

    use super::*;

    fn knot() -> Shape {
        Shape::new(Arc::new(stock::generate("torus-knot", 500).expect("a stock object")))
    }

    /// Calls everything nearer than a hundred-thousandth a collision.
    fn hasty(pair: &Pair, c: &Configuration) -> Heard {
        let truth = pair.truth(c);
        Heard { failed: !truth.hit && truth.distance_lo < 1e-5, cost: 0.0 }
    }

    #[test]
    fn a_fault_is_found_with_a_fifth_of_the_questions() {
        const MOST: u32 = 2000;
        let shape = knot();
        let pair = Pair::new(&shape, &shape);
        let asked = |search: &dyn Fn(u64) -> Found| (0..6).map(|seed| search(seed).asked).sum::<u32>();
        let climbing = asked(&|seed| climb(&pair, seed, MOST, Goal::Failure, &mut |c| hasty(&pair, c)));
        // Stopped after so many: it would need more.
        let drawing = asked(&|seed| uniform(&pair, seed, MOST, Goal::Failure, &mut |c| hasty(&pair, c)));
        assert!(5 * climbing <= drawing, "{climbing} questions by climbing, {drawing} by drawing");
        let found = climb(&pair, 1, MOST, Goal::Failure, &mut |c| hasty(&pair, c)).first.expect("a failure").1;
        assert!(hasty(&pair, &found).failed);
    }

    #[test]
    fn the_costliest_question_is_costlier() {
        let shape = knot();
        let pair = Pair::new(&shape, &shape);
        let mut cost = |c: &Configuration| Heard { failed: false, cost: pair.contacts(c).len() as f64 };
        let most = |found: Found| found.costliest.0;
        let climbing: f64 = (0..3).map(|seed| most(climb(&pair, seed, 200, Goal::Cost, &mut cost))).sum();
        let drawing: f64 = (0..3).map(|seed| most(uniform(&pair, seed, 200, Goal::Cost, &mut cost))).sum();
        assert!(climbing > drawing, "{climbing} contacts by climbing, {drawing} by drawing");
    }
}
