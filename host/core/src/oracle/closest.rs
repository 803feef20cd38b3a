//! Closest points of two triangles in f64, with a certificate that does not trust them.
//!
//! Whatever the conditioning, the points found are *feasible* (each a convex combination of vertices), so their
//! distance is an upper bound; and the direction between them, used as a separating direction, gives a lower bound that
//! holds whether or not the points are the closest ones.

use nalgebra::Vector3;

use super::triangle::Triangle;

/// Unit roundoff of f64.
const U: f64 = f64::EPSILON / 2.0;

/// The best pair of points found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest {
    pub(crate) point_a: Vector3<f64>,
    pub(crate) point_b: Vector3<f64>,
    /// Certified lower bound of the distance (0 when nothing could be certified).
    pub(crate) lo: f64,
    /// Certified upper bound of the distance.
    pub(crate) hi: f64,
}

/// Closest points of two triangles and certified bounds of their distance.
///
/// For triangles that intersect, `lo` is 0 and `hi` is still a feasible distance (not 0 in general).
pub(crate) fn closest(a: &Triangle, b: &Triangle) -> Closest {
    // A local origin keeps the rounding relative to the triangles' own extent.
    let origin = a.vertices[0];
    let va = a.vertices.map(|v| v - origin);
    let vb = b.vertices.map(|v| v - origin);
    let extent = va.iter().chain(&vb).map(|v| v.amax()).fold(0.0, f64::max);
    // Coordinates are now off by the triangles' own error and by the subtraction.
    let error = a.error + b.error + 2.0 * U * extent;

    let (pa, pb) = closest_points(&va, &vb);
    let n = pb - pa;
    let length = n.norm();
    // Each feasible point was rounded when it was computed: at most 8 U of the extent in each of three coordinates.
    let hi = length * (1.0 + 8.0 * U) + 2.0 * (error + 16.0 * U * extent);
    let mut lo = 0.0;
    if length > 0.0 {
        let far_a = va.iter().map(|v| n.dot(&(v - pa))).fold(f64::NEG_INFINITY, f64::max);
        let near_b = vb.iter().map(|v| n.dot(&(v - pa))).fold(f64::INFINITY, f64::min);
        // A dot product of three terms with rounded differences; `|v - pa|` is at most twice the extent per coordinate.
        let rounding = 8.0 * U * (n.x.abs() + n.y.abs() + n.z.abs()) * 2.0 * extent;
        let gap = near_b - far_a - 2.0 * rounding;
        lo = (gap / length * (1.0 - 8.0 * U) - 2.0 * error).max(0.0);
    }
    Closest { point_a: pa + origin, point_b: pb + origin, lo, hi }
}

pub(crate) fn closest_points(a: &[Vector3<f64>; 3], b: &[Vector3<f64>; 3]) -> (Vector3<f64>, Vector3<f64>) {
    let mut best = (f64::INFINITY, a[0], b[0]);
    let mut offer = |pa: Vector3<f64>, pb: Vector3<f64>| {
        let d2 = (pb - pa).norm_squared();
        if d2 < best.0 {
            best = (d2, pa, pb);
        }
    };
    for i in 0..3 {
        for j in 0..3 {
            let (pa, pb) = segment_segment(&a[i], &a[(i + 1) % 3], &b[j], &b[(j + 1) % 3]);
            offer(pa, pb);
        }
    }
    for p in b {
        if let Some(foot) = foot_in_triangle(p, a) {
            offer(foot, *p);
        }
    }
    for p in a {
        if let Some(foot) = foot_in_triangle(p, b) {
            offer(*p, foot);
        }
    }
    (best.1, best.2)
}

/// The foot of `p` on the plane, as a convex combination of the vertices; `None` when it lies outside.
fn foot_in_triangle(p: &Vector3<f64>, t: &[Vector3<f64>; 3]) -> Option<Vector3<f64>> {
    let (e1, e2, r) = (t[1] - t[0], t[2] - t[0], p - t[0]);
    let n = e1.cross(&e2);
    let n2 = n.norm_squared();
    let (v, w) = (n.dot(&r.cross(&e2)), n.dot(&e1.cross(&r)));
    if v >= 0.0 && w >= 0.0 && v + w <= n2 && n2 > 0.0 {
        // Dividing by a sum that is not smaller than either keeps the weights in [0, 1] whatever the rounding.
        let (v, w) = (v / n2, w / n2);
        let w = w.min(1.0 - v);
        return Some(t[0] + e1 * v + e2 * w);
    }
    None
}

/// Closest points of two segments, parameters clamped (Ericson, Real-Time Collision Detection, 5.1.9).
fn segment_segment(
    p1: &Vector3<f64>,
    q1: &Vector3<f64>,
    p2: &Vector3<f64>,
    q2: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e) = (d1.norm_squared(), d2.norm_squared());
    let (b, c, f) = (d1.dot(&d2), d1.dot(&r), d2.dot(&r));
    let clamp = |numerator: f64, denominator: f64| {
        if denominator > 0.0 { (numerator / denominator).clamp(0.0, 1.0) } else { 0.0 }
    };
    let mut s = clamp(b * f - c * e, a * e - b * b);
    let mut t = if e > 0.0 { (b * s + f) / e } else { 0.0 };
    if t < 0.0 {
        t = 0.0;
        s = clamp(-c, a);
    } else if t > 1.0 {
        t = 1.0;
        s = clamp(b - c, a);
    }
    (p1 + d1 * s, p2 + d2 * t)
}
