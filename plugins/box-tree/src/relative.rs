//! Boxes of B as A sees them: overlap and distance of two boxes that are turned against each other.

use ocb_hierarchy::Boxes;
use ocb_triangles::vector::{Vector, add, dot, norm_1, rotate, sub, transposed};
use ocb_triangles::{Frame, skew};

use crate::tree::Node;

/// The placement of B in A's frame, with what all box tests of a query share.
#[derive(Clone, Copy, Debug)]
pub struct Relative {
    rotation: [Vector; 3],
    translation: Vector,
    /// Magnitudes of `rotation`.
    reach: [Vector; 3],
    /// What rounding and imperfect rotations may add to any projection. Boxes are only ever told apart beyond it, so
    /// that no contact is lost.
    pub slack: f64,
}

impl Relative {
    /// For a query on two trees with these roots.
    pub fn new(frame: &Frame, root_a: &Node, root_b: &Node) -> Self {
        let (columns_a, columns_b) = (transposed(&frame.rotation_a), transposed(&frame.rotation_b));
        let rotation = columns_a.map(|a| columns_b.map(|b| dot(a, b)));
        let translation = rotate(&columns_a, frame.offset);
        let size = norm_1(root_a.center)
            + norm_1(root_a.half)
            + norm_1(root_b.center)
            + norm_1(root_b.half)
            + norm_1(translation);
        let skew = skew(&columns_a) + skew(&columns_b);
        let reach = rotation.map(|row| row.map(f64::abs));
        Self { rotation, translation, reach, slack: size * (64.0 * f64::EPSILON + 8.0 * skew) }
    }

    /// From the middle of a box of A to that of a box of B, in A's frame.
    #[inline(always)]
    fn between(&self, a: &Node, b: &Node) -> Vector {
        sub(add(rotate(&self.rotation, b.center), self.translation), a.center)
    }

    /// Calls a test with a box of B as seen from a box of A.
    #[inline(always)]
    fn compare<T>(&self, a: &Node, b: &Node, test: impl FnOnce(&Boxes<'_>) -> T) -> T {
        let between = self.between(a, b);
        test(&Boxes { half_a: a.half, half_b: b.half, between, turn: &self.rotation, reach: &self.reach })
    }

    /// Whether the boxes certainly have no point in common.
    #[inline(always)]
    pub fn apart(&self, a: &Node, b: &Node) -> bool {
        self.compare(a, b, |boxes| boxes.apart(self.slack))
    }

    /// A lower bound of the distance of the boxes.
    ///
    /// In the frame of either, the gap between a box and the box around the other one is exact for all that its three
    /// axes see, and `toward` is a good guess of where the gap lies. The nine edge products would save a tenth of the
    /// tests and more than double the cost of each.
    #[inline(always)]
    pub fn distance(&self, a: &Node, b: &Node, toward: &Direction) -> f64 {
        self.compare(a, b, |boxes| {
            let guessed = dot(toward.in_a, boxes.between) - dot(toward.reach_a, a.half) - dot(toward.reach_b, b.half);
            (boxes.gap().max(guessed) - self.slack).max(0.0)
        })
    }

    /// Square of the distance of the middles of two boxes.
    #[inline(always)]
    pub fn squared_middle_distance(&self, a: &Node, b: &Node) -> f64 {
        let t = self.between(a, b);
        dot(t, t)
    }
}

/// A unit vector from A to B, along which the boxes may be far apart.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    in_a: Vector,
    reach_a: Vector,
    reach_b: Vector,
}

impl Direction {
    /// No direction: says nothing.
    pub const NONE: Self = Self { in_a: [0.0; 3], reach_a: [0.0; 3], reach_b: [0.0; 3] };

    /// From a unit vector in the frame of the query.
    pub fn new(frame: &Frame, unit: Vector) -> Self {
        let in_a = rotate(&transposed(&frame.rotation_a), unit);
        let in_b = rotate(&transposed(&frame.rotation_b), unit);
        Self { in_a, reach_a: in_a.map(f64::abs), reach_b: in_b.map(f64::abs) }
    }
}
