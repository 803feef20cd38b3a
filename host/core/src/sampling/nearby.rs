//! How far B is from A, as far as that matters for where to start: a cheap look, not a certified answer.

use nalgebra::Vector3;

use crate::bvh::{BestFirst, Frame};
use crate::configuration::Configuration;
use crate::oracle::{Pair, closest_points};

/// What a look shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Nearby {
    /// The surfaces meet, or are nearer than wanted.
    Blocked,
    /// Certainly further than the limit.
    Far,
    /// The distance in f64, the direction from A's nearest point to B's, and the triangles they lie on.
    At { distance: f64, direction: Vector3<f64>, pair: [u32; 2] },
}

/// Looks for the nearest pair of triangles between `least` and `most`.
pub(super) fn look(pair: &Pair, configuration: &Configuration, least: f64, most: f64) -> Nearby {
    let (a, b) = (pair.a(), pair.b());
    let size = 4.0 * (pair.scene_size(configuration) + most);
    let (pose_a, pose_b) = (&configuration.pose_a, &configuration.pose_b);
    let Some(frame) = Frame::new(a.tree(), pose_a, b.tree(), pose_b, size) else { return Nearby::Blocked };
    let mut queue = BestFirst::default();
    let (root_a, root_b) = frame.roots();
    queue.push(0.0, root_a, root_b);
    let mut limit = most;
    let mut nearest = Nearby::Far;
    while let Some((bound, slot_a, slot_b)) = queue.pop() {
        if f64::from(bound) * frame.unit >= limit {
            break;
        }
        let Some([i, j]) = frame.triangles(slot_a, slot_b) else {
            let limit = (limit / frame.unit) as f32;
            frame.expand(slot_a, slot_b, |a, b, child_bound| {
                if child_bound <= limit {
                    queue.push(child_bound.max(bound), a, b);
                }
            });
            continue;
        };
        let triangle_a = a.corners(i);
        let origin = triangle_a[0];
        let triangle_a = triangle_a.map(|p| p - origin);
        let triangle_b = b.corners(j).map(|p| pose_b.apply(&p) - origin);
        let (pa, pb) = closest_points(&triangle_a, &triangle_b);
        let between = pb - pa;
        let distance = between.norm();
        // Where the direction does not separate them, they cross.
        let end_a = triangle_a.iter().map(|v| between.dot(&(v - pa))).fold(f64::NEG_INFINITY, f64::max);
        let start_b = triangle_b.iter().map(|v| between.dot(&(v - pa))).fold(f64::INFINITY, f64::min);
        if distance <= least || start_b <= end_a {
            return Nearby::Blocked;
        }
        if distance < limit {
            limit = distance;
            nearest = Nearby::At { distance, direction: between / distance, pair: [i, j] };
        }
    }
    nearest
}
