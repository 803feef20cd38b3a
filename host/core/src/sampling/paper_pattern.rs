//! The paper's pattern: latitude and longitude for the direction, Euler angles for the rotation.
//!
//! The steps are arcs: moving B by `m` degrees means `m` degrees along the sphere, so the row at polar angle `theta` has
//! `round(360/m * sin(theta))` places and the pattern does not crowd at the poles. The rows stand at
//! `(k + 1/2) * 180/rows` degrees, `rows = round(180/m)`. Rotations are the same rows for the tilted axis (two Euler
//! angles), each with `round(360/r)` turns about it (the third). At 20 and 20 degrees that is 104 directions times
//! 104 * 18 = 1872 rotations: 194,688 configurations, the paper's "around 200k".

use nalgebra::Vector3;

use super::low_discrepancy::{Sample, from_quaternion};

/// A latitude/longitude pattern of arc steps.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    /// Places before each row, and all at the end.
    starts: Vec<u64>,
}

impl Rows {
    pub(super) fn new(step_degrees: f64) -> Self {
        let rows = (180.0 / step_degrees).round().max(1.0) as u64;
        let mut starts = vec![0];
        for row in 0..rows {
            let theta = polar_angle(row, rows);
            let places = (360.0 / step_degrees * libm::sin(theta)).round().max(1.0) as u64;
            starts.push(starts[row as usize] + places);
        }
        Self { starts }
    }

    pub(super) fn len(&self) -> u64 {
        self.starts[self.starts.len() - 1]
    }

    /// Polar angle and longitude of a place, radians.
    fn angles(&self, index: u64) -> (f64, f64) {
        let row = self.starts.partition_point(|&s| s <= index) - 1;
        let places = self.starts[row + 1] - self.starts[row];
        let longitude = (index - self.starts[row]) as f64 / places as f64 * std::f64::consts::TAU;
        (polar_angle(row as u64, self.starts.len() as u64 - 1), longitude)
    }
}

fn polar_angle(row: u64, rows: u64) -> f64 {
    (row as f64 + 0.5) / rows as f64 * std::f64::consts::PI
}

/// Turns about the tilted axis.
pub(super) fn turns(step_degrees: f64) -> u64 {
    (360.0 / step_degrees).round().max(1.0) as u64
}

/// Directions times rotations.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    directions: Rows,
    axes: Rows,
    turns: u64,
}

impl Pattern {
    pub(super) fn new(rotate: f64, move_by: f64) -> Self {
        Self { directions: Rows::new(move_by), axes: Rows::new(rotate), turns: turns(rotate) }
    }

    pub(super) fn len(&self) -> u64 {
        self.directions() * self.rotations()
    }

    /// Number of rotations; those of the first places are all of them.
    pub(super) fn rotations(&self) -> u64 {
        self.axes.len() * self.turns
    }

    /// Number of directions.
    pub(super) fn directions(&self) -> u64 {
        self.directions.len()
    }

    pub(super) fn sample(&self, index: u64) -> Sample {
        let rotations = self.rotations();
        let (place, rotation) = (index / rotations, index % rotations);
        let (theta, phi) = self.directions.angles(place);
        let ((sin, cos), (sin_phi, cos_phi)) = (libm::sincos(theta), libm::sincos(phi));
        let direction = Vector3::new(sin * cos_phi, sin * sin_phi, cos);
        // Euler angles z-y-z: R = Rz(alpha) Ry(beta) Rz(gamma), as a quaternion.
        let (beta, alpha) = self.axes.angles(rotation / self.turns);
        let gamma = (rotation % self.turns) as f64 / self.turns as f64 * std::f64::consts::TAU;
        let (sb, cb) = libm::sincos(beta / 2.0);
        let (ss, cs) = libm::sincos((alpha + gamma) / 2.0);
        let (sd, cd) = libm::sincos((alpha - gamma) / 2.0);
        (direction, from_quaternion([cb * cs, -sb * sd, sb * cd, cb * ss]))
    }
}
