//! From near to very near, along the same ray.
//!
//! Close to touching, f64 cannot follow a ray from far outside (a way of some 1 has steps of 1e-16), but it can follow
//! one from a position nearby: the distance is then known from exact arithmetic, and its slope from the last step.

use nalgebra::Vector3;

use super::approach::within;
use super::window::Window;
use crate::configuration::{Placed, Truth};
use crate::oracle::Pair;

/// Steps until it is given up.
const MOST_LOOKS: u32 = 48;
/// Slopes of the distance along the way that are believed.
const SLOPES: [f64; 2] = [0.02, 1.0];

/// From a position further away than wanted, B moving against `direction`, into the window.
pub(super) fn closer(pair: &Pair, from: &Placed, direction: &Vector3<f64>, window: &Window) -> Option<Placed> {
    let [least, most] = SLOPES;
    let between = from.truth.witness.point_b - from.truth.witness.point_a;
    let mut slope = between.try_normalize(0.0).map_or(1.0, |n| n.dot(direction)).clamp(least, most);
    let (mut outside, mut distance) = (0.0, middle(&from.truth));
    let mut inside: Option<f64> = None;
    let mut configuration = from.configuration;
    let mut near = [from.truth.witness.triangle_a, from.truth.witness.triangle_b];
    for _ in 0..MOST_LOOKS {
        let (wanted, _) = window.aim(pair.scene_size(&configuration));
        let mut way = outside + (distance - wanted) / slope;
        if let Some(inside) = inside
            && way >= inside
        {
            way = f64::midpoint(outside, inside);
        }
        configuration.pose_b.translation = from.configuration.pose_b.translation - direction * way;
        let truth = pair.truth_near(&configuration, Some(near));
        let (wanted, half) = window.aim(pair.scene_size(&configuration));
        if within(&truth, wanted, half) {
            return Some(Placed { configuration, truth, wanted: Some(window.separation), ..*from });
        }
        if middle(&truth) < wanted {
            inside = Some(way);
        } else {
            let seen = (distance - middle(&truth)) / (way - outside);
            slope = seen.clamp(least, most);
            (outside, distance) = (way, middle(&truth));
        }
        near = [truth.witness.triangle_a, truth.witness.triangle_b];
    }
    None
}

fn middle(truth: &Truth) -> f64 {
    f64::midpoint(truth.distance_lo, truth.distance_hi)
}
