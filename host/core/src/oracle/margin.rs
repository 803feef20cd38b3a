//! How robustly two triangles cross.
//!
//! A segment `pq` crosses a triangle `abc` because five orientations have the right signs: `p` and `q` lie on opposite
//! sides of the plane, and `pq` passes `ab`, `bc` and `ca` on the same side. While the vertices move continuously, the
//! crossing can end only where an end of `pq` meets the triangle, or `pq` meets one of its edges. Two things meet when each
//! vertex moves by `m` only if they were at most `2 m` apart. So while no vertex moves further than half the smallest of
//! five distances, the crossing holds: from `p` and from `q` to the plane, and between the lines of `pq` and each edge.

use nalgebra::Vector3;

use super::filter::orientation;
use super::triangle::Triangle;

/// Unit roundoff of f64.
const U: f64 = f64::EPSILON / 2.0;

/// A certain crossing of two triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Certified lower bound: every vertex may move so far and the triangles still cross.
    pub(crate) margin: f64,
    /// Where an edge of one passes through the other.
    pub(crate) point: Vector3<f64>,
}

/// The most robust of the six crossings of an edge with a triangle; `None` when none is certain.
pub(crate) fn crossing(a: &Triangle, b: &Triangle) -> Option<Crossing> {
    // Moving all vertices by their error changes each width by at most twice as much, the margin by as much.
    let error = 1.75 * a.error.max(b.error);
    let mut best: Option<Crossing> = None;
    for (edges, face) in [(&a.vertices, &b.vertices), (&b.vertices, &a.vertices)] {
        for i in 0..3 {
            if let Some(found) = edge_through_face(&edges[i], &edges[(i + 1) % 3], face)
                && found.margin > error
                && best.is_none_or(|b| found.margin - error > b.margin)
            {
                best = Some(Crossing { margin: found.margin - error, point: found.point });
            }
        }
    }
    best
}

fn edge_through_face(p: &Vector3<f64>, q: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3]) -> Option<Crossing> {
    let side = |x: &Vector3<f64>| signed_volume(a, b, c, x);
    let (side_p, side_q) = (side(p)?, side(q)?);
    let across = [signed_volume(p, q, a, b)?, signed_volume(p, q, b, c)?, signed_volume(p, q, c, a)?];
    let same = across.iter().all(|v| *v > 0.0) || across.iter().all(|v| *v < 0.0);
    if (side_p > 0.0) == (side_q > 0.0) || !same {
        return None;
    }
    let normal = longest(a, b, a, c);
    let distances = [
        side_p.abs() / normal,
        side_q.abs() / normal,
        across[0].abs() / longest(p, q, a, b),
        across[1].abs() / longest(p, q, b, c),
        across[2].abs() / longest(p, q, c, a),
    ];
    let nearest = distances.into_iter().fold(f64::INFINITY, f64::min);
    let along = side_p.abs() / (side_p.abs() + side_q.abs());
    Some(Crossing { margin: nearest / 2.0 * (1.0 - 1e-14), point: p + (q - p) * along })
}

/// Six times the signed volume, reduced toward 0 by its error bound; `None` when the sign is not certain.
fn signed_volume(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>, s: &Vector3<f64>) -> Option<f64> {
    let (value, bound) = orientation(p, q, r, s, 0.0);
    // Written so that NaN is uncertain.
    if value.abs() > bound { Some(value - bound.copysign(value)) } else { None }
}

/// The length of `pq` x `rs`, not less than it is.
fn longest(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>, s: &Vector3<f64>) -> f64 {
    let (x, y) = (q - p, s - r);
    x.cross(&y).norm() + 16.0 * U * x.norm() * y.norm()
}
