//! An oriented box, and the separating axis test.

use ocb_hierarchy::{Relative, Volume, fit};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, dot, rotate, sub};

/// An oriented box.
///
/// Rounding, in units of 2^-53 times the lengths of a query (see `ocb_hierarchy::Relative`). Any direction tells apart, so that
/// only projections count. The axes are orthonormal up to 8, up to 24 when placed. A corner sticks out of its box by less
/// than 30 (its product with an axis, and that of the middle, which is a sum of axes). A box is the middle plus a sum of
/// axes times at most the half sides: off by `sqrt(3)` times 24 for a vector that is at most twice the longest corner, 84. The
/// middle placed is off by 8, the difference of two by 2, its projection by 4. A reach is three products of half sides, at most
/// the longest corner each, and of entries off by 12: 36 and 12 for the sum. Altogether less than 200. Along a product of
/// axes, the identities of orthonormal axes add `sqrt(3)` times 24 to the difference and to each entry: less than 400.
#[derive(Clone, Copy, Debug)]
pub struct Obb {
    center: Vector,
    axes: [Vector; 3],
    half: Vector,
}

impl Volume for Obb {
    type Shared = Relative;
    type Placed = Obb;

    fn around(triangles: &[Triangle], radius: f64) -> Self {
        let axes = fit::principal_axes(triangles, radius);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in triangles.as_flattened() {
            let at = rotate(&axes, *corner);
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k]));
            }
        }
        let mut center = [0.0; 3];
        for k in 0..3 {
            center = add_scaled(center, 0.5 * low[k] + 0.5 * high[k], axes[k]);
        }
        Self { center, axes, half: core::array::from_fn(|k| 0.5 * high[k] - 0.5 * low[k]) }
    }

    /// The longest side.
    fn split_along(&self, _triangles: &[Triangle]) -> Vector {
        let longest = (0..3).max_by(|&i, &j| self.half[i].total_cmp(&self.half[j])).unwrap_or(0);
        self.axes[longest]
    }

    #[inline(always)]
    fn size(&self) -> f64 {
        self.half[0].max(self.half[1]).max(self.half[2])
    }

    fn share(relative: &Relative) -> Relative {
        *relative
    }

    #[inline(always)]
    fn place(&self, relative: &Relative) -> Obb {
        let axes = self.axes.map(|axis| rotate(&relative.rotation, axis));
        Obb { center: relative.place(self.center), axes, half: self.half }
    }

    /// In the directions of either box, the gap between it and the box around the other one. RAPID answers no distances;
    /// the nine edge products are left out, since they would cost more than they save.
    #[inline(always)]
    fn gap(&self, b: &Obb, _: &Relative) -> f64 {
        let pair = Pair::new(self, b);
        let (mut in_a, mut in_b) = (0.0, 0.0);
        for k in 0..3 {
            let gap = pair.gap_along_a(k).max(0.0);
            in_a += gap * gap;
            let gap = pair.gap_along_b(k).max(0.0);
            in_b += gap * gap;
        }
        f64::sqrt(if in_a > in_b { in_a } else { in_b })
    }

    /// Fifteen axes: those of A, those of B, and the products of one of either. A product is shorter than 1, and its gap
    /// with it, so that the slack is more than enough.
    #[inline(always)]
    fn apart(&self, b: &Obb, _: &Relative, slack: f64) -> bool {
        let pair = Pair::new(self, b);
        (0..3).any(|k| pair.gap_along_a(k) > slack)
            || (0..3).any(|k| pair.gap_along_b(k) > slack)
            || (0..9).any(|k| pair.gap_along_product(k / 3, k % 3) > slack)
    }
}

/// A box of B as seen from a box of A.
struct Pair<'a> {
    a: &'a Vector,
    b: &'a Vector,
    /// From the middle of A to that of B.
    between: Vector,
    /// Columns are the axes of B.
    turn: [Vector; 3],
    /// Magnitudes of `turn`.
    reach: [Vector; 3],
}

impl<'a> Pair<'a> {
    #[inline(always)]
    fn new(a: &'a Obb, b: &'a Obb) -> Self {
        let between = rotate(&a.axes, sub(b.center, a.center));
        let turn = a.axes.map(|axis| b.axes.map(|other| dot(axis, other)));
        Self { a: &a.half, b: &b.half, between, turn, reach: turn.map(|row| row.map(f64::abs)) }
    }

    #[inline(always)]
    fn gap_along_a(&self, i: usize) -> f64 {
        self.between[i].abs() - self.a[i] - dot(self.reach[i], *self.b)
    }

    #[inline(always)]
    fn gap_along_b(&self, j: usize) -> f64 {
        let column = |m: &[Vector; 3]| [m[0][j], m[1][j], m[2][j]];
        dot(self.between, column(&self.turn)).abs() - self.b[j] - dot(column(&self.reach), *self.a)
    }

    #[inline(always)]
    fn gap_along_product(&self, i: usize, j: usize) -> f64 {
        let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        let between = self.between[i2] * self.turn[i1][j] - self.between[i1] * self.turn[i2][j];
        let reach_a = self.a[i1] * self.reach[i2][j] + self.a[i2] * self.reach[i1][j];
        let reach_b = self.b[j1] * self.reach[i][j2] + self.b[j2] * self.reach[i][j1];
        between.abs() - reach_a - reach_b
    }
}
