//! Certain bounds for eight pairs of boxes at once: of their distance, and of the way after which they come near.
//!
//! Every bound is computed in f32 and then made smaller by the frame's slack, which is more than all roundings together.

use wide::f32x8;

use super::frame::Frame;
use super::wide_node::Projections;

impl Frame<'_> {
    /// Per axis the boxes are at least `|distance| - extent` apart; three perpendicular gaps add up as in Pythagoras.
    pub(super) fn distance_bounds(&self, p: &Projections) -> f32x8 {
        let zero = f32x8::splat(0.0);
        let squared = |axes: &[(f32x8, f32x8); 3]| {
            let gap = axes.map(|(distance, extent)| (distance.abs() - extent).max(zero));
            gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]
        };
        let bound = squared(&p.other).max(squared(&p.own)).sqrt();
        // The line of centres separates best where boxes are small against their distance.
        let (apart, extent) = p.along_centres();
        let bound = bound.max((apart - extent) / apart.sqrt().max(f32x8::splat(f32::MIN_POSITIVE)));
        // The axes are perpendicular and of length 1 only up to their rounding and the poses' deviation.
        self.certain(bound)
    }

    /// What is left of a computed distance when all rounding went the wrong way.
    pub(super) fn certain(&self, distance: f32x8) -> f32x8 {
        (distance * f32x8::splat(1.0 - 1e-5) - f32x8::splat(self.slack)).max(f32x8::splat(0.0))
    }

    /// The distance within which boxes count as arrived.
    ///
    /// The way itself is up to some units long and the speeds are rounded: four times the slack of a distance.
    pub(super) fn within(&self, target: f32) -> f32 {
        target * (1.0 + 1e-5) + 4.0 * self.slack
    }

    /// When the boxes may come within the target, and when they have left it along one axis (before `enter`: never).
    pub(super) fn way_bounds(
        &self,
        p: &Projections,
        speeds: &[f32x8; 3],
        own_speeds: &[f32x8; 3],
        velocity: &[f32; 3],
        target: f32,
    ) -> (f32x8, f32x8) {
        let within = self.within(target);
        let spare = f32x8::splat(within);
        let mut enter = f32x8::splat(0.0);
        let mut leave = f32x8::splat(f32::INFINITY);
        for (axes, speeds) in [(&p.other, speeds), (&p.own, own_speeds)] {
            for ((distance, extent), speed) in axes.iter().zip(speeds) {
                // A speed of 0 becomes one so small that it decides nothing but whether the axis separates for ever.
                let slowness = f32x8::splat(1.0) / speed.abs().max(f32x8::splat(1e-12));
                let sign = speed.simd_lt(f32x8::splat(0.0)).select(f32x8::splat(-1.0), f32x8::splat(1.0));
                let toward = *distance * sign;
                let reach = *extent + spare;
                enter = enter.max((-toward - reach) * slowness);
                leave = leave.min((reach - toward) * slowness);
            }
        }
        // Single axes say little about corners; that matters as soon as the target is more than rounding.
        if within > 64.0 * self.slack {
            let reached = enter;
            for (axes, speeds) in [(&p.other, speeds), (&p.own, own_speeds)] {
                enter = enter.max(next_on_way(axes, speeds, reached, within));
            }
            enter = next_between_centres(p, speeds, own_speeds, velocity, enter, within);
        }
        (enter, leave)
    }
}

/// One step of Newton's iteration for the way after which the gap vector of three axes is no longer than `within`.
///
/// Its length is convex along the way, so a step from before the root does not pass it; infinite when there is no root.
fn next_on_way(axes: &[(f32x8, f32x8); 3], speeds: &[f32x8; 3], way: f32x8, within: f32) -> f32x8 {
    let zero = f32x8::splat(0.0);
    let (mut squared, mut product) = (zero, zero);
    for ((distance, extent), speed) in axes.iter().zip(speeds) {
        let at = *distance + way * *speed;
        let gap = (at.abs() - *extent).max(zero);
        squared += gap * gap;
        product += gap * at.simd_lt(zero).select(-*speed, *speed);
    }
    let length = squared.sqrt();
    // The slope is rounded; a steeper one only makes the step shorter.
    let descent = f32x8::splat(4e-6) - product / length.max(f32x8::splat(f32::MIN_POSITIVE));
    let excess = length - f32x8::splat(within);
    let step = descent.simd_gt(zero).select(excess / descent, f32x8::splat(f32::INFINITY));
    excess.simd_gt(zero).select(way + step, way)
}

/// The same along the line of centres as it is after `way`.
fn next_between_centres(
    p: &Projections,
    speeds: &[f32x8; 3],
    own_speeds: &[f32x8; 3],
    velocity: &[f32; 3],
    way: f32x8,
    within: f32,
) -> f32x8 {
    let mut apart = f32x8::splat(0.0);
    let mut speed = f32x8::splat(0.0);
    for (centre, &velocity) in p.centres.iter().zip(velocity) {
        let at = *centre + way * f32x8::splat(velocity);
        apart += at * at;
        speed += at * f32x8::splat(velocity);
    }
    let mut extent = f32x8::splat(0.0);
    for i in 0..3 {
        extent += (p.other[i].0 + way * speeds[i]).abs() * p.half[i].0
            + (p.own[i].0 + way * own_speeds[i]).abs() * p.half[i].1;
    }
    let length = apart.sqrt();
    let excess = apart - extent - f32x8::splat(within) * length;
    let needed = excess
        / (length * f32x8::splat(4e-6) - speed).max(length * f32x8::splat(1e-9)).max(f32x8::splat(f32::MIN_POSITIVE));
    excess.simd_gt(f32x8::splat(0.0)).select(way + needed, way)
}
