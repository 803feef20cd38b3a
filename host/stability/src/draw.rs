//! Numbers, points and rotations of a seed.

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use ocb_core::numbers::Numbers;

/// A sequence of draws.
#[derive(Clone, Debug)]
pub struct Draw(Numbers);

impl Draw {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        // Neighbouring seeds begin far from each other.
        Self(Numbers::new(Numbers::new(seed).bits()))
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [from, to).
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// A number from 0 to n-1.
    pub fn below(&mut self, n: usize) -> usize {
        self.0.below(n)
    }

    /// One of two.
    pub fn coin(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Any order.
    pub fn shuffle<T>(&mut self, values: &mut [T]) {
        self.0.shuffle(values);
    }

    /// Uniform in the cube from -1 to 1.
    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-1.0, 1.0))
    }

    /// Length 1 up to rounding, every direction alike.
    pub fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = self.vector();
            if (0.01..=1.0).contains(&v.norm_squared()) {
                return v.normalize();
            }
        }
    }

    /// Uniform in the cube from -1 to 1.
    pub fn point(&mut self) -> Point3<f64> {
        self.vector().into()
    }

    /// A rotation up to rounding.
    pub fn rotation(&mut self) -> Matrix3<f64> {
        loop {
            let q = Quaternion::from(nalgebra::Vector4::from_fn(|_, _| self.between(-1.0, 1.0)));
            if (0.01..=1.0).contains(&q.norm_squared()) {
                return *UnitQuaternion::from_quaternion(q).to_rotation_matrix().matrix();
            }
        }
    }

    /// A triangle that is no sliver, some two units across, in single precision.
    pub fn triangle(&mut self) -> [Point3<f64>; 3] {
        loop {
            let t = [(); 3].map(|()| self.point().map(|x| f64::from(x as f32)));
            let (u, v) = (t[1] - t[0], t[2] - t[0]);
            if u.cross(&v).norm() > 0.5 * u.norm_squared().max(v.norm_squared()).sqrt() {
                return t;
            }
        }
    }
}
