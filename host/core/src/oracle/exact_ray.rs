//! Does a ray cross a triangle? In exact integers.

use dashu_int::IBig;

use super::exact::{ExactPair, signum};
use super::exact_vector::{Vector, cross, dot, sub};

impl ExactPair {
    /// Does the ray from the first vertex of A, which does not lie on the triangle, cross B's triangle? `None` when it
    /// runs through an edge or a corner of it, or along its plane: then another direction must be asked.
    pub(crate) fn ray_crosses(&self, direction: [i32; 3]) -> Option<bool> {
        let d: Vector = direction.map(IBig::from);
        let [a, b, c] = self.b.each_ref().map(|v| sub(v, &self.a[0]));
        let across = [(&a, &b), (&b, &c), (&c, &a)].map(|(s, t)| signum(&dot(&d, &cross(s, t))));
        if across.contains(&1) && across.contains(&-1) {
            return Some(false);
        }
        if across.contains(&0) {
            return None;
        }
        // The line passes through the inside of the triangle; the plane lies ahead of the start or behind it.
        let normal = cross(&sub(&b, &a), &sub(&c, &a));
        Some(signum(&dot(&normal, &a)) * signum(&dot(&normal, &d)) > 0)
    }
}
