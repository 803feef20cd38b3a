//! Do two triangles meet? Decided in f64 with certified error bounds, or not at all.
//!
//! Fifteen orientation determinants say everything: each vertex against the other's plane (six), and each edge against
//! each edge of the other (nine). Every determinant carries a bound of its error that includes the error of the mapped
//! vertices; a sign is used only when the value exceeds it.

use nalgebra::Vector3;

use super::triangle::Triangle;

/// Unit roundoff of f64.
const U: f64 = f64::EPSILON / 2.0;

/// The signs of all orientations of a pair of triangles.
struct Signs {
    /// Vertex i of A against the plane of B; 0 when not certain.
    a_of_b: [i8; 3],
    /// Vertex j of B against the plane of A.
    b_of_a: [i8; 3],
    /// Edge i of A against edge j of B.
    edges: [[i8; 3]; 3],
}

/// `Some(meets)` when certain.
pub(crate) fn hit(a: &Triangle, b: &Triangle) -> Option<bool> {
    let signs = signs(a, b);
    if one_side(&signs.a_of_b) || one_side(&signs.b_of_a) {
        return Some(false);
    }
    let mut all_apart = true;
    for i in 0..3 {
        let across_a = [signs.edges[i][0], signs.edges[i][1], signs.edges[i][2]];
        match crosses(signs.a_of_b[i], signs.a_of_b[(i + 1) % 3], &across_a) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => all_apart = false,
        }
        let across_b = [signs.edges[0][i], signs.edges[1][i], signs.edges[2][i]];
        match crosses(signs.b_of_a[i], signs.b_of_a[(i + 1) % 3], &across_b) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => all_apart = false,
        }
    }
    // Triangles that meet share a point of an edge of one of them.
    if all_apart { Some(false) } else { None }
}

fn one_side(signs: &[i8; 3]) -> bool {
    *signs == [1; 3] || *signs == [-1; 3]
}

/// Does a segment, whose ends lie on the given sides of a plane, pass the triangle's edges all on the same side?
fn crosses(start: i8, end: i8, across: &[i8; 3]) -> Option<bool> {
    // Both ends strictly on one side; or passing one edge on the left and another on the right, which no line through
    // the closed triangle does.
    if start * end > 0 || (across.contains(&1) && across.contains(&-1)) {
        return Some(false);
    }
    // Certain crossing: strictly opposite ends, strictly the same side of all edges.
    if start * end < 0 && !across.contains(&0) { Some(true) } else { None }
}

fn signs(a: &Triangle, b: &Triangle) -> Signs {
    let error = a.error + b.error;
    let (va, vb) = (&a.vertices, &b.vertices);
    let next = |i: usize| (i + 1) % 3;
    Signs {
        a_of_b: std::array::from_fn(|i| sign(&vb[0], &vb[1], &vb[2], &va[i], error)),
        b_of_a: std::array::from_fn(|j| sign(&va[0], &va[1], &va[2], &vb[j], error)),
        edges: std::array::from_fn(|i| {
            std::array::from_fn(|j| sign(&va[i], &va[next(i)], &vb[j], &vb[next(j)], error))
        }),
    }
}

/// Sign of the determinant of three differences, 0 when it is not certain; `error` bounds the sum of both triangles' errors.
fn sign(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>, s: &Vector3<f64>, error: f64) -> i8 {
    let (value, bound) = orientation(p, q, r, s, error);
    // NaN and infinity compare false.
    if value > bound {
        1
    } else if value < -bound {
        -1
    } else {
        0
    }
}

/// `det(p - s, q - s, r - s)` and a bound of its error.
pub(super) fn orientation(
    p: &Vector3<f64>,
    q: &Vector3<f64>,
    r: &Vector3<f64>,
    s: &Vector3<f64>,
    error: f64,
) -> (f64, f64) {
    let (x, y, z) = (p - s, q - s, r - s);
    let term = |i: usize, j: usize, k: usize| {
        let (m1, m2) = (y[j] * z[k], y[k] * z[j]);
        (x[i] * (m1 - m2), x[i].abs() * (m1.abs() + m2.abs()))
    };
    let (t0, t1, t2) = (term(0, 1, 2), term(1, 2, 0), term(2, 0, 1));
    let value = t0.0 + t1.0 + t2.0;
    // Rounding: three differences, two products, one difference and two sums: at most nine roundings on every path.
    let permanent = t0.1 + t1.1 + t2.1;
    // Both points of a difference may belong to one triangle, hence twice the sum of both errors.
    let e = 2.0 * error;
    let (ex, ey, ez) = (x.amax() + e, y.amax() + e, z.amax() + e);
    // Six products of three; each loses at most e times the product of the two other factors, thrice.
    let moved = 6.0 * e * (ey * ez + ex * ez + ex * ey);
    (value, 12.0 * U * permanent + 1.01 * moved + f64::MIN_POSITIVE)
}

/// Does the segment cross the triangle? `None` when that is not certain. `error` is the error of the segment's ends.
pub(super) fn certain_crossing(p: &Vector3<f64>, q: &Vector3<f64>, error: f64, face: &Triangle) -> Option<bool> {
    let [a, b, c] = &face.vertices;
    let error = error + face.error;
    let across = [sign(p, q, a, b, error), sign(p, q, b, c, error), sign(p, q, c, a, error)];
    crosses(sign(a, b, c, p, error), sign(a, b, c, q, error), &across)
}
