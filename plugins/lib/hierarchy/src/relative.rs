//! Where B's frame lies in A's, and why no contact is lost.
//!
//! A query is decided on corners in world directions around A's origin: `P = R x` for a corner `x` of A, `Q = S y + o` for a
//! corner `y` of B, with the rotations `R` and `S` as they are given and the offset `o` between the origins. Volumes are
//! compared in A's frame, under a rotation `N` and a translation `t = R' o` (`'` transposes). With `M = R' S`:
//!
//! ```text
//! R' (P - Q) = (x - N y - t) + (R' R - I) x - (M - N) y
//! ```
//!
//! So with `e = |R' R - I|` and `d = |M - N|` (Frobenius norms) a distance `g` of the volumes in A's frame is certain to
//! leave `|P - Q| >= (g - e |x| - d |y|) / |R|`, and `|R|^2 <= 1 + e`. Whatever the matrices are: `N` is made orthonormal
//! from `M`, and what that changes is in `d`. Given rotations that are off by half or more are not bounded any further:
//! then the slack is infinite and nothing is told apart. Otherwise `|R| <= 1.23` and `|S| <= 2.2`.
//!
//! Rounding, `u = 2^-53`, in units of `L = |x| + |y| + |o|`, each longest of its object; Frobenius norms are at most
//! `sqrt(3)` times the others:
//!
//! * the corners that the leaves compare: `3 u |R|_F |x| < 7 u`, and `3 u |S|_F |y| + u |Q| < 14 u`;
//! * `M`: `3 u |R|_F |S|_F |y| < 25 u`; `e` and `d`: less than `20 u`; `t`: `3 u |R|_F |o| < 7 u`;
//! * `N` has been made orthonormal twice over and is off from that by less than `16 u`.
//!
//! These are less than `64 u` in any combination of a corner of A and one of B. The volumes have [`SHARE`] `= 448 u` for
//! themselves: for corners that stick out of their volumes, for moving them by `N` and `t`, and for the gap. Both together
//! are `512 u = 256 * 2^-52`. A triangle lies where its corners do, so that the bounds hold for all its points.

use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, add_scaled, dot, rotate, transposed};

/// What a volume's own roundings may add to a gap, relative to the lengths of the query.
pub const SHARE: f64 = 224.0 * f64::EPSILON;

/// The placement of B in A's frame.
#[derive(Clone, Copy, Debug)]
pub struct Relative {
    /// Orthonormal, by rows.
    pub rotation: [Vector; 3],
    /// Of B's origin.
    pub translation: Vector,
    /// Volumes are apart beyond this gap.
    pub(crate) slack: f64,
    /// 1 / |R|.
    shrink: f64,
}

impl Relative {
    /// For objects whose longest corners have these lengths.
    pub fn new(frame: &Frame, radius_a: f64, radius_b: f64) -> Self {
        let (columns_a, columns_b) = (transposed(&frame.rotation_a), transposed(&frame.rotation_b));
        let given = columns_a.map(|a| columns_b.map(|b| dot(a, b)));
        let rotation = orthonormal(orthonormal(given));
        let translation = rotate(&columns_a, frame.offset);
        let square = columns_a.map(|a| columns_a.map(|b| dot(a, b)));
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let (e, d) = (difference(&square, &identity), difference(&given, &rotation));
        let lengths = radius_a + radius_b + dot(frame.offset, frame.offset).sqrt();
        let slack = e * radius_a + d * radius_b + (SHARE + 32.0 * f64::EPSILON) * lengths;
        // Written so that a NaN is out of range.
        let in_range = e < 0.5 && d < 0.5 && slack < f64::INFINITY;
        let slack = if in_range { slack * (1.0 + 8.0 * f64::EPSILON) } else { f64::INFINITY };
        Self { rotation, translation, slack, shrink: (1.0 - 8.0 * f64::EPSILON) / (1.0 + e).sqrt() }
    }

    /// A point of B in A's frame.
    #[inline(always)]
    pub fn place(&self, point: Vector) -> Vector {
        add(rotate(&self.rotation, point), self.translation)
    }

    /// What a gap of two volumes says about the distance of their triangles.
    #[inline(always)]
    pub(crate) fn distance(&self, gap: f64) -> f64 {
        if gap > self.slack { (gap - self.slack) * self.shrink } else { 0.0 }
    }
}

/// Gram and Schmidt's, by rows.
fn orthonormal(m: [Vector; 3]) -> [Vector; 3] {
    let unit = |v: Vector| v.map(|x| x / dot(v, v).sqrt());
    let x = unit(m[0]);
    let y = unit(add_scaled(m[1], -dot(m[1], x), x));
    let z = add_scaled(m[2], -dot(m[2], x), x);
    [x, y, unit(add_scaled(z, -dot(z, y), y))]
}

/// Frobenius norm of a - b.
fn difference(a: &[Vector; 3], b: &[Vector; 3]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
