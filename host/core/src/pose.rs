//! Placement of one object in the world.

use nalgebra::{Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// A placement `x -> linear * x + translation`, in the object's length unit.
///
/// The entries are kept exactly as given: the truth is defined on these numbers (exact real arithmetic), so nothing is
/// re-orthonormalised. The 4x4 matrix exists only at the plugin ABI and in files.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Rotation part; a rotation up to rounding, but any finite matrix is accepted.
    pub linear: Matrix3<f64>,
    /// Translation.
    pub translation: Vector3<f64>,
}

/// Largest deviation ([`Pose::off_rotation`]) of a rotation up to rounding.
const ROUNDING: f64 = 2e-15;
/// Largest deviation at which a matrix is used unchanged.
pub const AS_IT_IS: f64 = 1e-12;
/// Largest deviation of a rotation in single precision.
pub const STRAIGHTENED: f64 = 1e-5;

/// Why 16 numbers are no pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PoseError {
    /// An entry is NaN or infinite.
    #[error("matrix entry {0} (row-major, from 0) is not a finite number")]
    NotFinite(usize),
    /// The last row is not 0 0 0 1.
    #[error("the last row of the matrix must be 0 0 0 1")]
    LastRow,
}

impl Pose {
    /// The object where its file puts it.
    pub fn identity() -> Self {
        Self { linear: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// From a row-major 4x4 matrix; entries are taken as they are.
    pub fn from_row_major(m: &[f64; 16]) -> Result<Self, PoseError> {
        if let Some(i) = m.iter().position(|x| !x.is_finite()) {
            return Err(PoseError::NotFinite(i));
        }
        if m[12..] != [0.0, 0.0, 0.0, 1.0] {
            return Err(PoseError::LastRow);
        }
        Ok(Self {
            linear: Matrix3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
            translation: Vector3::new(m[3], m[7], m[11]),
        })
    }

    /// As a row-major 4x4 matrix, bit for bit what [`Pose::from_row_major`] took.
    pub fn to_row_major(&self) -> [f64; 16] {
        let (r, t) = (&self.linear, &self.translation);
        [
            r[(0, 0)],
            r[(0, 1)],
            r[(0, 2)],
            t.x, //
            r[(1, 0)],
            r[(1, 1)],
            r[(1, 2)],
            t.y, //
            r[(2, 0)],
            r[(2, 1)],
            r[(2, 2)],
            t.z, //
            0.0,
            0.0,
            0.0,
            1.0,
        ]
    }

    /// How far the linear part is off a rotation: the largest entry of `R^T R - 1`, and infinity for a mirror.
    pub fn off_rotation(&self) -> f64 {
        if self.linear.determinant() > 0.0 {
            (self.linear.tr_mul(&self.linear) - Matrix3::identity()).amax()
        } else {
            f64::INFINITY
        }
    }

    /// The relative difference between two correct programs of which one inverts the linear part and the other transposes it. 0 for
    /// rotations up to rounding, and for deliberate shear and scale, where the exact numbers count.
    pub fn bend(&self) -> f64 {
        let off = self.off_rotation();
        if (ROUNDING..=AS_IT_IS).contains(&off) { 4.0 * off } else { 0.0 }
    }

    /// With the nearest rotation instead; `None` when the linear part is further off than single precision explains.
    pub fn straightened(&self) -> Option<Self> {
        let svd = self.linear.svd(true, true);
        let linear = svd.u? * svd.v_t?;
        (self.off_rotation() <= STRAIGHTENED).then_some(Self { linear, ..*self })
    }

    /// Where a point of the world lies in the object's own frame, rounded likewise; `None` when the pose flattens.
    pub fn locate(&self, p: &Point3<f64>) -> Option<Point3<f64>> {
        let back = self.linear.try_inverse()?;
        Some(Point3::from(back * (p.coords - self.translation)))
    }

    /// The point in the world, rounded as f64 arithmetic rounds.
    pub fn apply(&self, p: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.linear * p.coords + self.translation)
    }
}
