//! Evenly spread directions and rotations, jointly.
//!
//! An additive sequence in five dimensions (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences":
//! the generalised golden ratio) gives two numbers to the direction and three to the rotation. Joint, because a product
//! of few directions with few rotations would approach A along the same few rays again and again, and the heatmap would
//! show the rays. Every prefix of the sequence is evenly spread, so a smaller N is a prefix of a larger one.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

/// The direction in which B stands and B's rotation.
pub(super) type Sample = (Vector3<f64>, Matrix3<f64>);

/// Sample `index` of the sequence that `seed` shifts.
pub(super) fn sample(index: u64, seed: u64) -> Sample {
    // The real root of x^6 = x + 1.
    let u: [f64; 5] = point(1.134_724_138_401_519_4, index, seed);
    (direction(u[0], u[1]), rotation(u[2], u[3], u[4]))
}

/// The same in six dimensions: a point of the unit cube and a rotation.
pub(super) fn placement(index: u64, seed: u64) -> Sample {
    // The real root of x^7 = x + 1.
    let u: [f64; 6] = point(1.112_775_684_278_705_5, index, seed);
    (Vector3::new(u[0], u[1], u[2]), rotation(u[3], u[4], u[5]))
}

fn point<const D: usize>(ratio: f64, index: u64, seed: u64) -> [f64; D] {
    let mut power = 1.0;
    let mut state = seed;
    std::array::from_fn(|_| {
        power /= ratio;
        let shift = splitmix(&mut state);
        (shift + (index as f64 + 1.0) * power).fract()
    })
}

/// A number that looks like a random one of these two.
pub(super) fn mix(x: u64, y: u64) -> u64 {
    scramble(scramble(x.wrapping_add(GOLDEN)) ^ y.wrapping_mul(GOLDEN))
}

/// A number in [0, 1) that looks like a random one of these two.
pub(super) fn share(x: u64, y: u64) -> f64 {
    (mix(x, y) >> 11) as f64 / (1u64 << 53) as f64
}

/// One of 2^53 shifts in [0, 1) (Steele, Lea and Flood 2014, SplitMix64).
fn splitmix(state: &mut u64) -> f64 {
    *state = state.wrapping_add(GOLDEN);
    (scramble(*state) >> 11) as f64 / (1u64 << 53) as f64
}

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

fn scramble(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Unit vector; equal areas of the unit square become equal areas of the sphere (Lambert's cylinder).
pub(super) fn direction(u: f64, v: f64) -> Vector3<f64> {
    let z = 1.0 - 2.0 * u;
    let (sin, cos) = libm::sincos(TAU * v);
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * cos, radius * sin, z)
}

/// Rotation; equal volumes of the unit cube become equal volumes of SO(3) (Shoemake 1992, "Uniform random rotations").
fn rotation(u: f64, v: f64, w: f64) -> Matrix3<f64> {
    let (s1, c1) = libm::sincos(TAU * v);
    let (s2, c2) = libm::sincos(TAU * w);
    let (r1, r2) = ((1.0 - u).sqrt(), u.sqrt());
    from_quaternion([r2 * c2, r1 * s1, r1 * c1, r2 * s2])
}

/// The rotation matrix of a quaternion (w, x, y, z), each entry correctly rounded.
///
/// The components are first rounded to integers of 24 bits; then numerators and denominator are exact in f64 and each
/// entry is rounded once, so the matrix is as orthonormal as f64 allows.
pub(super) fn from_quaternion(q: [f64; 4]) -> Matrix3<f64> {
    let [w, x, y, z] = q.map(|c| (c * f64::from(1 << 24)).round());
    let n = w * w + x * x + y * y + z * z;
    Matrix3::new(
        w * w + x * x - y * y - z * z,
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    ) / n
}
