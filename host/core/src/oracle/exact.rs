//! The two questions about a pair of triangles, answered in exact integer arithmetic.
//!
//! Every coordinate of a configuration is a sum of products of f64 numbers, so it is an integer multiple of some power
//! of two. [`ExactPair`] puts both triangles on one such grid; from there every decision is the sign of a polynomial in
//! integers and nothing is ever rounded. It costs microseconds, so the filters ask it only when they cannot decide.

use dashu_int::IBig;
use nalgebra::Point3;

use super::exact_vector::{Vector, cross, dot, is_zero, norm2, sub};
use super::rational::Ratio;
use crate::pose::Pose;

/// Two triangles on a common integer grid.
pub(crate) struct ExactPair {
    pub(super) a: [Vector; 3],
    pub(super) b: [Vector; 3],
    /// Grid spacing is two to this power.
    pub(super) exponent: i32,
}

/// A number `mantissa * 2^exponent`.
type Term = (i128, i32);

/// Splits a finite f64; zero has mantissa 0.
fn split(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) = match (bits >> 52) & 0x7ff {
        0 => (fraction, -1074),
        e => (fraction | (1 << 52), e as i32 - 1075),
    };
    if x < 0.0 { (-mantissa, exponent) } else { (mantissa, exponent) }
}

fn product(x: f64, y: f64) -> Term {
    let ((mx, ex), (my, ey)) = (split(x), split(y));
    (i128::from(mx) * i128::from(my), ex + ey)
}

/// The mapped vertex: per coordinate the four terms whose sum it is.
fn terms(pose: &Pose, p: &Point3<f64>) -> [[Term; 4]; 3] {
    std::array::from_fn(|row| {
        let t = split(pose.translation[row]);
        [
            product(pose.linear[(row, 0)], p.x),
            product(pose.linear[(row, 1)], p.y),
            product(pose.linear[(row, 2)], p.z),
            (i128::from(t.0), t.1),
        ]
    })
}

impl ExactPair {
    /// The two triangles where the poses put them, without any rounding.
    pub(crate) fn new(pose_a: &Pose, a: &[Point3<f64>; 3], pose_b: &Pose, b: &[Point3<f64>; 3]) -> Self {
        let raw: [[[Term; 4]; 3]; 6] =
            std::array::from_fn(|i| if i < 3 { terms(pose_a, &a[i]) } else { terms(pose_b, &b[i - 3]) });
        let exponent = raw.iter().flatten().flatten().filter(|t| t.0 != 0).map(|t| t.1).min().unwrap_or(0);
        let place = |vertex: &[[Term; 4]; 3]| {
            vertex.each_ref().map(|coordinate| {
                let mut sum = IBig::ZERO;
                for &(mantissa, e) in coordinate.iter().filter(|t| t.0 != 0) {
                    sum += IBig::from(mantissa) << (e - exponent) as usize;
                }
                sum
            })
        };
        let points = raw.each_ref().map(place);
        let [a0, a1, a2, b0, b1, b2] = points;
        Self { a: [a0, a1, a2], b: [b0, b1, b2], exponent }
    }

    /// Do the closed triangles share a point?
    ///
    /// Two triangles that meet always share a point that lies on an edge of one of them; six segment tests see it.
    pub(crate) fn hit(&self) -> bool {
        let edges = [(0, 1), (1, 2), (2, 0)];
        edges.iter().any(|&(i, j)| segment_meets_triangle(&self.a[i], &self.a[j], &self.b))
            || edges.iter().any(|&(i, j)| segment_meets_triangle(&self.b[i], &self.b[j], &self.a))
    }

    /// The distance as the tightest f64 interval `[lo, hi]`: `lo == hi` when it is an f64 number, else neighbours.
    pub(crate) fn distance(&self) -> (f64, f64) {
        if self.hit() { (0.0, 0.0) } else { self.squared_distance().sqrt(self.exponent) }
    }

    /// Squared distance in grid units; only for triangles that do not meet.
    fn squared_distance(&self) -> Ratio {
        let mut best: Option<Ratio> = None;
        let mut offer = |candidate: Ratio| {
            if best.as_ref().is_none_or(|b| candidate.less_than(b)) {
                best = Some(candidate);
            }
        };
        for (triangle, points) in [(&self.a, &self.b), (&self.b, &self.a)] {
            for p in points {
                if let Some(d) = point_to_plane_inside(p, triangle) {
                    offer(d);
                }
                for i in 0..3 {
                    offer(point_to_segment(p, &triangle[i], &triangle[(i + 1) % 3]));
                }
            }
        }
        for i in 0..3 {
            for j in 0..3 {
                let (p, q) = (&self.a[i], &self.a[(i + 1) % 3]);
                if let Some(d) = between_lines_inside(p, q, &self.b[j], &self.b[(j + 1) % 3]) {
                    offer(d);
                }
            }
        }
        best.expect("eighteen vertex-edge distances were offered")
    }
}

pub(super) fn signum(x: &IBig) -> i32 {
    match x.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

fn segment_meets_triangle(p: &Vector, q: &Vector, [a, b, c]: &[Vector; 3]) -> bool {
    let normal = cross(&sub(b, a), &sub(c, a));
    if is_zero(&normal) {
        // A triangle without area is the union of its edges.
        return [(a, b), (b, c), (c, a)].iter().any(|(s, t)| segments_meet(p, q, s, t));
    }
    let side_p = signum(&dot(&normal, &sub(p, a)));
    let side_q = signum(&dot(&normal, &sub(q, a)));
    if side_p * side_q > 0 {
        return false;
    }
    if side_p == 0 && side_q == 0 {
        return in_coplanar_triangle(p, &normal, [a, b, c])
            || [(a, b), (b, c), (c, a)].iter().any(|(s, t)| segments_meet(p, q, s, t));
    }
    // p and q lie on different sides: the line meets the triangle iff it passes all three edges on the same side.
    let d = sub(q, p);
    let (ap, bp, cp) = (sub(a, p), sub(b, p), sub(c, p));
    let s = [dot(&d, &cross(&ap, &bp)), dot(&d, &cross(&bp, &cp)), dot(&d, &cross(&cp, &ap))].map(|x| signum(&x));
    s.iter().all(|&x| x >= 0) || s.iter().all(|&x| x <= 0)
}

fn in_coplanar_triangle(p: &Vector, normal: &Vector, [a, b, c]: [&Vector; 3]) -> bool {
    [(a, b), (b, c), (c, a)].iter().all(|(s, t)| signum(&dot(normal, &cross(&sub(t, s), &sub(p, s)))) >= 0)
}

fn segments_meet(p1: &Vector, q1: &Vector, p2: &Vector, q2: &Vector) -> bool {
    let (d1, d2, r) = (sub(q1, p1), sub(q2, p2), sub(p2, p1));
    let normal = cross(&d1, &d2);
    if !is_zero(&normal) {
        if signum(&dot(&normal, &r)) != 0 {
            return false;
        }
        let denominator = norm2(&normal);
        let s = dot(&cross(&r, &d2), &normal);
        let t = dot(&cross(&r, &d1), &normal);
        return [s, t].iter().all(|x| *x >= IBig::ZERO && *x <= denominator);
    }
    // Parallel or without length: they meet iff an end point of one lies on the other.
    on_segment(p1, p2, q2) || on_segment(q1, p2, q2) || on_segment(p2, p1, q1) || on_segment(q2, p1, q1)
}

fn on_segment(x: &Vector, p: &Vector, q: &Vector) -> bool {
    let (d, r) = (sub(q, p), sub(x, p));
    if is_zero(&d) {
        return is_zero(&r);
    }
    let along = dot(&r, &d);
    is_zero(&cross(&r, &d)) && along >= IBig::ZERO && along <= norm2(&d)
}

/// Squared distance of a point to a triangle's plane, if its foot lies in the triangle.
fn point_to_plane_inside(p: &Vector, [a, b, c]: &[Vector; 3]) -> Option<Ratio> {
    let normal = cross(&sub(b, a), &sub(c, a));
    if is_zero(&normal) || !in_coplanar_triangle(p, &normal, [a, b, c]) {
        return None; // `in_coplanar_triangle` reads only the component in the plane, so it tests the foot
    }
    let height = dot(&normal, &sub(p, a));
    Some(Ratio::new(&height * &height, norm2(&normal)))
}

fn point_to_segment(x: &Vector, p: &Vector, q: &Vector) -> Ratio {
    let (d, r) = (sub(q, p), sub(x, p));
    let (along, length2) = (dot(&r, &d), norm2(&d));
    if along <= IBig::ZERO {
        Ratio::new(norm2(&r), IBig::ONE)
    } else if along >= length2 {
        Ratio::new(norm2(&sub(x, q)), IBig::ONE)
    } else {
        Ratio::new(norm2(&cross(&r, &d)), length2)
    }
}

/// Squared distance of two lines, if both feet lie inside the segments.
fn between_lines_inside(p1: &Vector, q1: &Vector, p2: &Vector, q2: &Vector) -> Option<Ratio> {
    let (d1, d2, r) = (sub(q1, p1), sub(q2, p2), sub(p2, p1));
    let normal = cross(&d1, &d2);
    if is_zero(&normal) {
        return None;
    }
    let denominator = norm2(&normal);
    let s = dot(&cross(&r, &d2), &normal);
    let t = dot(&cross(&r, &d1), &normal);
    if [s, t].iter().any(|x| *x < IBig::ZERO || *x > denominator) {
        return None;
    }
    let height = dot(&normal, &r);
    Some(Ratio::new(&height * &height, denominator))
}
