//! Which triangles meet? Both trees at once, depth first.

use ocb_triangles::meet;
use opencollbench_plugin::Count;

use crate::Pair;
use crate::boxes::{Boxes, overlap};
use crate::faces::{Faces, touching};
use crate::lanes::{Bits, Lanes, Work};
use crate::tree::Link;

/// A query that visits pairs of triangles that meet, until the visitor says false.
pub struct Contacts<'q, C, V> {
    pair: &'q Pair<'q>,
    open: &'q mut Vec<[Link; 2]>,
    work: &'q mut C,
    visit: V,
}

impl<'q, C: Count, V: FnMut(u32, u32) -> bool> Contacts<'q, C, V> {
    pub fn new(pair: &'q Pair<'q>, open: &'q mut Vec<[Link; 2]>, work: &'q mut C, visit: V) -> Self {
        Self { pair, open, work, visit }
    }
}

impl<C: Count, V: FnMut(u32, u32) -> bool> Work for Contacts<'_, C, V> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Pair { a: tree_a, b: tree_b, relative, .. } = self.pair;
        self.open.clear();
        self.open.push([tree_a.root, tree_b.root]);
        while let Some([a, b]) = self.open.pop() {
            let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
            let placed = relative.place::<L>(node_b, b.is_leaf());
            let live = live(a, b);
            if a.is_leaf() && b.is_leaf() {
                let mut left = touching(&Faces::<L>::spread(node_a), &Faces::tile(&placed), relative.slack, live);
                if self.work.is_counting() {
                    each(live, |i, j| self.work.primitive_test(node_a.children[i], node_b.children[j]));
                }
                while left != 0 {
                    let (i, j) = lowest(left);
                    left &= left - 1;
                    if !self.meets(node_a.children[i], node_b.children[j]) {
                        return;
                    }
                }
                continue;
            }
            self.work.bv_tests(u64::from(live.count_ones()));
            let of_a = if a.is_leaf() { Boxes::<L>::of_leaf(node_a) } else { Boxes::spread(node_a) };
            let of_b = if b.is_leaf() { Boxes::<L>::of_leaf(&placed) } else { Boxes::tile(&placed) };
            let last = Link(node_a.children[0]).is_leaf() && Link(node_b.children[0]).is_leaf();
            let (mut left, squares) = overlap(&of_a, &of_b, relative.slack, live);
            let mut square = [0.0; 16];
            squares.store(&mut square);
            while left != 0 {
                // The nearest middles last, so that they come first: where objects overlap, they do so most there. Not
                // worth the while just above the leaves.
                let mut farthest = left.trailing_zeros() as usize;
                let mut others = if last { 0 } else { left & (left - 1) };
                while others != 0 {
                    let lane = others.trailing_zeros() as usize;
                    others &= others - 1;
                    farthest = if square[lane & 15] > square[farthest & 15] { lane } else { farthest };
                }
                left &= !(1 << farthest);
                let (i, j) = (farthest / 4 % 4, farthest % 4);
                let next_a = if a.is_leaf() { a } else { Link(node_a.children[i]) };
                let next_b = if b.is_leaf() { b } else { Link(node_b.children[j]) };
                L::prefetch(tree_a.node(next_a));
                L::prefetch(tree_b.node(next_b));
                self.open.push([next_a, next_b]);
            }
        }
    }
}

impl<C, V: FnMut(u32, u32) -> bool> Contacts<'_, C, V> {
    /// Says whether to go on.
    fn meets(&mut self, a: u32, b: u32) -> bool {
        let Pair { a: tree_a, b: tree_b, frame, .. } = self.pair;
        let (of_a, of_b) = (frame.place_a(&tree_a.triangle(a)), frame.place_b(&tree_b.triangle(b)));
        !meet(&of_a, &of_b) || (self.visit)(a, b)
    }
}

/// The lanes in which there is a pair to test: places of A by places of B; a leaf against an inner node is one place.
#[inline(always)]
pub fn live(a: Link, b: Link) -> Bits {
    let both = a.is_leaf() == b.is_leaf();
    let places = |link: Link| if both || !link.is_leaf() { link.count() } else { 1 };
    let of_a = 0xffff >> (16 - 4 * places(a));
    let of_b = 0x1111 * ((1 << places(b)) - 1);
    of_a & of_b
}

/// The places of A and B in the lowest lane of these.
#[inline(always)]
pub fn lowest(left: Bits) -> (usize, usize) {
    let lane = left.trailing_zeros() as usize;
    (lane / 4 % 4, lane % 4)
}

/// Calls a function for the places of all lanes of these.
#[inline(always)]
pub fn each(mut left: Bits, mut f: impl FnMut(usize, usize)) {
    while left != 0 {
        let (i, j) = lowest(left);
        left &= left - 1;
        f(i, j);
    }
}
