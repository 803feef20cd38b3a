//! Judging what a recorded program was answered.
//!
//! Its library knows spheres, boxes, cylinders and capsules; the oracle knows triangles. So the truth about such an object is an
//! interval: between a polyhedron inside it and one around it, both within the stated bound of its surface. For meshes both are
//! the mesh, and the interval is the oracle's own.
//!
//! Libraries take meshes as surfaces and primitives as solid bodies. An object inside a solid one collides with it.

use serde::{Deserialize, Serialize};

use super::{Answered, Kind};
use crate::configuration::{Class, Containment, Truth};

/// What an answer in a recording is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = RecordedClaim)]
pub enum Claim {
    /// It agrees with the truth.
    Right,
    /// The objects collide, and it says that they do not: the worst error.
    MissedCollision,
    /// The objects are apart, and it says that they collide.
    FalseCollision,
    /// The distance is too large by more than rounding explains; for a tolerance: it says "not closer", and they are.
    DistanceOver,
    /// The distance is too small; for a tolerance: it says "closer", and they are not.
    DistanceUnder,
    /// The truth is not known as precisely as the answer requires.
    Undecided,
}

impl Claim {
    /// Every claim with its name in files.
    pub const NAMES: [(Self, &'static str); 6] = [
        (Self::Right, "right"),
        (Self::MissedCollision, "missed_collision"),
        (Self::FalseCollision, "false_collision"),
        (Self::DistanceOver, "distance_over"),
        (Self::DistanceUnder, "distance_under"),
        (Self::Undecided, "undecided"),
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// Counts as a wrong answer.
    pub fn is_wrong(self) -> bool {
        !matches!(self, Self::Right | Self::Undecided)
    }
}

/// The truth about two objects of a scene in one configuration.
#[derive(Clone, Copy, Debug)]
pub struct Bracket {
    /// About the polyhedra around the objects.
    pub outer: Truth,
    /// About the polyhedra inside them.
    pub inner: Truth,
    /// Which of the objects are solid bodies.
    pub solid: [bool; 2],
    /// What rounding may change in a distance, in the unit of the scene.
    pub tau: f64,
}

impl Bracket {
    fn inside(&self, truth: &Truth) -> bool {
        let [a, b] = self.solid;
        match truth.containment {
            Some(Containment::BInA) => a,
            Some(Containment::AInB) => b,
            Some(Containment::Both) => a || b,
            Some(Containment::Apart) | None => false,
        }
    }

    /// They collide whatever the surfaces are between the polyhedra.
    fn collide(&self) -> bool {
        self.inner.class64 == Class::Colliding || (!self.inner.hit && self.inside(&self.inner))
    }

    /// They are apart whatever the surfaces are between the polyhedra.
    fn apart(&self) -> bool {
        let known = self.outer.containment.is_some() || self.solid == [false; 2];
        self.outer.class64 == Class::Clear && known && !self.inside(&self.outer)
    }

    /// The distance lies in this interval.
    fn distance(&self) -> [f64; 2] {
        let lo = if self.inside(&self.outer) { 0.0 } else { self.outer.distance_lo };
        let hi = if self.inside(&self.inner) { 0.0 } else { self.inner.distance_hi };
        [lo, hi.max(lo)]
    }

    /// Judges an answer; nothing when there is none. With it, by how much a distance misses the interval of the truth.
    pub fn judge(&self, kind: Kind, limit: f64, answered: Answered) -> Option<(Claim, f64)> {
        match (kind, answered) {
            (Kind::Tolerance, Answered { hit: Some(closer), .. }) => Some((self.closer(limit, closer), 0.0)),
            (Kind::Distance, Answered { distance: Some(distance), .. }) if distance > 0.0 => {
                Some(self.apart_by(distance))
            }
            (Kind::Distance, Answered { distance: Some(_), .. }) => Some((self.said(true), 0.0)),
            (_, Answered { hit: Some(hit), .. }) => Some((self.said(hit), 0.0)),
            (_, Answered { hit: None, .. }) => None,
        }
    }

    fn said(&self, hit: bool) -> Claim {
        match hit {
            true if self.apart() => Claim::FalseCollision,
            false if self.collide() => Claim::MissedCollision,
            true if self.collide() => Claim::Right,
            false if self.apart() => Claim::Right,
            _ => Claim::Undecided,
        }
    }

    fn closer(&self, limit: f64, closer: bool) -> Claim {
        let [lo, hi] = self.distance();
        let (certainly, certainly_not) = (hi < limit - self.tau, lo > limit + self.tau);
        match closer {
            true if certainly_not => Claim::DistanceUnder,
            false if certainly && self.collide() => Claim::MissedCollision,
            false if certainly => Claim::DistanceOver,
            true if certainly => Claim::Right,
            false if certainly_not => Claim::Right,
            _ => Claim::Undecided,
        }
    }

    fn apart_by(&self, distance: f64) -> (Claim, f64) {
        let [lo, hi] = self.distance();
        let (over, under) = (distance - hi, lo - distance);
        match () {
            () if !distance.is_finite() => (Claim::DistanceOver, f64::INFINITY),
            () if over > self.tau && self.collide() => (Claim::MissedCollision, over),
            () if over > self.tau => (Claim::DistanceOver, over),
            () if under > self.tau => (Claim::DistanceUnder, under),
            () => (Claim::Right, 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use crate::configuration::Witness;

    /// Apart by the interval, or crossing where that is 0.
    fn truth(lo: f64, hi: f64) -> Truth {
        let hit = hi == 0.0;
        let origin = Point3::origin();
        let class64 = if hit { Class::Colliding } else { Class::Clear };
        Truth {
            hit,
            distance_lo: lo,
            distance_hi: hi,
            margin: if hit { 0.1 } else { 0.0 },
            class64,
            class32: class64,
            containment: (!hit).then_some(Containment::Apart),
            witness: Witness { point_a: origin, point_b: origin, triangle_a: 0, triangle_b: 0 },
            exact_used: false,
        }
    }

    fn bracket(outer: Truth, inner: Truth) -> Bracket {
        Bracket { outer, inner, solid: [true, false], tau: 1e-12 }
    }

    fn hit(hit: bool) -> Answered {
        Answered { hit: Some(hit), distance: None }
    }

    fn by(distance: f64) -> Answered {
        Answered { hit: None, distance: Some(distance) }
    }

    #[test]
    fn collisions_are_decided_only_where_both_polyhedra_agree() {
        let judge = |outer, inner, said| bracket(outer, inner).judge(Kind::Collide, 0.0, hit(said)).unwrap().0;
        let (apart, crossing) = (truth(1.0, 1.0), truth(0.0, 0.0));
        assert_eq!(judge(apart, apart, false), Claim::Right);
        assert_eq!(judge(apart, apart, true), Claim::FalseCollision);
        assert_eq!(judge(crossing, crossing, true), Claim::Right);
        assert_eq!(judge(crossing, crossing, false), Claim::MissedCollision);
        assert_eq!([true, false].map(|said| judge(crossing, apart, said)), [Claim::Undecided; 2]);
        assert_eq!(bracket(apart, apart).judge(Kind::Collide, 0.0, Answered::default()), None);
    }

    #[test]
    fn an_object_inside_a_solid_one_collides_with_it() {
        let b_in_a = Truth { containment: Some(Containment::BInA), ..truth(0.5, 0.5) };
        let judge = |solid, answered| {
            Bracket { solid, ..bracket(b_in_a, b_in_a) }.judge(Kind::Distance, 0.0, answered).unwrap().0
        };
        assert_eq!(judge([true, false], hit(false)), Claim::MissedCollision);
        assert_eq!(judge([true, false], by(0.5)), Claim::MissedCollision);
        assert_eq!(judge([true, false], by(-0.1)), Claim::Right);
        // Only B is solid, and A is not in it.
        assert_eq!([judge([false, true], hit(false)), judge([false, true], by(0.5))], [Claim::Right; 2]);
        // Not closed: it cannot be known whether it is inside.
        let open = Truth { containment: None, ..truth(0.5, 0.5) };
        assert_eq!(bracket(open, open).judge(Kind::Collide, 0.0, hit(true)).unwrap().0, Claim::Undecided);
    }

    #[test]
    fn distances_are_compared_with_the_interval() {
        let between = bracket(truth(1.0, 1.0), truth(1.25, 1.25));
        let judge = |answered| between.judge(Kind::Distance, 0.0, answered).unwrap();
        assert_eq!(judge(by(1.125)), (Claim::Right, 0.0));
        assert_eq!(judge(by(1.5)), (Claim::DistanceOver, 0.25));
        assert_eq!(judge(by(0.5)), (Claim::DistanceUnder, 0.5));
        assert_eq!(judge(by(-1.0)).0, Claim::FalseCollision);
        assert_eq!(judge(by(f64::INFINITY)).0, Claim::DistanceOver);
    }

    #[test]
    fn a_tolerance_is_decided_outside_the_interval() {
        let between = bracket(truth(1.0, 1.0), truth(1.25, 1.25));
        let judge = |limit, said| between.judge(Kind::Tolerance, limit, hit(said)).unwrap().0;
        assert_eq!([judge(2.0, true), judge(2.0, false)], [Claim::Right, Claim::DistanceOver]);
        assert_eq!([judge(0.5, true), judge(0.5, false)], [Claim::DistanceUnder, Claim::Right]);
        assert_eq!([judge(1.125, true), judge(1.125, false)], [Claim::Undecided; 2]);
        let crossing = bracket(truth(0.0, 0.0), truth(0.0, 0.0));
        assert_eq!(crossing.judge(Kind::Tolerance, 0.5, hit(false)).unwrap().0, Claim::MissedCollision);
    }
}
