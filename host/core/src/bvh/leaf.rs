//! Eight triangles side by side against a ninth: bounds that know the corners, not only the boxes around them.
//!
//! Any direction `m` separates: two triangles are at least `(min m.b - max m.a) / |m|` apart. The direction between the
//! centroids is nearly the one of the closest points as soon as the distance exceeds the triangles' size, and there the
//! boxes, whose corners stick out, say little.

use nalgebra::Vector3;
use wide::f32x8;

/// Corners of eight triangles in their tree's coordinates: `corners[corner][axis]`.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    corners: [[f32x8; 3]; 3],
}

impl Default for Leaf {
    fn default() -> Self {
        Self { corners: [[f32x8::splat(0.0); 3]; 3] }
    }
}

/// Eight straight motions relative to the ninth triangle.
pub(super) struct Motion {
    /// Velocity of the eight; a unit vector.
    pub(super) velocity: [f32; 3],
    /// The distance that is looked for, with all that rounding may add.
    pub(super) within: f32,
}

impl Leaf {
    pub(super) fn set(&mut self, lane: usize, corners: &[Vector3<f64>; 3]) {
        for (own, corner) in self.corners.iter_mut().zip(corners) {
            for (field, &x) in own.iter_mut().zip(corner.iter()) {
                let mut lanes = field.to_array();
                lanes[lane] = x as f32;
                *field = f32x8::new(lanes);
            }
        }
    }

    /// The corners of one lane.
    pub(super) fn get(&self, lane: usize) -> [[f32; 3]; 3] {
        self.corners.each_ref().map(|corner| corner.each_ref().map(|x| x.as_array()[lane]))
    }

    /// Lower bounds, up to the frame's slack, of the distances to `other`, which is given in the same frame.
    pub(super) fn distances(&self, other: &[[f32; 3]; 3], scale: f32) -> f32x8 {
        let (own, other) = self.seen_from(other, scale);
        let towards = sum(&own);
        let length = dot(&towards, &towards).sqrt().max(f32x8::splat(f32::MIN_POSITIVE));
        gap(&own, &other, &towards) / length
    }

    /// Lower bounds of the ways after which each is within the motion's distance, when it is not before `enter`;
    /// infinite for never.
    pub(super) fn ways(&self, other: &[[f32; 3]; 3], scale: f32, motion: &Motion, enter: f32x8) -> f32x8 {
        let (own, other) = self.seen_from(other, scale);
        let velocity = motion.velocity.map(f32x8::splat);
        let centre = sum(&own).map(|x| x * f32x8::splat(1.0 / 3.0));
        let within = f32x8::splat(motion.within);
        let mut way = enter;
        for _ in 0..2 {
            let towards: [f32x8; 3] = std::array::from_fn(|k| centre[k] + way * velocity[k]);
            let length = dot(&towards, &towards).sqrt();
            let speed = dot(&towards, &velocity);
            let excess = gap(&own, &other, &towards) + way * speed - within * length;
            // Where they are still apart along this direction: the way on which it shrinks to nothing.
            let needed = excess / (-speed).max(length * f32x8::splat(1e-9)).max(f32x8::splat(f32::MIN_POSITIVE));
            way = excess.simd_gt(f32x8::splat(0.0)).select(way + needed, way);
        }
        way
    }

    /// Both relative to the other triangle's centroid, so that nothing large cancels.
    fn seen_from(&self, other: &[[f32; 3]; 3], scale: f32) -> ([[f32x8; 3]; 3], [[f32x8; 3]; 3]) {
        let origin: [f32; 3] = std::array::from_fn(|k| (other[0][k] + other[1][k] + other[2][k]) / 3.0);
        let scale = f32x8::splat(scale);
        let own = self.corners.each_ref().map(|p| std::array::from_fn(|k| p[k] * scale - f32x8::splat(origin[k])));
        let other = other.map(|p| std::array::from_fn(|k| f32x8::splat(p[k] - origin[k])));
        (own, other)
    }
}

fn dot(x: &[f32x8; 3], y: &[f32x8; 3]) -> f32x8 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

fn sum(corners: &[[f32x8; 3]; 3]) -> [f32x8; 3] {
    std::array::from_fn(|k| corners[0][k] + corners[1][k] + corners[2][k])
}

/// How far `own` lies beyond `other` along a direction, times the direction's length.
fn gap(own: &[[f32x8; 3]; 3], other: &[[f32x8; 3]; 3], direction: &[f32x8; 3]) -> f32x8 {
    let [p, q, r] = own.each_ref().map(|corner| dot(corner, direction));
    let [s, t, u] = other.each_ref().map(|corner| dot(corner, direction));
    p.min(q).min(r) - s.max(t).max(u)
}
