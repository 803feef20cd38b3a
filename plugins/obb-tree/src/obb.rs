//! An oriented box.

use ocb_hierarchy::{Boxes, Relative, Volume, fit};
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

    /// RAPID answers no distances; this is the bound that its test leads to.
    #[inline(always)]
    fn gap(&self, b: &Obb, _: &Relative) -> f64 {
        self.compare(b, |boxes| boxes.gap())
    }

    #[inline(always)]
    fn apart(&self, b: &Obb, _: &Relative, slack: f64) -> bool {
        self.compare(b, |boxes| boxes.apart(slack))
    }
}

impl Obb {
    #[inline(always)]
    fn compare<T>(&self, b: &Obb, test: impl FnOnce(Boxes<'_>) -> T) -> T {
        let between = rotate(&self.axes, sub(b.center, self.center));
        let turn = self.axes.map(|axis| b.axes.map(|other| dot(axis, other)));
        let reach = turn.map(|row| row.map(f64::abs));
        test(Boxes { half_a: self.half, half_b: b.half, between, turn: &turn, reach: &reach })
    }
}
