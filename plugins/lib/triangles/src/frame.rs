//! A and B in one frame.

use crate::Triangle;
use crate::vector::{Vector, add, cross, dot, rotate, sub};

/// World directions around A's origin: where a query's triangles are compared.
///
/// Taking the difference of the translations first keeps the digits that two objects far from the world's origin would
/// lose. Both rotations are used as they are given, because the truth is defined on these very numbers.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Rotation of A, by rows.
    pub rotation_a: [Vector; 3],
    /// Rotation of B, by rows.
    pub rotation_b: [Vector; 3],
    /// From A's origin to B's.
    pub offset: Vector,
    /// A's origin in the world.
    pub origin: Vector,
}

impl Frame {
    /// From rotations and translations of both objects.
    pub fn new(rotation_a: [Vector; 3], translation_a: Vector, rotation_b: [Vector; 3], translation_b: Vector) -> Self {
        Self { rotation_a, rotation_b, offset: sub(translation_b, translation_a), origin: translation_a }
    }

    /// A triangle of A in this frame.
    #[inline]
    pub fn place_a(&self, triangle: &Triangle) -> Triangle {
        triangle.map(|corner| rotate(&self.rotation_a, corner))
    }

    /// A triangle of B in this frame.
    #[inline]
    pub fn place_b(&self, triangle: &Triangle) -> Triangle {
        triangle.map(|corner| add(rotate(&self.rotation_b, corner), self.offset))
    }

    /// A point of this frame in the world.
    #[inline]
    pub fn to_world(&self, point: Vector) -> Vector {
        add(point, self.origin)
    }
}

/// How far the columns of a matrix are from those of a rotation: no less than the magnitudes of the entries of `R' R - I`,
/// summed.
#[inline(always)]
pub fn skew(columns: &[Vector; 3]) -> f64 {
    let [x, y, z] = *columns;
    let length = |v: Vector| (dot(v, v) - 1.0).abs();
    let handed = (dot(cross(x, y), z) - 1.0).abs();
    length(x) + length(y) + length(z) + 2.0 * (dot(x, y).abs() + dot(y, z).abs() + dot(z, x).abs()) + handed
}
