//! How far apart are two triangles, and where?

use crate::Triangle;
use crate::meet::{ERROR, meet};
use crate::vector::{Vector, add_scaled, cross, dot, norm_1, sub};

/// A pair of points that realises a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// |a - b|^2.
    pub squared: f64,
    /// Point on A.
    pub a: Vector,
    /// Point on B.
    pub b: Vector,
}

/// The minimum distance of two closed triangles; 0 and a common point twice when they meet.
pub fn distance(a: &Triangle, b: &Triangle) -> Closest {
    distance_below(a, b, f64::INFINITY).unwrap_or(Closest { squared: f64::INFINITY, a: a[0], b: b[0] })
}

/// The same, if its square is below `limit`.
///
/// Every candidate is a pair of points clamped to their features, so that rounding in a parameter moves a point along
/// its triangle, never off it. Candidates near the border of their feature may be lost to rounding; the neighbouring
/// feature then has one that is as good.
#[inline]
pub fn distance_below(a: &Triangle, b: &Triangle, limit: f64) -> Option<Closest> {
    let mut best = Closest { squared: limit, a: a[0], b: b[0] };
    let (edges_a, edges_b) = (edges(a), edges(b));
    for i in 0..3 {
        for j in 0..3 {
            best.point_to_segment(a[i], b[j], edges_b[j], false);
            best.point_to_segment(b[j], a[i], edges_a[i], true);
            best.segment_to_segment(a[i], edges_a[i], b[j], edges_b[j]);
        }
    }
    let crossed = best.points_to_face(b, a, &edges_a, true) & best.points_to_face(a, b, &edges_b, false);
    // Only triangles that neither plane separates can meet without a feature pair at distance 0.
    if crossed && best.squared > 0.0 && meet(a, b) {
        return Some(common_point(a, b, &best));
    }
    (best.squared < limit).then_some(best)
}

/// The minimum distance of two segments, each given by its ends; a point is a segment with the same end twice.
#[inline]
pub fn segments(a: [Vector; 2], b: [Vector; 2]) -> Closest {
    let mut best = Closest { squared: f64::INFINITY, a: a[0], b: b[0] };
    let (d, e) = (sub(a[1], a[0]), sub(b[1], b[0]));
    for i in 0..2 {
        best.point_to_segment(a[i], b[0], e, false);
        best.point_to_segment(b[i], a[0], d, true);
    }
    best.segment_to_segment(a[0], d, b[0], e);
    best
}

fn edges(t: &Triangle) -> [Vector; 3] {
    [sub(t[1], t[0]), sub(t[2], t[1]), sub(t[0], t[2])]
}

/// 1 / x^2, or 0 for an edge or face without extent: then the parameter is 0 and the point is the first corner.
fn inverse(squared: f64) -> f64 {
    if squared > 0.0 { 1.0 / squared } else { 0.0 }
}

impl Closest {
    #[inline(always)]
    fn offer(&mut self, a: Vector, b: Vector) {
        let gap = sub(a, b);
        let squared = dot(gap, gap);
        if squared < self.squared {
            *self = Self { squared, a, b };
        }
    }

    /// A corner `p` of one triangle and the edge `s + t d` of the other; `swapped` when `p` belongs to B.
    #[inline(always)]
    fn point_to_segment(&mut self, p: Vector, s: Vector, d: Vector, swapped: bool) {
        let t = (dot(sub(p, s), d) * inverse(dot(d, d))).clamp(0.0, 1.0);
        let q = add_scaled(s, t, d);
        if swapped { self.offer(q, p) } else { self.offer(p, q) }
    }

    /// Inner points of two edges. The parameter comes from cross products: their relative error grows with 1 / sin of
    /// the angle, that of the usual determinant of dot products with its square. Parallel edges have nothing to offer
    /// that their ends have not.
    #[inline(always)]
    fn segment_to_segment(&mut self, p: Vector, d: Vector, q: Vector, e: Vector) {
        let normal = cross(d, e);
        let size = dot(normal, normal);
        let between = sub(q, p);
        let s = dot(cross(between, e), normal);
        let t = dot(cross(between, d), normal);
        // Written so that a NaN is no candidate.
        if !(size > 0.0 && s >= 0.0 && s <= size && t >= 0.0 && t <= size) {
            return;
        }
        let x = add_scaled(p, s / size, d);
        // Projecting back and forth once makes the error of both parameters one of second order.
        let t = (dot(sub(x, q), e) * inverse(dot(e, e))).clamp(0.0, 1.0);
        let y = add_scaled(q, t, e);
        let s = (dot(sub(y, p), d) * inverse(dot(d, d))).clamp(0.0, 1.0);
        self.offer(add_scaled(p, s, d), y);
    }

    /// The corners of `points` and the inside of `face`; `swapped` when `points` belongs to B. Answers whether the
    /// plane of `face` may cross the triangle `points`.
    #[inline(always)]
    fn points_to_face(&mut self, points: &Triangle, face: &Triangle, edges: &[Vector; 3], swapped: bool) -> bool {
        // Two edges and a normal; the third edge is -(d + e).
        let (d, e) = (edges[0], [-edges[2][0], -edges[2][1], -edges[2][2]]);
        let normal = cross(d, e);
        let size = dot(normal, normal);
        let mut below = false;
        let mut above = false;
        for &p in points {
            let from_corner = sub(p, face[0]);
            let height = dot(normal, from_corner);
            // The normal of a sliver is a poor one; what is certain about the height is this much.
            let error = ERROR * norm_1(d) * norm_1(e) * norm_1(from_corner);
            below |= height <= error;
            above |= height >= -error;
            let certain = (height.abs() - error).max(0.0);
            if size <= 0.0 || certain * certain >= self.squared * size {
                continue;
            }
            let parameters = |v: Vector| (dot(cross(v, e), normal) / size, dot(cross(d, v), normal) / size);
            let (mut s, mut t) = parameters(from_corner);
            if s < 0.0 || t < 0.0 || s + t > 1.0 {
                continue;
            }
            // So are s and t. Correcting them by the same formulas for what is left to the point leaves an error that is
            // proportional to the distance instead of the triangle.
            let foot = |s: f64, t: f64| add_scaled(add_scaled(face[0], s, d), t, e);
            let (ds, dt) = parameters(sub(p, foot(s, t)));
            (s, t) = ((s + ds).clamp(0.0, 1.0), (t + dt).clamp(0.0, 1.0));
            if s + t <= 1.0 {
                let q = foot(s, t);
                if swapped { self.offer(q, p) } else { self.offer(p, q) }
            }
        }
        below && above
    }
}

/// A point that two meeting triangles have in common, up to rounding. In one plane no edge goes through the other's plane;
/// then it is that of the nearest features.
#[cold]
fn common_point(a: &Triangle, b: &Triangle, features: &Closest) -> Closest {
    let mut best = Closest { squared: f64::INFINITY, ..*features };
    for (edged, face, swapped) in [(a, b, false), (b, a, true)] {
        let normal = cross(sub(face[1], face[0]), sub(face[2], face[0]));
        for (p, d) in edged.iter().zip(edges(edged)) {
            let t = (dot(normal, sub(face[0], *p)) / dot(normal, d)).clamp(0.0, 1.0);
            if t.is_nan() {
                continue;
            }
            // The point where the edge goes through the plane, against the other triangle's inside and border.
            let x = [add_scaled(*p, t, d); 3];
            best.points_to_face(&x, face, &edges(face), swapped);
            for (s, e) in face.iter().zip(edges(face)) {
                best.point_to_segment(x[0], *s, e, swapped);
            }
        }
    }
    Closest { squared: 0.0, a: best.a, b: best.a }
}
