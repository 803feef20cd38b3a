//! Random placement: B anywhere and anyhow in a box around A, of which a wanted share collides [van den Bergen 1997].

use nalgebra::Vector3;

use super::SamplingError;
use super::approach::ball;
use super::low_discrepancy::placement;
use crate::configuration::{Configuration, Placed};
use crate::oracle::{Pair, Shape};
use crate::pose::Pose;

/// Poses by which the box is chosen.
const PILOT: u64 = 1000;
/// The share of those may miss the wanted one by so much.
const TOLERANCE: f64 = 0.02;

/// The poses in one cube.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    pair: Pair<'a>,
    centre_a: Vector3<f64>,
    centre_b: Vector3<f64>,
    side: f64,
    len: u64,
    seed: u64,
}

impl<'a> Plan<'a> {
    /// The centre of B's bounding box is anywhere in a cube around the centre of A's; the cube's side is found by
    /// bisection on the first thousand poses, whose collisions are certain.
    pub(super) fn new(
        a: &'a Shape,
        b: &'a Shape,
        count: u32,
        share: f64,
        seed: u64,
        stopped: &dyn Fn() -> bool,
    ) -> Result<Self, SamplingError> {
        let ((centre_a, radius_a), (centre_b, radius_b)) = (ball(a), ball(b));
        let mut plan = Self {
            pair: Pair::new(a, b),
            centre_a: centre_a.coords,
            centre_b: centre_b.coords,
            side: 0.0,
            len: u64::from(count),
            seed,
        };
        // At the upper end hardly any collides, unless the share is smaller than that.
        let (mut lower, mut upper) = (0.0, 2.0 * (radius_a + radius_b) / libm::cbrt(share));
        let mut found = 0.0;
        for _ in 0..24 {
            plan.side = f64::midpoint(lower, upper);
            found = plan.hits(stopped)? as f64 / PILOT as f64;
            if (found - share).abs() < 0.5 / PILOT as f64 {
                break;
            }
            if found > share {
                lower = plan.side;
            } else {
                upper = plan.side;
            }
        }
        if (found - share).abs() > TOLERANCE {
            return Err(SamplingError::NoBox { wanted: share, found });
        }
        Ok(plan)
    }

    fn hits(&self, stopped: &dyn Fn() -> bool) -> Result<u64, SamplingError> {
        let mut hits = 0;
        for pose in 0..PILOT {
            if stopped() {
                return Err(SamplingError::Stopped);
            }
            hits += u64::from(self.pair.hit(&self.configuration(pose)));
        }
        Ok(hits)
    }

    pub(super) fn len(&self) -> u64 {
        self.len
    }

    pub(super) fn side(&self) -> f64 {
        self.side
    }

    fn configuration(&self, index: u64) -> Configuration {
        let (place, linear) = placement(index, self.seed);
        let centre = self.centre_a + (place - Vector3::repeat(0.5)) * self.side;
        Configuration {
            pose_a: Pose::identity(),
            pose_b: Pose { linear, translation: centre - linear * self.centre_b },
        }
    }

    pub(super) fn place(&self, index: u64) -> Placed {
        let configuration = self.configuration(index);
        Placed { configuration, truth: self.pair.truth(&configuration), rounded: None, root_index: 0, wanted: None }
    }
}
