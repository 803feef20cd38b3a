//! A mapped triangle in f64 with a bound of its rounding.

use nalgebra::{Point3, Vector3};

use crate::pose::Pose;

/// World vertices in f64; the exact ones differ by at most `error` in every coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(crate) vertices: [Vector3<f64>; 3],
    pub(crate) error: f64,
}

impl Triangle {
    /// The corners where `pose` puts them, times `scale` (a power of two, so that it rounds nothing).
    pub(crate) fn mapped(pose: &Pose, corners: &[Point3<f64>; 3], scale: f64) -> Self {
        let mut error = 0.0f64;
        let vertices = corners.map(|p| {
            let (v, e) = map(pose, &p);
            error = error.max(e * scale);
            v * scale
        });
        // Numbers below the normal range would round in the scaling.
        Self { vertices, error: error + f64::MIN_POSITIVE }
    }
}

/// The mapped point and a bound of its error per coordinate: 0 when the linear part is the identity without translation.
fn map(pose: &Pose, p: &Point3<f64>) -> (Vector3<f64>, f64) {
    let mut error = 0.0f64;
    let v = Vector3::from_fn(|row, _| {
        let terms = [
            pose.linear[(row, 0)] * p.x,
            pose.linear[(row, 1)] * p.y,
            pose.linear[(row, 2)] * p.z,
            pose.translation[row],
        ];
        let sum = terms[0] + terms[1] + terms[2] + terms[3];
        // Products by 0 and 1 and sums with 0 are exact: a pose that does not move the row leaves it untouched.
        let plain = (0..3).all(|k| pose.linear[(row, k)] == if k == row { 1.0 } else { 0.0 });
        if !(plain && pose.translation[row] == 0.0) {
            // Three products and three sums: each term is rounded at most four times.
            let magnitude = terms.iter().map(|t| t.abs()).sum::<f64>();
            error = error.max(magnitude * (2.5 * f64::EPSILON) + f64::MIN_POSITIVE);
        }
        sum
    });
    (v, error)
}
