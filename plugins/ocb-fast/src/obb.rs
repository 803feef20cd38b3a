//! An oriented box around triangles.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, cross, dot, norm_1, sub};

use crate::rounding::ROUNDING;

/// Middle, axes and half sides, as the kernels get them.
///
/// `axes` are orthonormal up to their rounding to single precision. Every corner `x` inside has
/// `|axes[k] . (x - center)| <= half[k]`, exactly; and each half side is larger than that by [`SPARE`] times the sum of all
/// three, which pays for everything in a kernel that is rounded in proportion to the box.
#[derive(Clone, Copy, Debug)]
pub struct Obb {
    pub center: [f32; 3],
    pub axes: [[f32; 3]; 3],
    pub half: [f32; 3],
}

/// See [`crate::rounding`].
pub const SPARE: f64 = 128.0 * ROUNDING;

/// Mutually perpendicular unit vectors, the longest extent first.
pub type Axes = [Vector; 3];

impl Obb {
    /// The box with these axes around some triangles.
    pub fn around(triangles: &[Triangle], ids: &[u32], axes: &Axes) -> Self {
        let axes = axes.map(|axis| axis.map(|x| x as f32));
        let exact = axes.map(|axis| axis.map(f64::from));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &id in ids {
            for corner in &triangles[id as usize] {
                for k in 0..3 {
                    let at = dot(exact[k], *corner);
                    low[k] = if at < low[k] { at } else { low[k] };
                    high[k] = if at > high[k] { at } else { high[k] };
                }
            }
        }
        let mut center = [0.0; 3];
        for k in 0..3 {
            center = add_scaled(center, 0.5 * (low[k] + high[k]), exact[k]);
        }
        let center = center.map(|x| x as f32);
        let side = |k: usize| {
            let middle = dot(exact[k], center.map(f64::from));
            // The products above are rounded in double precision, to less than this.
            (high[k] - middle).max(middle - low[k]) + 16.0 * f64::EPSILON
        };
        let half = [side(0), side(1), side(2)];
        let spare = SPARE * norm_1(half);
        Self { center, axes, half: half.map(|side| ((side + spare) as f32).next_up()) }
    }

    /// What the chance of a meeting with another box grows with.
    pub fn area(&self) -> f32 {
        let [x, y, z] = self.half;
        x * y + y * z + z * x
    }
}

/// Integrals over the surface of a triangle: of 1, of `x_i`, and of `x_i x_j`.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    weight: f64,
    first: Vector,
    second: [f64; 6],
}

const ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [2, 0]];

impl Moments {
    const NONE: Self = Self { weight: 0.0, first: [0.0; 3], second: [0.0; 6] };

    pub fn of(triangle: &Triangle) -> Self {
        let [p, q, r] = *triangle;
        let (d, e) = (sub(q, p), sub(r, p));
        let normal = cross(d, e);
        // Triangles without area have a little weight, so that segments and points are boxed as well as faces.
        let weight = dot(normal, normal).sqrt() + 1e-9 * (dot(d, d) + dot(e, e)) + 1e-30;
        let sum: Vector = core::array::from_fn(|i| p[i] + q[i] + r[i]);
        let moment = |[i, j]: [usize; 2]| weight / 12.0 * (sum[i] * sum[j] + p[i] * p[j] + q[i] * q[j] + r[i] * r[j]);
        Self { weight, first: sum.map(|x| weight / 3.0 * x), second: ENTRIES.map(moment) }
    }

    /// Where the triangle's middle lies along a direction.
    pub fn along(&self, direction: Vector) -> f64 {
        dot(direction, self.first) / self.weight
    }

    fn add(&mut self, other: &Self) {
        self.weight += other.weight;
        for (sum, x) in self.first.iter_mut().zip(other.first) {
            *sum += x;
        }
        for (sum, x) in self.second.iter_mut().zip(other.second) {
            *sum += x;
        }
    }
}

/// Principal axes of the triangles' surface (S. Gottschalk, M. C. Lin, D. Manocha: OBBTree, SIGGRAPH 1996).
pub fn principal_axes(moments: &[Moments], ids: &[u32]) -> Axes {
    let mut all = Moments::NONE;
    for &id in ids {
        all.add(&moments[id as usize]);
    }
    let mean = all.first.map(|x| x / all.weight);
    let mut covariance = [[0.0; 3]; 3];
    for (entry, [i, j]) in all.second.iter().zip(ENTRIES) {
        let value = entry / all.weight - mean[i] * mean[j];
        (covariance[i][j], covariance[j][i]) = (value, value);
    }
    eigenvectors(covariance)
}

/// Along the longest edge of a triangle, and its plane.
pub fn face_axes(triangle: &Triangle) -> Axes {
    let edges = [[0, 1], [1, 2], [2, 0]].map(|[i, j]: [usize; 2]| sub(triangle[j], triangle[i]));
    let longest = edges.iter().copied().max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b))).unwrap_or(edges[0]);
    orthonormal(longest, cross(edges[0], edges[1]))
}

/// Unit vectors along `first`, near `third`, and across both; any when these are 0 or parallel.
fn orthonormal(first: Vector, third: Vector) -> Axes {
    let unit = |v: Vector, other: Vector| {
        let square = dot(v, v);
        let inverse = 1.0 / square.sqrt();
        if square > 1e-280 { v.map(|x| x * inverse) } else { other }
    };
    let first = unit(first, [1.0, 0.0, 0.0]);
    // The coordinate axis most across the first one stands in for a third that says nothing.
    let least = (0..3).min_by(|&i, &j| first[i].abs().total_cmp(&first[j].abs())).unwrap_or(0);
    let mut fallback = [0.0; 3];
    fallback[least] = 1.0;
    let across = |v: Vector| add_scaled(v, -dot(v, first), first);
    let fallback = unit(across(fallback), fallback);
    let projected = across(unit(third, fallback));
    // Twice, since what is left of a nearly parallel one is not perpendicular yet.
    let third = if dot(projected, projected) > 1e-12 { unit(across(projected), fallback) } else { fallback };
    [first, cross(third, first), third]
}

/// Unit eigenvectors of a symmetric matrix, that of the greatest eigenvalue first (Jacobi 1846).
fn eigenvectors(mut m: [[f64; 3]; 3]) -> Axes {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..6 {
        let off = m[0][1] * m[0][1] + m[1][2] * m[1][2] + m[2][0] * m[2][0];
        let on = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
        if off <= 1e-18 * on {
            break;
        }
        for [p, q] in [[0, 1], [0, 2], [1, 2]] {
            if m[p][q] == 0.0 {
                continue;
            }
            let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            let r = 3 - p - q;
            let (pq, pr, qr) = (m[p][q], m[p][r], m[q][r]);
            m[p][p] -= tangent * pq;
            m[q][q] += tangent * pq;
            (m[p][q], m[q][p]) = (0.0, 0.0);
            m[p][r] = cosine * pr - sine * qr;
            m[q][r] = sine * pr + cosine * qr;
            (m[r][p], m[r][q]) = (m[p][r], m[q][r]);
            let (vp, vq) = (vectors[p], vectors[q]);
            vectors[p] = core::array::from_fn(|i| cosine * vp[i] - sine * vq[i]);
            vectors[q] = core::array::from_fn(|i| sine * vp[i] + cosine * vq[i]);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| m[j][j].total_cmp(&m[i][i]));
    orthonormal(vectors[order[0]], vectors[order[2]])
}
