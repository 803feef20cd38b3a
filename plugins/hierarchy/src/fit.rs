//! Directions of triangles.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add, add_scaled, cross, dot, sub};

/// The coordinate axis along which the triangles' middles vary most.
pub fn widest_axis(triangles: &[Triangle]) -> Vector {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let middle = |t: &Triangle| add(add(t[0], t[1]), t[2]);
    let mut mean = [0.0; 3];
    for t in triangles {
        let middle = middle(t);
        mean = add(mean, middle);
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(middle[k]), high[k].max(middle[k]));
        }
    }
    // In units of the widest range, so that squares are numbers.
    let range = (0..3).map(|k| high[k] - low[k]).fold(f64::MIN_POSITIVE, f64::max);
    let mean = mean.map(|x| x / triangles.len() as f64);
    let mut variance = [0.0; 3];
    for t in triangles {
        let off = sub(middle(t), mean).map(|x| x / range);
        variance = add(variance, off.map(|x| x * x));
    }
    let widest = (0..3).max_by(|&i, &j| variance[i].total_cmp(&variance[j])).unwrap_or(0);
    core::array::from_fn(|k| f64::from(u8::from(k == widest)))
}

/// Orthonormal axes (up to 8 times 2^-53) of the triangles' surface, that of the largest spread first: eigenvectors of its covariance, in which
/// each triangle counts by its area (S. Gottschalk, M. C. Lin, D. Manocha: OBBTree, SIGGRAPH 1996).
pub fn principal_axes(triangles: &[Triangle], radius: f64) -> [Vector; 3] {
    let origin = triangles[0][0];
    let unit = if radius > 0.0 { radius } else { 1.0 };
    let (mut weight, mut first, mut second) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
    for t in triangles {
        let [p, q, r] = t.map(|corner| sub(corner, origin).map(|x| x / unit));
        let (d, e) = (sub(q, p), sub(r, p));
        let normal = cross(d, e);
        // Segments and points have a little weight too, so that they are not forgotten where there is nothing else.
        let area = dot(normal, normal).sqrt() + 1e-9 * (dot(d, d) + dot(e, e)) + 1e-30;
        let sum = add(add(p, q), r);
        weight += area;
        first = add(first, sum.map(|x| area * x / 3.0));
        for i in 0..3 {
            for j in 0..3 {
                second[i][j] += area / 12.0 * (sum[i] * sum[j] + p[i] * p[j] + q[i] * q[j] + r[i] * r[j]);
            }
        }
    }
    let mean = first.map(|x| x / weight);
    eigenvectors(core::array::from_fn(|i| core::array::from_fn(|j| second[i][j] / weight - mean[i] * mean[j])))
}

/// Unit eigenvectors of a symmetric matrix, that of the greatest eigenvalue first (Jacobi 1846).
fn eigenvectors(mut m: [Vector; 3]) -> [Vector; 3] {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Off-diagonal entries shrink faster than by squaring: five rounds are enough for double precision.
    for _ in 0..5 {
        for [p, q] in [[0, 1], [0, 2], [1, 2]] {
            if m[p][q] == 0.0 {
                continue;
            }
            let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            for row in &mut m {
                (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
            }
            let (rp, rq) = (m[p], m[q]);
            m[p] = core::array::from_fn(|k| cosine * rp[k] - sine * rq[k]);
            m[q] = core::array::from_fn(|k| sine * rp[k] + cosine * rq[k]);
            let (vp, vq) = (vectors[p], vectors[q]);
            vectors[p] = core::array::from_fn(|k| cosine * vp[k] - sine * vq[k]);
            vectors[q] = core::array::from_fn(|k| sine * vp[k] + cosine * vq[k]);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| m[j][j].total_cmp(&m[i][i]));
    // Once more perpendicular, for what the rotations have rounded.
    let unit = |v: Vector| v.map(|x| x / dot(v, v).sqrt());
    let x = unit(vectors[order[0]]);
    let y = unit(add_scaled(vectors[order[1]], -dot(vectors[order[1]], x), x));
    [x, y, cross(x, y)]
}
