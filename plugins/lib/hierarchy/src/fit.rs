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

/// Orthonormal up to 8 times 2^-53, the longest extent first.
pub type Axes = [Vector; 3];

/// Axes of the triangles' surface (see [`Moments::axes`]); `radius` is the length of the object's longest corner.
pub fn principal_axes(triangles: &[Triangle], radius: f64) -> Axes {
    let origin = triangles[0][0];
    let unit = if radius > 0.0 { radius } else { 1.0 };
    let mut all = Moments::NONE;
    for t in triangles {
        all.add(&Moments::of(&t.map(|corner| sub(corner, origin).map(|x| x / unit))));
    }
    all.axes()
}

/// Integrals over the surface of triangles: of 1, of `x_i`, and of `x_i x_j`.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    weight: f64,
    first: Vector,
    second: [f64; 6],
}

const ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [2, 0]];

impl Moments {
    /// Of no triangle.
    pub const NONE: Self = Self { weight: 0.0, first: [0.0; 3], second: [0.0; 6] };

    /// Of a triangle in [-1, 1], or a few times that.
    pub fn of(triangle: &Triangle) -> Self {
        let [p, q, r] = *triangle;
        let (d, e) = (sub(q, p), sub(r, p));
        let normal = cross(d, e);
        // Segments and points have a little weight too, so that they are not forgotten where there is nothing else.
        let weight = dot(normal, normal).sqrt() + 1e-9 * (dot(d, d) + dot(e, e)) + 1e-30;
        let sum = add(add(p, q), r);
        let moment = |[i, j]: [usize; 2]| weight / 12.0 * (sum[i] * sum[j] + p[i] * p[j] + q[i] * q[j] + r[i] * r[j]);
        Self { weight, first: sum.map(|x| weight / 3.0 * x), second: ENTRIES.map(moment) }
    }

    /// Where the middle lies along a direction.
    pub fn along(&self, direction: Vector) -> f64 {
        dot(direction, self.first) / self.weight
    }

    /// More triangles.
    pub fn add(&mut self, other: &Self) {
        self.weight += other.weight;
        self.first = add(self.first, other.first);
        for (sum, x) in self.second.iter_mut().zip(other.second) {
            *sum += x;
        }
    }

    /// Eigenvectors of the covariance, in which each triangle counts by its area (S. Gottschalk, M. C. Lin, D. Manocha:
    /// OBBTree, SIGGRAPH 1996).
    pub fn axes(&self) -> Axes {
        let mean = self.first.map(|x| x / self.weight);
        let mut covariance = [[0.0; 3]; 3];
        for (entry, [i, j]) in self.second.iter().zip(ENTRIES) {
            let value = entry / self.weight - mean[i] * mean[j];
            (covariance[i][j], covariance[j][i]) = (value, value);
        }
        eigenvectors(covariance)
    }
}

/// Unit eigenvectors of a symmetric matrix, that of the greatest eigenvalue first (Jacobi 1846).
fn eigenvectors(mut m: [Vector; 3]) -> Axes {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Off-diagonal entries shrink faster than by squaring; a hundred thousandth of the widest is a good axis.
    for _ in 0..6 {
        let off = m[0][1] * m[0][1] + m[1][2] * m[1][2] + m[2][0] * m[2][0];
        let on = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
        if off <= 1e-10 * on {
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
