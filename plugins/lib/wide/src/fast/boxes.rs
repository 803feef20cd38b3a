//! Sixteen pairs of oriented boxes: do they overlap, how far apart are they?

use ocb_lanes::{Bits, Lanes, Numbers, Points, dot, inverse, sub, three};

use super::relative::{Relative, stored};
use super::tree::{Node, row};

/// As many boxes as there are lanes.
#[derive(Clone, Copy)]
pub struct Boxes<L> {
    pub center: Points<L>,
    pub axes: [Points<L>; 3],
    pub half: Points<L>,
}

impl<L: Lanes> Boxes<L> {
    /// The children of an inner node of A, four times one after the other.
    #[inline(always)]
    pub fn tile(node: &Node) -> Self {
        Self {
            center: three!(i => L::tile(row(&node.vectors, i, 0))),
            axes: three!(k => three!(i => L::tile(row(&node.vectors, i, k + 1)))),
            half: three!(k => L::tile(&node.half[k])),
        }
    }

    /// The children of an inner node of B, seen from A, each in four lanes side by side: from register to register.
    #[inline(always)]
    pub fn spread(node: &Node, relative: &Relative) -> Self {
        let placed = relative.place::<L>(node, false);
        Self {
            center: three!(i => placed[i].spread_of(0)),
            axes: three!(k => three!(i => placed[i].spread_of(k + 1))),
            half: three!(k => relative.enlarge(L::spread(&node.half[k]))),
        }
    }

    /// The box of a leaf of A, in all lanes.
    #[inline(always)]
    pub fn of_leaf(node: &Node) -> Self {
        Self {
            center: three!(i => L::splat(node.vectors[i][12])),
            axes: three!(k => three!(i => L::splat(node.vectors[i][13 + k]))),
            half: three!(k => L::splat(node.half[0][k])),
        }
    }

    /// The box of a leaf of B, seen from A, in all lanes.
    #[inline(always)]
    pub fn of_placed_leaf(node: &Node, relative: &Relative) -> Self {
        let placed = stored(&relative.place::<L>(node, true));
        Self {
            center: three!(i => L::splat(placed[i][12])),
            axes: three!(k => three!(i => L::splat(placed[i][13 + k]))),
            half: three!(k => relative.enlarge(L::splat(node.half[0][k]))),
        }
    }
}

/// Calls a kernel with the boxes of two nodes of which one at most is a leaf, such that each pair of them has its lane. Three
/// calls, so that the boxes stay in registers.
macro_rules! against {
    ($kernel:ident, $pair:expr, $node_a:expr, $node_b:expr, $relative:expr $(, $more:expr)*) => {
        match $pair {
            [a, _] if a.is_leaf() => {
                $kernel(&Boxes::<L>::of_leaf($node_a), &Boxes::spread($node_b, $relative) $(, $more)*)
            }
            [_, b] if b.is_leaf() => {
                $kernel(&Boxes::<L>::tile($node_a), &Boxes::of_placed_leaf($node_b, $relative) $(, $more)*)
            }
            _ => $kernel(&Boxes::<L>::tile($node_a), &Boxes::spread($node_b, $relative) $(, $more)*),
        }
    };
}
pub(crate) use against;

/// Where a box of A and a box of B may have a point in common: no axis of either separates them. Also the lane in
/// which the middles are nearest, whether these boxes overlap or not: that does not wait for the tests. B's boxes have been enlarged by the slack.
///
/// The nine products of axes would cost more than the few pairs that they alone tell apart.
#[inline(always)]
pub fn overlap<L: Lanes>(a: &Boxes<L>, b: &Boxes<L>, live: Bits) -> (Bits, usize) {
    let between = sub(&b.center, &a.center);
    let nearest = dot(&between, &between).least(live);
    (not_separated(a, b, &between, live), nearest)
}

/// The lanes in which no axis of either box separates them; `between` leads from A's middles to B's.
#[inline(always)]
pub fn not_separated<L: Numbers>(a: &Boxes<L>, b: &Boxes<L>, between: &Points<L>, live: Bits) -> Bits {
    let reach = three!(k => three!(j => dot(&a.axes[k], &b.axes[j]).abs()));
    // Three short chains of comparisons, since each waits for the one before.
    let mut keep = [L::lanes(live); 3];
    for k in 0..3 {
        let radius_b = dot(&reach[k], &b.half);
        keep[k] = L::unless_above(keep[k], dot(&a.axes[k], between).abs(), radius_b + a.half[k]);
    }
    for j in 0..3 {
        let radius_a = dot(&[reach[0][j], reach[1][j], reach[2][j]], &a.half);
        keep[j] = L::unless_above(keep[j], dot(&b.axes[j], between).abs(), radius_a + b.half[j]);
    }
    L::bits(keep[0]) & L::bits(keep[1]) & L::bits(keep[2])
}

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
pub const SURE: f32 = 1.0 - 1.0 / 65_536.0;
