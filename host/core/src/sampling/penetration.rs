//! Going on along the ray until the objects cross as robustly as wanted.
//!
//! The certified margin grows from 0 with the depth, about half as fast, as long as one pair of triangles decides; on a
//! fine mesh it is bounded by the size of the triangles. So it is searched for as a root in a bracket, and where the
//! window is out of reach the most robust crossing on the way is kept: its truth says what it is.

use nalgebra::Vector3;

use crate::configuration::{Configuration, Placed, Separation};
use crate::oracle::Pair;

/// Looks at the margin at so many places at most.
const MOST_LOOKS: u32 = 32;
/// No deeper than this many wanted margins.
const DEEPEST: f64 = 10.0;
/// Where the objects slide past each other, the way is not longer than this per depth.
const LEAST_SPEED: f64 = 0.25;

/// From a position just outside, B moving against `direction`, to one whose crossing margin is in
/// `(step S, 2 step S]`, looked for from `place` in it on, or else to the one with the largest margin below; `None` when no crossing is certain.
pub(super) fn deepen(pair: &Pair, outside: &Placed, direction: &Vector3<f64>, step: f64, place: f64) -> Option<Placed> {
    // In wanted margins, a little inside the window.
    let aim = 1.1 + 0.8 * place;
    let at = |way: f64| {
        let mut configuration = outside.configuration;
        configuration.pose_b.translation -= direction * way;
        configuration
    };
    let truth = &outside.truth;
    let between = truth.witness.point_b - truth.witness.point_a;
    let speed = between.try_normalize(0.0).map_or(1.0, |n| n.dot(direction)).clamp(LEAST_SPEED, 1.0);
    let least = step * pair.scene_size(&outside.configuration);
    let limit = (truth.distance_hi + DEEPEST * least) / speed;
    // The margin is about half the depth.
    let (mut lower, mut lower_value) = (0.0, -truth.distance_hi / 2.0);
    let mut upper: Option<(f64, f64)> = None;
    let mut way = (truth.distance_hi + 2.0 * aim * least) / speed;
    let mut best: Option<(f64, Configuration)> = None;
    for _ in 0..MOST_LOOKS {
        let configuration = at(way);
        let margin = pair.contact_margins(&configuration).iter().map(|c| c.margin).reduce(f64::max);
        let least = step * pair.scene_size(&configuration);
        match margin {
            Some(margin) if margin > 2.0 * least => upper = Some((way, margin)),
            _ => {
                if let Some(margin) = margin
                    && best.is_none_or(|(most, _)| margin > most)
                    && margin > 0.0
                {
                    best = Some((margin, configuration));
                    if margin > least {
                        break;
                    }
                }
                (lower, lower_value) = (way, margin.unwrap_or(lower_value));
            }
        }
        way = match upper {
            Some((upper, upper_value)) => {
                let share = (aim * least - lower_value) / (upper_value - lower_value);
                lower + (upper - lower) * share.clamp(0.1, 0.9)
            }
            None if way >= limit => break,
            None => (1.5 * way).min(limit),
        };
    }
    let (_, configuration) = best?;
    let truth = pair.truth(&configuration);
    Some(Placed { configuration, truth, wanted: Some(Separation::Step { of_size: -step }), ..*outside })
}
