//! The distance of two bodies as an interval that certainly holds, and when an answer is kept.

use ocb_core::configuration::Configuration;
use ocb_core::lod::Interval;
use ocb_core::oracle::{Pair, Shape};

use super::body::{Body, Contains, ROUNDING};
use crate::model::ReduceTerms;

/// The distance of two bodies; 0 of bodies that collide.
pub fn between([a, b]: [&Body; 2], configuration: &Configuration) -> Interval {
    let Configuration { pose_a, pose_b } = configuration;
    let outer = distance([&a.outer, &b.outer], configuration);
    // Where the surfaces meet, the distance is 0 whatever is inside.
    let contained = match outer.hi {
        0.0 => [Contains::No; 2],
        _ => [a.contains(pose_a, b, pose_b), b.contains(pose_b, a, pose_a)],
    };
    let lo = if contained == [Contains::No; 2] { outer.lo } else { 0.0 };
    let hi = if contained.contains(&Contains::Yes) {
        0.0
    } else if a.is_between() || b.is_between() {
        distance([a.inner(), b.inner()], configuration).hi
    } else {
        outer.hi
    };
    // What stands for an object is placed by a product of poses elsewhere, and rounded again.
    let size = a.radius + a.centre.coords.norm() + b.radius + b.centre.coords.norm();
    let rounding = ROUNDING * (size + pose_a.translation.norm() + pose_b.translation.norm());
    Interval { lo: (lo - rounding).max(0.0), hi: if hi > 0.0 { hi + rounding } else { 0.0 } }
}

fn distance([a, b]: [&Shape; 2], configuration: &Configuration) -> Interval {
    let truth = Pair::new(a, b).truth(configuration);
    Interval { lo: truth.distance_lo, hi: truth.distance_hi }
}

/// The distance of the balls around two bodies: a lower bound that costs nothing.
pub fn of_balls([a, b]: [&Body; 2], configuration: &Configuration) -> f64 {
    let [p, q] = [configuration.pose_a.apply(&a.centre), configuration.pose_b.apply(&b.centre)];
    ((p - q).norm() * (1.0 - ROUNDING) - a.radius - b.radius).max(0.0)
}

/// Is the answer about what stands for the objects (`reduced`) the right one for a distance within the tolerance of the objects'
/// own (`truth`), here and wherever one object is moved relative to the other so that no point of it, or of what stands for it,
/// moves by more than `near`? `limit` is the distance up to which the answer to a yes-or-no query is yes; absent where the distance
/// itself is asked.
pub fn keep(terms: &ReduceTerms, limit: Option<f64>, truth: Interval, reduced: Interval) -> bool {
    let ReduceTerms { tolerance, near, outside_only, .. } = *terms;
    if let Some(limit) = limit {
        let no = truth.lo - near > limit && reduced.lo - near > limit;
        // What contains the objects is never farther apart than they are.
        let yes = truth.hi + near <= limit && (outside_only || reduced.hi + near <= limit);
        if no || yes {
            return true;
        }
    }
    // Either distance changes by no more than the points move.
    let under = truth.hi - reduced.lo + 2.0 * near <= tolerance;
    under && (outside_only || reduced.hi - truth.lo + 2.0 * near <= tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(lo: f64, hi: f64) -> Interval {
        Interval { lo, hi }
    }

    #[test]
    fn an_answer_is_kept_within_the_tolerance_or_on_the_same_side() {
        let both = ReduceTerms { tolerance: 1.0, near: 0.0, outside_only: false, frontier: false };
        // Distances.
        assert!(keep(&both, None, at(5.0, 5.0), at(4.5, 5.5)));
        assert!(!keep(&both, None, at(5.0, 5.0), at(3.5, 3.5)) && !keep(&both, None, at(5.0, 5.0), at(6.5, 6.5)));
        // Collisions: a far pair may come nearer by anything, and a hit may become a gap within the tolerance.
        assert!(keep(&both, Some(0.0), at(5.0, 5.0), at(0.1, 0.1)));
        assert!(!keep(&both, Some(0.0), at(5.0, 5.0), at(0.0, 0.0)));
        assert!(
            keep(&both, Some(0.0), at(0.0, 0.0), at(0.9, 0.9)) && !keep(&both, Some(0.0), at(0.0, 0.0), at(1.1, 1.1))
        );
        assert!(keep(&both, Some(0.0), at(0.9, 0.9), at(0.0, 0.0)));
        // A limit.
        assert!(
            keep(&both, Some(3.0), at(1.0, 1.0), at(2.9, 2.9)) && !keep(&both, Some(3.0), at(1.0, 1.0), at(3.1, 3.1))
        );
        let outside = ReduceTerms { outside_only: true, ..both };
        assert!(!keep(&outside, Some(0.0), at(5.0, 5.0), at(0.0, 0.0)));
        // An interval of what contains the objects may be wider than what is known of them.
        assert!(keep(&outside, Some(0.0), at(0.0, 0.0), at(0.0, 9.0)));
    }

    #[test]
    fn a_neighbourhood_asks_for_more_room() {
        let terms = ReduceTerms { tolerance: 1.0, near: 0.2, outside_only: false, frontier: false };
        assert!(keep(&terms, None, at(5.0, 5.0), at(4.5, 4.5)) && !keep(&terms, None, at(5.0, 5.0), at(4.3, 4.3)));
        assert!(
            keep(&terms, Some(0.0), at(5.0, 5.0), at(0.3, 0.3)) && !keep(&terms, Some(0.0), at(5.0, 5.0), at(0.1, 0.1))
        );
    }
}
