//! A rectangle swept sphere: all points within a radius of a rectangle.

use ocb_hierarchy::{Relative, Volume, fit};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, dot, rotate, sub};

use crate::rectangle::Rectangle;

/// A rectangle swept sphere, as PQP has it.
///
/// Rounding, in units of 2^-53 times the lengths of a query (see `ocb_hierarchy::Relative`): the radius is that of the corner
/// farthest from the rectangle, computed from this very rectangle, off by 40; what moving it and the gap add is shown at
/// [`Rectangle::gap`]: in all less than 200.
#[derive(Clone, Copy, Debug)]
pub struct Rss {
    rectangle: Rectangle,
    radius: f64,
}

impl Volume for Rss {
    type Shared = Relative;
    type Placed = Rss;

    /// PQP's fit: the rectangle lies across the direction of least spread, in the middle of what there is, and is made so
    /// small that its rounded edges still reach all corners; then its own corners are moved outwards where the rounding
    /// does not reach.
    fn around(triangles: &[Triangle], radius: f64) -> Self {
        let axes = fit::principal_axes(triangles, radius);
        let corners: Vec<Vector> = triangles.as_flattened().iter().map(|corner| rotate(&axes, *corner)).collect();
        let range = |at: &dyn Fn(&Vector) -> [f64; 2]| {
            corners
                .iter()
                .map(at)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [from, to]| [low.min(from), high.max(to)])
        };
        let [bottom, top] = range(&|p| [p[2], p[2]]);
        let (height, radius) = (0.5 * bottom + 0.5 * top, 0.5 * top - 0.5 * bottom);
        // How far a rounded edge reaches out at the height of a corner.
        let bulge = |p: &Vector| (radius * radius - (p[2] - height) * (p[2] - height)).max(0.0).sqrt();
        let side = |k: usize| {
            // The rectangle must reach from where the low corners' bulge ends to where that of the high ones does.
            let [low, high] = range(&|p| [p[k] + bulge(p), p[k] - bulge(p)]);
            if low <= high { [low, high] } else { [0.5 * low + 0.5 * high; 2] }
        };
        let mut sides = [side(0), side(1)];
        for [x, y] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
            let outwards = |end: usize| if end == 0 { -1.0 } else { 1.0 };
            for p in &corners {
                let beyond = [(p[0] - sides[0][x]) * outwards(x), (p[1] - sides[1][y]) * outwards(y)];
                if beyond[0] <= 0.0 || beyond[1] <= 0.0 {
                    continue;
                }
                // Along the diagonal, until the corner's ball holds the point.
                let (along, across) = (0.5 * (beyond[0] + beyond[1]), 0.5 * (beyond[0] - beyond[1]));
                let bulge = bulge(p);
                let step = along - (0.5 * bulge * bulge - across * across).max(0.0).sqrt();
                if step > 0.0 {
                    sides[0][x] += outwards(x) * step;
                    sides[1][y] += outwards(y) * step;
                }
            }
        }
        let middle = sides.map(|[low, high]| 0.5 * low + 0.5 * high);
        let center = add_scaled(add_scaled(axes[2].map(|x| x * height), middle[0], axes[0]), middle[1], axes[1]);
        let half = sides.map(|[low, high]| 0.5 * high - 0.5 * low);
        let rectangle = Rectangle { center, axes, half };
        let radius = triangles.as_flattened().iter().map(|corner| rectangle.distance(*corner)).fold(0.0, f64::max);
        Self { rectangle, radius }
    }

    fn split_along(&self, _triangles: &[Triangle]) -> Vector {
        self.rectangle.axes[0]
    }

    #[inline(always)]
    fn size(&self) -> f64 {
        let [x, y] = self.rectangle.half;
        (x * x + y * y).sqrt() + self.radius
    }

    fn share(relative: &Relative) -> Relative {
        *relative
    }

    #[inline(always)]
    fn place(&self, relative: &Relative) -> Rss {
        let Rectangle { center, axes, half } = self.rectangle;
        let axes = axes.map(|axis| rotate(&relative.rotation, axis));
        Rss { rectangle: Rectangle { center: relative.place(center), axes, half }, radius: self.radius }
    }

    #[inline(always)]
    fn gap(&self, b: &Rss, _: &Relative) -> f64 {
        self.rectangle.gap(&b.rectangle, self.radius + b.radius) - self.radius - b.radius
    }
}

impl Rectangle {
    fn distance(&self, point: Vector) -> f64 {
        let at = rotate(&self.axes, sub(point, self.center));
        let out = [beyond(at[0], self.half[0]), beyond(at[1], self.half[1]), at[2]];
        dot(out, out).sqrt()
    }
}

fn beyond(at: f64, half: f64) -> f64 {
    (at.abs() - half).max(0.0)
}
