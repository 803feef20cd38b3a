//! Do two triangles meet?

use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::Triangle;
use crate::vector::{Vector, cross, dot, norm_1, sub};

/// Whether two closed triangles have a point in common, exactly for the given coordinates.
///
/// Two closed triangles meet if and only if an edge of one meets the other; that also holds for coplanar triangles, one
/// inside the other included. Triangles without area are segments or points and are treated as such.
#[inline]
pub fn meet(a: &Triangle, b: &Triangle) -> bool {
    !apart_by_plane(a, b) && !apart_by_plane(b, a) && meet_exact(a, b)
}

/// Whether all corners of `b` certainly lie on one side of `a`'s plane, or of any plane that rounding makes of it.
#[inline]
fn apart_by_plane(a: &Triangle, b: &Triangle) -> bool {
    let (e, f) = (sub(a[1], a[0]), sub(a[2], a[0]));
    let normal = cross(e, f);
    let side = b.map(|corner| {
        let to_corner = sub(corner, a[0]);
        let size = norm_1(e) * norm_1(f) * norm_1(to_corner);
        let height = dot(normal, to_corner);
        if height > ERROR * size {
            1
        } else if height < -ERROR * size {
            -1
        } else {
            0
        }
    });
    side[0] != 0 && side[0] == side[1] && side[0] == side[2]
}

/// Bound of the rounding error of the height of a point over a triangle's plane, times the triangle's normal, relative to
/// the product of the sizes of its three factors: 64 roundings. Generous, since what is not rejected by it is decided
/// exactly.
pub(crate) const ERROR: f64 = 64.0 * f64::EPSILON;

#[cold]
#[inline(never)]
fn meet_exact(a: &Triangle, b: &Triangle) -> bool {
    match (segment_of_degenerate(a), segment_of_degenerate(b)) {
        (None, None) => {
            let (side_of_b, side_of_a) = (a.map(|p| side(b, p)), b.map(|p| side(a, p)));
            EDGES.iter().any(|&[i, j]| {
                edge_meets([a[i], a[j]], [side_of_b[i], side_of_b[j]], b)
                    || edge_meets([b[i], b[j]], [side_of_a[i], side_of_a[j]], a)
            })
        }
        (Some(segment), None) => edge_meets(segment, segment.map(|p| side(b, p)), b),
        (None, Some(segment)) => edge_meets(segment, segment.map(|p| side(a, p)), a),
        (Some(s), Some(t)) => {
            volume(s[0], s[1], t[0], t[1]) == 0
                && PROJECTIONS
                    .iter()
                    .all(|&axes| segments_meet_2d(s.map(|p| project(p, axes)), t.map(|p| project(p, axes))))
        }
    }
}

const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Axis pairs to project onto. Dropping a coordinate is exact. Of two sets in one plane, all three projections meet if
/// and only if the sets do: meeting is necessary in each, and sufficient in any that keeps the plane a plane.
const PROJECTIONS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// A closed segment against a closed triangle with area; `sides` are those of the segment's ends to the triangle.
fn edge_meets([p, q]: [Vector; 2], sides: [i8; 2], t: &Triangle) -> bool {
    match sides {
        [1, 1] | [-1, -1] => false,
        [0, 0] => PROJECTIONS
            .iter()
            .all(|&axes| segment_meets_triangle_2d([p, q].map(|p| project(p, axes)), t.map(|p| project(p, axes)))),
        // The line through p and q meets the plane in one point of the segment; is it in the triangle?
        _ => {
            let turns = EDGES.map(|[i, j]| volume(p, q, t[i], t[j]));
            turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0)
        }
    }
}

fn segment_meets_triangle_2d(segment: [Coord<f64>; 2], t: [Coord<f64>; 3]) -> bool {
    let inside = || {
        let turns = EDGES.map(|[i, j]| turn(t[i], t[j], segment[0]));
        // A projection that makes the triangle a segment has no inside; its edges say all.
        turn(t[0], t[1], t[2]) != 0 && (turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0))
    };
    EDGES.iter().any(|&[i, j]| segments_meet_2d(segment, [t[i], t[j]])) || inside()
}

fn segments_meet_2d([p, q]: [Coord<f64>; 2], [a, b]: [Coord<f64>; 2]) -> bool {
    let (p_of_ab, q_of_ab) = (turn(a, b, p), turn(a, b, q));
    let (a_of_pq, b_of_pq) = (turn(p, q, a), turn(p, q, b));
    (p_of_ab * q_of_ab < 0 && a_of_pq * b_of_pq < 0)
        || (p_of_ab == 0 && in_box(a, b, p))
        || (q_of_ab == 0 && in_box(a, b, q))
        || (a_of_pq == 0 && in_box(p, q, a))
        || (b_of_pq == 0 && in_box(p, q, b))
}

fn in_box(a: Coord<f64>, b: Coord<f64>, p: Coord<f64>) -> bool {
    a.x.min(b.x) <= p.x && p.x <= a.x.max(b.x) && a.y.min(b.y) <= p.y && p.y <= a.y.max(b.y)
}

/// A triangle without area as the segment that it is (a point twice, if need be).
fn segment_of_degenerate(t: &Triangle) -> Option<[Vector; 2]> {
    let flat = |axes| {
        let [a, b, c] = t.map(|p| project(p, axes));
        turn(a, b, c) == 0
    };
    if !PROJECTIONS.iter().all(|&axes| flat(axes)) {
        return None;
    }
    // On a line, the extreme corners are the extreme ones in every coordinate in which they differ at all.
    let least = |p: &Vector, q: &Vector| p.partial_cmp(q).unwrap_or(core::cmp::Ordering::Equal);
    Some([*t.iter().min_by(|p, q| least(p, q))?, *t.iter().max_by(|p, q| least(p, q))?])
}

fn side(t: &Triangle, p: Vector) -> i8 {
    volume(t[0], t[1], t[2], p)
}

/// Sign of the volume of a tetrahedron.
fn volume(a: Vector, b: Vector, c: Vector, d: Vector) -> i8 {
    let coord = |p: Vector| Coord3D { x: p[0], y: p[1], z: p[2] };
    sign(orient3d(coord(a), coord(b), coord(c), coord(d)))
}

/// Sign of the area of a triangle in the plane.
fn turn(a: Coord<f64>, b: Coord<f64>, c: Coord<f64>) -> i8 {
    sign(orient2d(a, b, c))
}

fn project(p: Vector, [x, y]: [usize; 2]) -> Coord<f64> {
    Coord { x: p[x], y: p[y] }
}

fn sign(x: f64) -> i8 {
    if x > 0.0 {
        1
    } else if x < 0.0 {
        -1
    } else {
        0
    }
}
