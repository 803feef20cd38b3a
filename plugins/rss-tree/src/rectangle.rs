//! How far apart are two rectangles in space?

use ocb_triangles::vector::{Vector, add_scaled, dot, rotate, sub};

/// A rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    pub center: Vector,
    /// Two along the sides and one across; orthonormal.
    pub axes: [Vector; 3],
    /// Half of the sides.
    pub half: [f64; 2],
}

/// Refinements of the closest points. One or two are the rule.
const STEPS: usize = 6;
/// A bound that has come so near to the distance of two points is good enough.
const TIGHT: f64 = 0.999;

impl Rectangle {
    /// A lower bound of the distance of two rectangles in one frame, to a thousandth of it; less exact if it is certain to be
    /// less than `needed`, or after many steps.
    ///
    /// PQP looks for the pair of edges that are closest; here the closest points are found by Newton's method, since the
    /// squared distance of a point of B from A is a parabola on each of the regions around A. Whatever points that finds, the
    /// gap along the line between them is a lower bound, for any line; only that gap is answered.
    ///
    /// Rounding, in units of 2^-53 times the lengths of the query: axes are orthonormal up to 24, so that a point of either
    /// rectangle, and what its length along the line is, is off by 48 at most; the line's direction is a unit vector up to
    /// 4, its entries need not be those of any particular line; the difference of the middles is off by 10 + 24 and the sum
    /// of five products by 8 more: less than 150.
    #[inline(always)]
    pub fn gap(&self, b: &Rectangle, needed: f64) -> f64 {
        let between = rotate(&self.axes, sub(b.center, self.center));
        let sides = [rotate(&self.axes, b.axes[0]), rotate(&self.axes, b.axes[1])];
        let [s, t] = sides.map(|side| -dot(side, between));
        let mut at = [s.clamp(-b.half[0], b.half[0]), t.clamp(-b.half[1], b.half[1])];
        let mut best = 0.0;
        for _ in 0..STEPS {
            let point = add_scaled(add_scaled(between, at[0], sides[0]), at[1], sides[1]);
            let on_a = [point[0].clamp(-self.half[0], self.half[0]), point[1].clamp(-self.half[1], self.half[1]), 0.0];
            let line = sub(point, on_a);
            let length = dot(line, line).sqrt();
            if length <= best || length <= needed {
                break;
            }
            let unit = line.map(|x| x / length);
            let reach_a = unit[0].abs() * self.half[0] + unit[1].abs() * self.half[1];
            let reach_b = dot(unit, sides[0]).abs() * b.half[0] + dot(unit, sides[1]).abs() * b.half[1];
            let gap = dot(unit, between) - reach_a - reach_b;
            best = if gap > best { gap } else { best };
            if best >= TIGHT * length {
                break;
            }
            // The parabola of this region: beyond a side of A that coordinate counts, beside it does not.
            let counts = [line[0] != 0.0, line[1] != 0.0, true].map(|counts| f64::from(u8::from(counts)));
            let product = |v: Vector, w: Vector| counts[0] * v[0] * w[0] + counts[1] * v[1] * w[1] + v[2] * w[2];
            let origin = sub(between, on_a);
            at = lowest(
                [product(sides[0], sides[0]), product(sides[0], sides[1]), product(sides[1], sides[1])],
                [product(sides[0], origin), product(sides[1], origin)],
                b.half,
            );
        }
        best
    }
}

/// Where in a box `h00 s^2 + 2 h01 s t + h11 t^2 + 2 g0 s + 2 g1 t`, a convex function, is lowest.
#[inline(always)]
fn lowest([h00, h01, h11]: [f64; 3], [g0, g1]: [f64; 2], half: [f64; 2]) -> [f64; 2] {
    let determinant = h00 * h11 - h01 * h01;
    if determinant > 1e-12 * h00 * h11 {
        let (s, t) = ((h01 * g1 - h11 * g0) / determinant, (h01 * g0 - h00 * g1) / determinant);
        if s.abs() <= half[0] && t.abs() <= half[1] {
            return [s, t];
        }
    }
    let clamped = |numerator: f64, h: f64, half: f64| if h > 0.0 { (numerator / h).clamp(-half, half) } else { 0.0 };
    let on_sides = [
        [half[0], clamped(-g1 - h01 * half[0], h11, half[1])],
        [-half[0], clamped(-g1 + h01 * half[0], h11, half[1])],
        [clamped(-g0 - h01 * half[1], h00, half[0]), half[1]],
        [clamped(-g0 + h01 * half[1], h00, half[0]), -half[1]],
    ];
    let value = |[s, t]: [f64; 2]| s * (h00 * s + 2.0 * (h01 * t + g0)) + t * (h11 * t + 2.0 * g1);
    let mut best = on_sides[0];
    for at in on_sides {
        best = if value(at) < value(best) { at } else { best };
    }
    best
}
