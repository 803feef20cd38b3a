//! An oriented box around triangles.

use ocb_hierarchy::fit::Axes;
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, cross, dot, norm_1, sub};

use super::rounding::ROUNDING;

/// Middle, axes and half sides, as the kernels get them.
///
/// `axes` are orthonormal up to their rounding to single precision. Every corner `x` inside has
/// `|axes[k] . (x - center)| <= half[k]`, exactly; and each half side is larger than that by [`SPARE`] times the sum of all
/// three, which pays for everything in a kernel that is rounded in proportion to the box.
#[derive(Clone, Copy, Debug)]
pub struct Obb {
    pub center: [f32; 3],
    pub axes: [[f32; 3]; 3],
    pub half: [f32; 3],
}

/// See [`super::rounding`].
pub const SPARE: f64 = 128.0 * ROUNDING;

impl Obb {
    /// The box with these axes around some triangles.
    pub fn around(triangles: &[Triangle], ids: &[u32], axes: &Axes) -> Self {
        let axes = axes.map(|axis| axis.map(|x| x as f32));
        let exact = axes.map(|axis| axis.map(f64::from));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &id in ids {
            for corner in &triangles[id as usize] {
                for k in 0..3 {
                    let at = dot(exact[k], *corner);
                    low[k] = if at < low[k] { at } else { low[k] };
                    high[k] = if at > high[k] { at } else { high[k] };
                }
            }
        }
        let mut center = [0.0; 3];
        for k in 0..3 {
            center = add_scaled(center, 0.5 * (low[k] + high[k]), exact[k]);
        }
        let center = center.map(|x| x as f32);
        let side = |k: usize| {
            let middle = dot(exact[k], center.map(f64::from));
            // The products above are rounded in double precision, to less than this.
            (high[k] - middle).max(middle - low[k]) + 16.0 * f64::EPSILON
        };
        let half = [side(0), side(1), side(2)];
        let spare = SPARE * norm_1(half);
        Self { center, axes, half: half.map(|side| ((side + spare) as f32).next_up()) }
    }

    /// What the chance of a meeting with another box grows with.
    pub fn area(&self) -> f32 {
        let [x, y, z] = self.half;
        x * y + y * z + z * x
    }
}

/// Along the longest edge of a triangle, and its plane.
pub fn face_axes(triangle: &Triangle) -> Axes {
    let edges = [[0, 1], [1, 2], [2, 0]].map(|[i, j]: [usize; 2]| sub(triangle[j], triangle[i]));
    let longest = edges.iter().copied().max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b))).unwrap_or(edges[0]);
    orthonormal(longest, cross(edges[0], edges[1]))
}

/// Unit vectors along `first`, near `third`, and across both; any when these are 0 or parallel.
pub fn orthonormal(first: Vector, third: Vector) -> Axes {
    let unit = |v: Vector, other: Vector| {
        let square = dot(v, v);
        let inverse = 1.0 / square.sqrt();
        if square > 1e-280 { v.map(|x| x * inverse) } else { other }
    };
    let first = unit(first, [1.0, 0.0, 0.0]);
    // The coordinate axis most across the first one stands in for a third that says nothing.
    let least = (0..3).min_by(|&i, &j| first[i].abs().total_cmp(&first[j].abs())).unwrap_or(0);
    let mut fallback = [0.0; 3];
    fallback[least] = 1.0;
    let across = |v: Vector| add_scaled(v, -dot(v, first), first);
    let fallback = unit(across(fallback), fallback);
    let projected = across(unit(third, fallback));
    // Twice, since what is left of a nearly parallel one is not perpendicular yet.
    let third = if dot(projected, projected) > 1e-12 { unit(across(projected), fallback) } else { fallback };
    [first, cross(third, first), third]
}
