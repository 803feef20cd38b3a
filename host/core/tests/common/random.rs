//! A small deterministic generator.

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use ocb_core::pose::Pose;

/// SplitMix64.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A generator of its own for each number: what one draws does not depend on what another drew.
    pub fn of(seed: u64, number: u64) -> Self {
        Self(Self(seed ^ Self(number).bits()).bits())
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Uniform below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    /// One of two.
    pub fn coin(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Uniform from `from` to `to`, both included.
    pub fn integer(&mut self, from: i32, to: i32) -> i32 {
        from + self.below((to - from + 1) as usize) as i32
    }

    /// Uniform in the cube from -1 to 1.
    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.signed(), self.signed(), self.signed())
    }

    /// Uniform in the cube from -1 to 1.
    pub fn point(&mut self) -> Point3<f64> {
        self.vector().into()
    }

    /// A vector of length 1 up to rounding; denser toward the corners of a cube.
    pub fn direction(&mut self) -> Vector3<f64> {
        self.vector().normalize()
    }

    /// A rotation up to rounding.
    pub fn rotation(&mut self) -> Matrix3<f64> {
        let q = Quaternion::new(self.signed(), self.signed(), self.signed(), self.signed());
        *UnitQuaternion::from_quaternion(q).to_rotation_matrix().matrix()
    }

    /// A rotation up to rounding, and a translation in a cube.
    pub fn pose(&mut self, reach: f64) -> Pose {
        Pose { linear: self.rotation(), translation: self.vector() * reach }
    }
}
