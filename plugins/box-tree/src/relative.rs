//! Boxes of B as A sees them: overlap and distance of two boxes that are turned against each other.

use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, cross, dot, norm_1, rotate, sub};

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

    /// Whether the boxes certainly have no point in common: the separating axis test of two oriented boxes (Gottschalk,
    /// Lin and Manocha 1996), of which one is axis-aligned. Their six own axes come first, since they reject most.
    #[inline(always)]
    pub fn apart(&self, a: &Node, b: &Node) -> bool {
        let t = self.between(a, b);
        let (r, m) = (&self.rotation, &self.reach);
        for i in 0..3 {
            if t[i].abs() > a.half[i] + dot(m[i], b.half) + self.slack {
                return true;
            }
        }
        for j in 0..3 {
            let (along, reach) = (column(r, j), column(m, j));
            if dot(t, along).abs() > b.half[j] + dot(reach, a.half) + self.slack {
                return true;
            }
        }
        let mut apart = false;
        for i in 0..3 {
            for j in 0..3 {
                apart |= self.cross_gap(t, a, b, i, j) > self.slack;
            }
        }
        apart
    }

    /// A lower bound of the distance of the boxes.
    ///
    /// In the frame of either, the gap between a box and the box around the other one is exact for all that its three
    /// axes see, and `toward` is a good guess of where the gap lies. The nine edge products would save a tenth of the
    /// tests and more than double the cost of each.
    #[inline(always)]
    pub fn distance(&self, a: &Node, b: &Node, toward: &Direction) -> f64 {
        let t = self.between(a, b);
        let (r, m) = (&self.rotation, &self.reach);
        let (mut in_a, mut in_b) = (0.0, 0.0);
        for i in 0..3 {
            let gap = (t[i].abs() - a.half[i] - dot(m[i], b.half)).max(0.0);
            in_a += gap * gap;
            let gap = (dot(t, column(r, i)).abs() - b.half[i] - dot(column(m, i), a.half)).max(0.0);
            in_b += gap * gap;
        }
        let own: f64 = if in_a > in_b { in_a } else { in_b };
        let guessed = dot(toward.in_a, t) - dot(toward.reach_a, a.half) - dot(toward.reach_b, b.half);
        let bound = own.sqrt().max(guessed) - self.slack;
        bound.max(0.0)
    }

    /// Square of the distance of the middles of two boxes.
    #[inline(always)]
    pub fn squared_middle_distance(&self, a: &Node, b: &Node) -> f64 {
        let t = self.between(a, b);
        dot(t, t)
    }

    /// The gap along a_i x b_j, times the length of that product.
    #[inline(always)]
    fn cross_gap(&self, t: Vector, a: &Node, b: &Node, i: usize, j: usize) -> f64 {
        let (r, m) = (&self.rotation, &self.reach);
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
        let between = t[i2] * r[i1][j] - t[i1] * r[i2][j];
        let reach_a = a.half[i1] * m[i2][j] + a.half[i2] * m[i1][j];
        let reach_b = b.half[j1] * m[i][j2] + b.half[j2] * m[i][j1];
        between.abs() - reach_a - reach_b
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

fn transposed(m: &[Vector; 3]) -> [Vector; 3] {
    [column(m, 0), column(m, 1), column(m, 2)]
}

#[inline(always)]
fn column(m: &[Vector; 3], j: usize) -> Vector {
    [m[0][j], m[1][j], m[2][j]]
}

/// How far the columns of a matrix are from orthonormal.
fn skew(columns: &[Vector; 3]) -> f64 {
    let [x, y, z] = *columns;
    let length = |v: Vector| (dot(v, v) - 1.0).abs();
    let handed = (dot(cross(x, y), z) - 1.0).abs();
    length(x) + length(y) + length(z) + dot(x, y).abs() + dot(y, z).abs() + dot(z, x).abs() + handed
}
