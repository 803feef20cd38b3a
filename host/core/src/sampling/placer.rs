//! Positions with whatever separation is wanted: apart, crossing, or the steps of the ladder in turn.

use nalgebra::{Matrix3, Vector3};

use super::SamplingError;
use super::approach::{Approach, bounds, within};
use super::closer::closer;
use super::nearby::{Nearby, look};
use super::penetration::deepen;
use super::window::Window;
use crate::configuration::{Configuration, Placed, Separation};
use crate::oracle::{Pair, Shape, U32};

/// Rays from outside end here when less is wanted: 2 tau32 as a share of S.
const COARSE: Separation = Separation::Step { of_size: 64.0 * U32 };

/// A little less than [`Separation::SMALLEST_STEP`], so that this may be written with two digits.
pub(super) const LEAST_STEP: f64 = 7e-15;

/// What all rays of a plan share.
#[derive(Clone, Debug)]
pub(super) struct Placer<'a> {
    pair: Pair<'a>,
    /// One goal, or those of the ladder.
    goals: Vec<Goal<'a>>,
}

#[derive(Clone, Debug)]
struct Goal<'a> {
    approach: Approach<'a>,
    /// So far apart at first.
    window: Window,
    /// The approach ends further away than the window.
    coarse: bool,
    /// From there so deep, as a share of S.
    depth: Option<f64>,
}

impl<'a> Placer<'a> {
    pub(super) fn new(a: &'a Shape, b: &'a Shape, separation: Separation) -> Result<Self, SamplingError> {
        check(separation)?;
        let (lo, hi) = bounds(a);
        let longest_side = (hi - lo).amax();
        let goal = |separation| {
            let (apart, depth) = match separation {
                Separation::Step { of_size } if of_size < 0.0 => {
                    (Separation::Step { of_size: -of_size }, Some(-of_size))
                }
                apart => (apart, None),
            };
            let coarse =
                matches!((apart, COARSE), (Separation::Step { of_size: x }, Separation::Step { of_size: y }) if x < y);
            let approach = Approach::new(a, b, if coarse { COARSE } else { apart });
            Goal { approach, window: Window::new(apart, longest_side), coarse, depth }
        };
        let goals = match separation {
            Separation::Ladder => (0..Separation::LADDER.len() as u64).map(|i| goal(separation.of(i))).collect(),
            one => vec![goal(one)],
        };
        Ok(Self { pair: Pair::new(a, b), goals })
    }

    /// The target of a ray through the centres of both bounding boxes, from outside.
    pub(super) fn place(&self, target: Target, direction: &Vector3<f64>, rotation: &Matrix3<f64>) -> Option<Placed> {
        let goal = self.goal(target);
        let mut placed = goal.approach.place(direction, rotation, target.place)?;
        if goal.coarse {
            placed = closer(&self.pair, &placed, direction, &goal.window.at(target.place))?;
        }
        self.finish(target, placed, direction)
    }

    /// The target from a start that is free and nearer to the goal than `reach`: B goes straight toward A's
    /// nearest point, and the nearest points go toward each other. `None` when the start is not such a place.
    pub(super) fn descend(&self, target: Target, start: &Configuration, reach: f64) -> Option<Descent> {
        let window = self.goal(target).window.at(target.place);
        let (wanted, half) = window.aim(self.pair.scene_size(start));
        let most = wanted + half + reach;
        let Nearby::At { distance, direction, pair } = look(&self.pair, start, wanted + half, most) else {
            return None;
        };
        let mut way = distance - wanted;
        // Steps are shares of S, which changes with the way, and all numbers are rounded.
        for _ in 0..6 {
            let mut configuration = *start;
            configuration.pose_b.translation -= direction * way;
            let truth = self.pair.truth_near(&configuration, Some(pair));
            let (wanted, half) = window.aim(self.pair.scene_size(&configuration));
            if within(&truth, wanted, half) {
                let placed =
                    Placed { configuration, truth, rounded: None, root_index: 0, wanted: Some(window.separation) };
                return Some(Descent { placed, direction });
            }
            way += (truth.distance_lo + truth.distance_hi) / 2.0 - wanted;
        }
        None
    }

    /// From a descent to the goal, and whether the position is the first of its ray through the centres.
    pub(super) fn arrive(
        &self,
        target: Target,
        descent: &Descent,
        from_centre: &Vector3<f64>,
        near: f64,
    ) -> Option<Placed> {
        let mut placed = descent.placed;
        let pose = &placed.configuration.pose_b;
        let direction = from_centre.try_normalize(0.0).unwrap_or_else(Vector3::z);
        let first = self.goal(target).approach.place(&direction, &pose.linear, target.place);
        let is_first = first.is_some_and(|f| (f.configuration.pose_b.translation - pose.translation).norm() <= near);
        placed.root_index = u32::from(!is_first);
        self.finish(target, placed, &descent.direction)
    }

    /// The largest distance that is looked for, in a scene of this size S.
    pub(super) fn most(&self, size: f64) -> f64 {
        self.goals.iter().map(|goal| goal.window.most(size)).fold(0.0, f64::max)
    }

    /// Which of the goals a target is.
    pub(super) fn goal_number(&self, target: Target) -> u64 {
        target.index % self.goals.len() as u64
    }

    fn goal(&self, target: Target) -> &Goal<'a> {
        &self.goals[self.goal_number(target) as usize]
    }

    fn finish(&self, target: Target, placed: Placed, direction: &Vector3<f64>) -> Option<Placed> {
        match self.goal(target).depth {
            Some(depth) => deepen(&self.pair, &placed, direction, depth, target.place),
            None => Some(placed),
        }
    }
}

/// What one configuration shall meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    /// Its number, which says the step of the ladder.
    pub(super) index: u64,
    /// Where in the window, from 0 to 1.
    pub(super) place: f64,
}

/// Where B came from a free start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    pub(super) placed: Placed,
    /// From A's nearest point to B's.
    direction: Vector3<f64>,
}

/// Can it be looked for?
pub fn check(separation: Separation) -> Result<(), SamplingError> {
    // Written so that NaN fails.
    match separation {
        Separation::Relative { distance } if !(0.0..=1000.0).contains(&distance) => {
            Err(SamplingError::RelativeDistance(distance))
        }
        Separation::Step { of_size } if !(LEAST_STEP..=Separation::LARGEST_STEP).contains(&of_size.abs()) => {
            Err(SamplingError::Step(of_size))
        }
        _ => Ok(()),
    }
}
