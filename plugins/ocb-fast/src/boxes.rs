//! Sixteen pairs of oriented boxes: do they overlap, how far apart are they?

use crate::lanes::{Bits, Lanes, Points, dot, inverse, sub, three};
use crate::tree::Node;

/// Sixteen boxes.
#[derive(Clone, Copy)]
pub struct Boxes<L> {
    center: Points<L>,
    axes: [Points<L>; 3],
    half: Points<L>,
}

impl<L: Lanes> Boxes<L> {
    /// The children of an inner node, each in four lanes side by side.
    #[inline(always)]
    pub fn spread(node: &Node) -> Self {
        Self {
            center: three!(i => L::spread(node.row(i, 0))),
            axes: three!(k => three!(i => L::spread(node.row(i, k + 1)))),
            half: three!(k => L::spread(&node.half[k])),
        }
    }

    /// The children of an inner node, four times one after the other.
    #[inline(always)]
    pub fn tile(node: &Node) -> Self {
        Self {
            center: three!(i => L::tile(node.row(i, 0))),
            axes: three!(k => three!(i => L::tile(node.row(i, k + 1)))),
            half: three!(k => L::tile(&node.half[k])),
        }
    }

    /// The box of a leaf, in all lanes.
    #[inline(always)]
    pub fn of_leaf(node: &Node) -> Self {
        Self {
            center: three!(i => L::splat(node.vectors[i][12])),
            axes: three!(k => three!(i => L::splat(node.vectors[i][13 + k]))),
            half: three!(k => L::splat(node.half[0][k])),
        }
    }
}

/// Where a box of A and a box of B may have a point in common: the separating axis test (S. Gottschalk, M. C. Lin,
/// D. Manocha: OBBTree, SIGGRAPH 1996). B's boxes have been enlarged by `slack`. Also the squared distances of the middles.
#[inline(always)]
pub fn overlap<L: Lanes>(a: &Boxes<L>, b: &Boxes<L>, slack: f32, live: Bits) -> (Bits, L) {
    let between = sub(&b.center, &a.center);
    let along_a = three!(k => dot(&a.axes[k], &between));
    let turn = three!(k => three!(j => dot(&a.axes[k], &b.axes[j])));
    let reach = three!(k => three!(j => turn[k][j].abs()));
    let all = L::lanes(live);
    let square = dot(&between, &between);
    // Three short chains of comparisons, since each waits for the one before.
    let mut keep = three!(k => L::unless_above(all, along_a[k].abs(), dot(&reach[k], &b.half) + a.half[k]));
    for j in 0..3 {
        let radius_a = dot(&[reach[0][j], reach[1][j], reach[2][j]], &a.half);
        keep[j] = L::unless_above(keep[j], dot(&b.axes[j], &between).abs(), radius_a + b.half[j]);
    }
    let left = L::bits(keep[0]) & L::bits(keep[1]) & L::bits(keep[2]);
    if left == 0 {
        return (left, square);
    }
    let sides = a.half[0] + a.half[1] + a.half[2] + b.half[0] + b.half[1] + b.half[2];
    let spare = sides.mul_add(L::splat(SPARE), L::splat(slack));
    for k in 0..3 {
        let (k1, k2) = ((k + 1) % 3, (k + 2) % 3);
        for j in 0..3 {
            let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
            let gap = along_a[k2] * turn[k1][j] - along_a[k1] * turn[k2][j];
            let radius = a.half[k1].mul_add(reach[k2][j], a.half[k2].mul_add(reach[k1][j], spare));
            let radius = b.half[j1].mul_add(reach[k][j2], b.half[j2].mul_add(reach[k][j1], radius));
            keep[j] = L::unless_above(keep[j], gap.abs(), radius);
        }
    }
    (L::bits(keep[0]) & L::bits(keep[1]) & L::bits(keep[2]), square)
}

/// 256 roundings: what the nine products of edges may be off, relative to the boxes.
const SPARE: f32 = 1.0 / 65_536.0;

/// Lower bounds of the squared distances of the boxes. B's boxes have been enlarged by the slack.
#[inline(always)]
pub fn squared_distance<L: Lanes>(a: &Boxes<L>, b: &Boxes<L>) -> L {
    let zero = L::splat(0.0);
    let between = sub(&b.center, &a.center);
    let along_a = three!(k => dot(&a.axes[k], &between).abs());
    let along_b = three!(k => dot(&b.axes[k], &between).abs());
    let reach = three!(k => three!(j => dot(&a.axes[k], &b.axes[j]).abs()));
    let (mut seen_from_a, mut seen_from_b) = (zero, zero);
    for k in 0..3 {
        let gap = (along_a[k] - (dot(&reach[k], &b.half) + a.half[k])).max(zero);
        seen_from_a = gap.mul_add(gap, seen_from_a);
        let radius_a = dot(&[reach[0][k], reach[1][k], reach[2][k]], &a.half);
        let gap = (along_b[k] - (radius_a + b.half[k])).max(zero);
        seen_from_b = gap.mul_add(gap, seen_from_b);
    }
    // Along the line of middles, which separates best where boxes are small against their distance.
    let square = dot(&between, &between);
    let gap = (square - dot(&along_a, &a.half) - dot(&along_b, &b.half)).max(zero);
    let along_line = gap * gap * inverse(square.max(L::splat(1e-30)));
    seen_from_a.max(seen_from_b).max(along_line) * L::splat(SURE)
}

/// Takes off what squares and the reciprocal may be off.
const SURE: f32 = 1.0 - 1.0 / 65_536.0;
