//! Coherent motion: B tumbles at a fixed distance of the centres [Zachmann 1998].
//!
//! As published: two objects stand at a distance of their bounding boxes' centres, and one performs a full turn about
//! the z and the x axis in 5,000 small steps. The publication scales its objects to a cube of side 2 and gives the
//! distance in that measure; here it is a share of L, half of it. B stands along the x axis of A, and frame `k` of `n`
//! turns it about its own centre by `360 k / n` degrees, first about x, then by the same angle about z.

use nalgebra::Vector3;

use super::approach::{ball, bounds};
use super::low_discrepancy::from_quaternion;
use crate::configuration::{Configuration, Placed};
use crate::oracle::{Pair, Shape};
use crate::pose::Pose;

/// The frames of one run.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    pair: Pair<'a>,
    /// Where the centre of B's box stands.
    centre: Vector3<f64>,
    centre_b: Vector3<f64>,
    len: u64,
}

impl<'a> Plan<'a> {
    pub(super) fn new(a: &'a Shape, b: &'a Shape, center_distance: f64, frames: u32) -> Self {
        let (lo, hi) = bounds(a);
        let centre = ball(a).0.coords + Vector3::x() * (center_distance * (hi - lo).amax());
        Self { pair: Pair::new(a, b), centre, centre_b: ball(b).0.coords, len: u64::from(frames) }
    }

    pub(super) fn len(&self) -> u64 {
        self.len
    }

    pub(super) fn place(&self, frame: u64) -> Placed {
        let (s, c) = libm::sincos(std::f64::consts::PI * frame as f64 / self.len as f64);
        // The quaternion of the turn about z times that about x.
        let linear = from_quaternion([c * c, c * s, s * s, s * c]);
        let translation = self.centre - linear * self.centre_b;
        let configuration = Configuration { pose_a: Pose::identity(), pose_b: Pose { linear, translation } };
        Placed { configuration, truth: self.pair.truth(&configuration), rounded: None, root_index: 0, wanted: None }
    }
}
