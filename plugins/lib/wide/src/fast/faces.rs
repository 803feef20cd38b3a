//! Sixteen pairs of triangles: four of A against four of B.

use super::tree::{Vectors, row};
use ocb_lanes::{Bits, Lanes, Points, add_scaled, cross, dot, inverse, sub, three};

/// Sixteen triangles.
pub struct Faces<L> {
    corners: [Points<L>; 3],
}

impl<L: Lanes> Faces<L> {
    /// The triangles of a placed leaf of B, each in four lanes side by side.
    #[inline(always)]
    fn spread(leaf: &Points<L>) -> Self {
        Self { corners: three!(k => three!(i => leaf[i].spread_of(k))) }
    }

    /// The triangles of a leaf of A, four times one after the other.
    #[inline(always)]
    fn tile(leaf: &Vectors) -> Self {
        Self { corners: three!(k => three!(i => L::tile(row(leaf, i, k)))) }
    }

    /// Sixteen triangles, by corners and axes.
    #[inline(always)]
    pub fn load(corners: &[[[f32; 16]; 3]; 3]) -> Self {
        Self { corners: three!(k => three!(i => L::load(&corners[k][i]))) }
    }

    /// The edges from the first corner.
    #[inline(always)]
    fn two_edges(&self) -> [Points<L>; 2] {
        let [p, q, r] = &self.corners;
        [sub(q, p), sub(r, p)]
    }

    #[inline(always)]
    fn edges(&self) -> [Points<L>; 3] {
        let [p, q, r] = &self.corners;
        [sub(q, p), sub(r, q), sub(p, r)]
    }

    /// Where the triangles lie along a direction.
    #[inline(always)]
    fn along(&self, direction: &Points<L>) -> (L, L) {
        let [p, q, r] = three!(k => dot(direction, &self.corners[k]));
        (p.min(q).min(r), p.max(q).max(r))
    }
}

/// How far the triangles are apart along a direction, either way round, times the direction's length.
#[inline(always)]
fn gap<L: Lanes>(a: &Faces<L>, b: &Faces<L>, direction: &Points<L>) -> L {
    let ((low_a, high_a), (low_b, high_b)) = (a.along(direction), b.along(direction));
    (low_b - high_a).max(low_a - high_b)
}

#[inline(always)]
fn norm_1<L: Lanes>(v: &Points<L>) -> L {
    v[0].abs() + v[1].abs() + v[2].abs()
}

/// Pairs that may have a point in common: those that neither triangle's plane separates certainly.
#[inline(always)]
pub fn left_by_planes<L: Lanes>(leaf_a: &Vectors, leaf_b: &Points<L>, slack: f32, live: Bits) -> Bits {
    let (a, b) = (Faces::<L>::tile(leaf_a), Faces::spread(leaf_b));
    let (slack, tiny) = (L::splat(slack), L::splat(TINY));
    let ([d, e], [f, g]) = (a.two_edges(), b.two_edges());
    let (normal_a, normal_b) = (cross(&d, &e), cross(&f, &g));
    let of_b = three!(k => dot(&normal_a, &sub(&b.corners[k], &a.corners[0])));
    let of_a = three!(k => dot(&normal_b, &sub(&a.corners[k], &b.corners[0])));
    let bound_a = (norm_1(&d) * slack).mul_add(norm_1(&e), tiny);
    let bound_b = (norm_1(&f) * slack).mul_add(norm_1(&g), tiny);
    let keep = L::unless_above(L::lanes(live), beyond_zero(&of_b), bound_a);
    L::bits(L::unless_above(keep, beyond_zero(&of_a), bound_b))
}

/// Pairs that may have a point in common: those that none of nine directions, each across an edge of either, separates
/// certainly. Along such a direction only the third corners leave the edges' ends.
#[inline(always)]
pub fn left_by_edges<L: Lanes>(a: &Faces<L>, b: &Faces<L>, slack: f32, live: Bits) -> Bits {
    let (zero, slack, tiny) = (L::splat(0.0), L::splat(slack), L::splat(TINY));
    let (edges_a, edges_b) = (a.edges(), b.edges());
    let sizes_a = three!(k => norm_1(&edges_a[k]) * slack);
    let sizes_b = three!(k => norm_1(&edges_b[k]));
    let mut keep = [L::lanes(live); 3];
    for i in 0..3 {
        for j in 0..3 {
            let direction = cross(&edges_a[i], &edges_b[j]);
            let at_b = dot(&direction, &sub(&b.corners[j], &a.corners[i]));
            let third_a = dot(&direction, &edges_a[(i + 1) % 3]);
            let third_b = dot(&direction, &edges_b[(j + 1) % 3]);
            let above = at_b + third_b.min(zero) - third_a.max(zero);
            let below = third_a.min(zero) - at_b - third_b.max(zero);
            keep[j] = L::unless_above(keep[j], above.max(below), sizes_a[i].mul_add(sizes_b[j], tiny));
        }
    }
    L::bits(keep[0]) & L::bits(keep[1]) & L::bits(keep[2])
}

/// How far three numbers are on one side of 0.
#[inline(always)]
fn beyond_zero<L: Lanes>(x: &[L; 3]) -> L {
    x[0].min(x[1]).min(x[2]).max(L::splat(0.0) - x[0].max(x[1]).max(x[2]))
}

/// More than the products of a projection can lose because they are too small for single precision.
const TINY: f32 = 1e-36;

/// Certain bounds of sixteen distances.
pub struct Distances {
    pub least: [f32; 16],
    pub most: [f32; 16],
}

/// Lower bounds of the distances between the triangles of two leaves, along the lines of centroids.
#[inline(always)]
pub fn rough_distance<L: Lanes>(leaf_a: &Vectors, leaf_b: &Points<L>, slack: f32) -> L {
    let (a, b) = (Faces::tile(leaf_a), Faces::spread(leaf_b));
    certain(&a, &b, &sub(&sum(&b), &sum(&a)), slack)
}

#[inline(always)]
fn sum<L: Lanes>(f: &Faces<L>) -> Points<L> {
    three!(i => f.corners[0][i] + f.corners[1][i] + f.corners[2][i])
}

/// A lower bound of the distances along a direction.
#[inline(always)]
fn certain<L: Lanes>(a: &Faces<L>, b: &Faces<L>, direction: &Points<L>, slack: f32) -> L {
    // Short vectors say nothing; their squares might not even be numbers.
    let square = dot(direction, direction).max(L::splat(1e-30));
    let length = (square * L::splat(1.0 + 1e-6)).sqrt();
    let gap = (gap(a, b, direction) - L::splat(TINY)).max(L::splat(0.0));
    (gap * inverse(length)).mul_add(L::splat(SURE), L::splat(-slack))
}

/// Takes off what roots and the reciprocal may be off.
const SURE: f32 = 1.0 - 1.0 / 65_536.0;

/// Bounds of the distances, for triangles that are near each other.
///
/// Whatever rounding does, the points found lie on the triangles, up to the slack: so they are not nearer than the
/// triangles are. And whatever direction they give, it separates by no more than the distance. Neither bound trusts the
/// way by which the points were found.
#[inline(always)]
pub fn distances<L: Lanes>(a: &Faces<L>, b: &Faces<L>, slack: f32) -> Distances {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let floor = L::splat(1e-30);
    let (edges_a, edges_b) = (a.edges(), b.edges());
    let squares_a = three!(k => dot(&edges_a[k], &edges_a[k]).max(floor));
    let squares_b = three!(k => dot(&edges_b[k], &edges_b[k]).max(floor));
    let inverse_a = three!(k => squares_a[k].reciprocal());
    let inverse_b = three!(k => squares_b[k].reciprocal());
    let mut best = Best { gap: sub(&a.corners[0], &b.corners[0]), square: L::splat(f32::MAX) };
    for i in 0..3 {
        for j in 0..3 {
            let (d, e) = (&edges_a[i], &edges_b[j]);
            let r = sub(&a.corners[i], &b.corners[j]);
            let (on_d, on_e, both) = (dot(d, &r), dot(e, &r), dot(d, e));
            let size = squares_a[i] * squares_b[j];
            let across = (size - both * both).max(size * L::splat(1e-6)).max(floor);
            let s = clamp((both * on_e - on_d * squares_b[j]) * across.reciprocal());
            let t = clamp(both.mul_add(s, on_e) * inverse_b[j]);
            let s = clamp((both * t - on_d) * inverse_a[i]);
            let gap = add_scaled(&add_scaled(&r, s, d), zero - t, e);
            best.offer(gap, dot(&gap, &gap));
        }
    }
    for (points, face, edges) in [(a, b, &edges_b), (b, a, &edges_a)] {
        let (d, e) = (&edges[0], &three!(i => zero - edges[2][i]));
        let normal = cross(d, e);
        let inverse = dot(&normal, &normal).max(floor).reciprocal();
        let (across_e, across_d) = (cross(e, &normal), cross(&normal, d));
        for k in 0..3 {
            let v = sub(&points.corners[k], &face.corners[0]);
            let (s, t) = (dot(&v, &across_e) * inverse, dot(&v, &across_d) * inverse);
            let gap = add_scaled(&add_scaled(&v, zero - s, d), zero - t, e);
            let outside = L::either(zero.above(s), L::either(zero.above(t), (s + t).above(one)));
            // Either way round is as good a direction.
            best.offer(gap, L::splat(f32::MAX).or_else(outside, dot(&gap, &gap)));
        }
    }
    let (mut least, mut most) = ([0.0; 16], [0.0; 16]);
    certain(a, b, &best.gap, slack).store(&mut least);
    best.square.sqrt().mul_add(L::splat(1.0 + 1e-6), L::splat(slack)).store(&mut most);
    Distances { least, most }
}

#[inline(always)]
fn clamp<L: Lanes>(x: L) -> L {
    x.max(L::splat(0.0)).min(L::splat(1.0))
}

/// The shortest vectors so far from a point of one triangle to a point of the other, and their squares.
struct Best<L> {
    gap: Points<L>,
    square: L,
}

impl<L: Lanes> Best<L> {
    #[inline(always)]
    fn offer(&mut self, gap: Points<L>, square: L) {
        let better = self.square.above(square);
        self.gap = three!(i => gap[i].or_else(better, self.gap[i]));
        self.square = square.min(self.square);
    }
}
