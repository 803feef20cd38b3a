//! What is known of a configuration before anything is searched.

use ocb_triangles::vector::{Vector, add, dot, rotate, sub, transposed};
use ocb_triangles::{Frame, skew};
use opencollbench_plugin::Mesh;

/// A ball around an object, and how many triangles it has.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    center: Vector,
    radius: f64,
    triangles: f64,
}

impl Ball {
    /// Around the middle of the bounding box; the mesh has triangles.
    pub fn around(mesh: &Mesh<'_>) -> Self {
        let corners = || mesh.triangles.iter().flatten().map(|&vertex| mesh.positions[vertex as usize]);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in corners() {
            low = core::array::from_fn(|k| corner[k].min(low[k]));
            high = core::array::from_fn(|k| corner[k].max(high[k]));
        }
        let center = core::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k]);
        let square = corners().map(|corner| sub(corner, center)).map(|v| dot(v, v)).fold(0.0, f64::max);
        Self { center, radius: square.sqrt(), triangles: mesh.triangles.len() as f64 }
    }
}

/// A number that a rule may look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The gap between the balls around the objects, in the sum of their radii; -1 where the middles are in one point.
    /// Above 0 the objects are certainly apart.
    Clearance,
    /// The radius of the larger ball in that of the smaller one.
    SizeRatio,
    /// The number of triangles of the object that has more, in that of the other one.
    CountRatio,
}

/// The features of one configuration.
#[derive(Clone, Copy, Debug)]
pub struct Features {
    clearance: f64,
    size_ratio: f64,
    count_ratio: f64,
}

/// More than a length can lose because its square is too small for double precision.
const TINY: f64 = 1e-150;

impl Features {
    /// Of two objects in their poses.
    ///
    /// A corner `x` of an object around `c` is compared at `R x`, rounded: no farther from `R c` than `|R| r`, and `|R|` is at
    /// most 1 and how far `R` is from a rotation. All roundings together, of the corners, the middles and the radii, are
    /// below 64 of them at the lengths of the query. What is no number or infinite is no gap.
    #[inline]
    pub fn new(frame: &Frame, a: &Ball, b: &Ball) -> Self {
        let [stretch_a, stretch_b] =
            [&frame.rotation_a, &frame.rotation_b].map(|rotation| 1.0 + skew(&transposed(rotation)));
        let between = sub(add(rotate(&frame.rotation_b, b.center), frame.offset), rotate(&frame.rotation_a, a.center));
        let length = |v: Vector| dot(v, v).sqrt();
        let reach = stretch_a * a.radius + stretch_b * b.radius;
        let lengths = stretch_a * length(a.center) + stretch_b * length(b.center) + length(frame.offset) + reach;
        let gap = length(between) - reach - (64.0 * f64::EPSILON * lengths + TINY);
        let clearance = gap / (reach + TINY);
        let ratio = |a: f64, b: f64| a.max(b) / a.min(b);
        Self {
            clearance: if clearance.is_finite() { clearance } else { -1.0 },
            size_ratio: ratio(a.radius, b.radius),
            count_ratio: ratio(a.triangles, b.triangles),
        }
    }

    /// One of them.
    #[inline(always)]
    pub fn get(&self, feature: Feature) -> f64 {
        match feature {
            Feature::Clearance => self.clearance,
            Feature::SizeRatio => self.size_ratio,
            Feature::CountRatio => self.count_ratio,
        }
    }
}
