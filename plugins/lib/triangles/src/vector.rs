//! Three numbers. Arrays, because that is what crosses the plugin interface.

/// A point or a direction.
pub type Vector = [f64; 3];

/// a + b.
#[inline(always)]
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a - b.
#[inline(always)]
pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + s b.
#[inline(always)]
pub fn add_scaled(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// Scalar product.
#[inline(always)]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
#[inline(always)]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Sum of the magnitudes.
#[inline(always)]
pub fn norm_1(a: Vector) -> f64 {
    a[0].abs() + a[1].abs() + a[2].abs()
}

/// A matrix with rows and columns exchanged.
#[inline(always)]
pub fn transposed(m: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]])
}

/// A matrix, given by its rows, times a vector.
#[inline(always)]
pub fn rotate(m: &[Vector; 3], v: Vector) -> Vector {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}
