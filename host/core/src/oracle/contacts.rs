//! All pairs of triangles that meet, or come near.

use super::closest::closest;
use super::filter;
use super::scene::Scene;
use super::triangle::Triangle;

/// Calls `visit` for each meeting pair until it says stop (`false`); the last argument tells whether exact arithmetic
/// had to decide.
pub(crate) fn each(scene: &Scene, mut visit: impl FnMut([u32; 2], &Triangle, &Triangle, bool) -> bool) {
    let mut look = |pair: [u32; 2]| {
        let (a, b) = scene.triangles(pair);
        let certain = filter::hit(&a, &b);
        let meets = certain.unwrap_or_else(|| scene.exact(pair).hit());
        !meets || visit(pair, &a, &b, certain.is_none())
    };
    let Some(frame) = &scene.frame else {
        let _ = scene.all_pairs().all(look);
        return;
    };
    let mut stack = vec![frame.roots()];
    while let Some((a, b)) = stack.pop() {
        if let Some(pair) = frame.triangles(a, b) {
            if !look(pair) {
                return;
            }
        } else {
            frame.expand(a, b, |a, b, bound| {
                if bound <= 0.0 {
                    stack.push((a, b));
                }
            });
        }
    }
}

/// Upper bound of the number of pairs of triangles within a distance (in units).
pub(crate) fn count_within(scene: &Scene, distance: f64) -> u64 {
    let Some(frame) = &scene.frame else { return scene.all_pairs().count() as u64 };
    let (mut count, mut stack) = (0, vec![frame.roots()]);
    while let Some((a, b)) = stack.pop() {
        if let Some(pair) = frame.triangles(a, b) {
            let (a, b) = scene.triangles(pair);
            count += u64::from(closest(&a, &b).lo <= distance);
        } else {
            frame.expand(a, b, |a, b, bound| {
                if f64::from(bound) <= distance {
                    stack.push((a, b));
                }
            });
        }
    }
    count
}

/// A pair of triangles that may be within a distance (in units); `None` when certainly none is.
pub(crate) fn within(scene: &Scene, distance: f64) -> Option<[u32; 2]> {
    let near = |pair: &[u32; 2]| {
        let (a, b) = scene.triangles(*pair);
        closest(&a, &b).lo <= distance
    };
    let Some(frame) = &scene.frame else { return scene.all_pairs().next() };
    let mut found = None;
    let mut stack = vec![frame.roots()];
    while let Some((a, b)) = stack.pop() {
        if let Some(pair) = frame.triangles(a, b) {
            found = Some(pair).filter(near);
            if found.is_some() {
                break;
            }
        } else {
            frame.expand(a, b, |a, b, bound| {
                if f64::from(bound) <= distance {
                    stack.push((a, b));
                }
            });
        }
    }
    found
}
