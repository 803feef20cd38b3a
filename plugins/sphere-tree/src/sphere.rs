//! A sphere around triangles.

use ocb_hierarchy::{Relative, Volume, fit};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, dot, sub};

/// A sphere.
///
/// Rounding, in units of 2^-53 times the lengths of a query: the radius is the computed distance of the farthest corner, off
/// by 4; a placed middle is off by 8, the difference of two by 2 more, its length by 4, both subtractions by 4: less than 32.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    center: Vector,
    radius: f64,
}

/// Steps towards the smallest sphere. Its radius is then off by a few per cent at most, and usually by much less.
const STEPS: usize = 24;

impl Volume for Sphere {
    type Shared = Relative;
    type Placed = Sphere;

    /// Towards the smallest enclosing sphere: from the middle of the box, again and again a shrinking step to the farthest
    /// corner (M. Badoiu, K. L. Clarkson: Smaller core-sets for balls, SODA 2003).
    fn around(triangles: &[Triangle], _radius: f64) -> Self {
        let corners = triangles.as_flattened();
        let (mut low, mut high) = (corners[0], corners[0]);
        for corner in corners {
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(corner[k]), high[k].max(corner[k]));
            }
        }
        let mut center: Vector = core::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k]);
        let mut best = Self { center, radius: f64::INFINITY };
        for step in 0..STEPS {
            let (mut farthest, mut squared) = (center, 0.0);
            for corner in corners {
                let off = sub(*corner, center);
                if dot(off, off) > squared {
                    (farthest, squared) = (*corner, dot(off, off));
                }
            }
            if squared.sqrt() < best.radius {
                best = Self { center, radius: squared.sqrt() };
            }
            center = add_scaled(center, 1.0 / (step as f64 + 3.0), sub(farthest, center));
        }
        best
    }

    fn split_along(&self, triangles: &[Triangle]) -> Vector {
        fit::widest_axis(triangles)
    }

    #[inline(always)]
    fn size(&self) -> f64 {
        self.radius
    }

    fn share(relative: &Relative) -> Relative {
        *relative
    }

    #[inline(always)]
    fn place(&self, relative: &Relative) -> Sphere {
        Self { center: relative.place(self.center), radius: self.radius }
    }

    #[inline(always)]
    fn gap(&self, b: &Sphere, _: &Relative) -> f64 {
        let between = sub(b.center, self.center);
        dot(between, between).sqrt() - self.radius - b.radius
    }

    /// Without a root.
    #[inline(always)]
    fn apart(&self, b: &Sphere, _: &Relative, slack: f64) -> bool {
        let between = sub(b.center, self.center);
        let reach = self.radius + b.radius + slack;
        dot(between, between) > reach * reach
    }
}
