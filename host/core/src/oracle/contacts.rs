//! All pairs of triangles that meet.

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
