//! Which triangles meet? Both trees at once, depth first.

use ocb_lanes::{Bits, Lanes, Work};
use ocb_triangles::meet;
use opencollbench_plugin::Count;

use super::boxes::{Boxes, against, overlap};
use super::faces::{left_by_edges, left_by_planes};
use super::relative::stored;
use super::stack::Stack;
use super::tree::{Link, Node, Tree};
use super::waiting::Waiting;
use super::{Placed, narrow};
use crate::Pair;

/// What is still to be done, kept from query to query for its memory.
#[derive(Debug, Default)]
pub struct Open {
    /// Pairs of nodes of which one at least is an inner node, and pairs of leaves.
    pairs: [Stack; 2],
    /// Pairs of triangles that no plane of theirs separates.
    waiting: Waiting,
}

/// Which pairs of nodes.
const BOXES: usize = 0;
const LEAVES: usize = 1;
/// Pairs of leaves are put off until there are so many.
const LOT: usize = 4;
/// Of those, the memory is asked for so many ahead.
const AHEAD: usize = 3;
/// Pairs of triangles that no plane separates wait for the next lot of leaves while there are fewer.
const ENOUGH: usize = 4;

/// A query that visits pairs of triangles that meet, until the visitor says false.
pub struct Query<'q, C> {
    pub pair: &'q Pair<'q, Tree>,
    pub open: &'q mut Open,
    pub work: &'q mut C,
    pub visit: &'q mut dyn FnMut(u32, u32) -> bool,
}

impl<C: Count> Work for Query<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { pair, open, work, visit } = self;
        Contacts { pair: &Placed::new::<L>(pair), open, work, visit }.each::<L>();
    }
}

/// The query where B's place in A's frame is known.
struct Contacts<'q, C> {
    pair: &'q Placed<'q>,
    open: &'q mut Open,
    work: &'q mut C,
    visit: &'q mut dyn FnMut(u32, u32) -> bool,
}

impl<C: Count> Contacts<'_, C> {
    #[inline(always)]
    fn each<L: Lanes>(mut self) {
        self.open.pairs[BOXES].clear();
        self.open.pairs[LEAVES].clear();
        self.open.waiting.count = 0;
        // One pair is always on its way: a processor works on both, and memory has that long to arrive.
        let mut coming = Some([self.pair.a.root, self.pair.b.root]);
        if self.pair.a.root.is_leaf() && self.pair.b.root.is_leaf() {
            self.put::<L>(1, 0, &[self.pair.a.root.0; 4], &[self.pair.b.root.0; 4]);
            coming = None;
        }
        loop {
            let next = self.open.pairs[BOXES].pop();
            if let Some(next) = next {
                self.fetch::<L>(next);
            }
            if let Some([a, b]) = coming {
                self.boxes::<L>(a, b);
            }
            coming = next;
            let ended = coming.is_none() && self.open.pairs[BOXES].len() == 0;
            let due = ended || self.open.pairs[LEAVES].len() >= LOT;
            let found = due && !self.leaves::<L>(ended);
            if ended || found {
                return;
            }
        }
    }

    #[inline(always)]
    fn fetch<L: Lanes>(&self, [a, b]: [Link; 2]) {
        L::prefetch(self.pair.a.node(a));
        L::prefetch(self.pair.b.node(b));
    }

    /// Puts pairs of nodes where they belong, the nearest last, so that it comes first: where objects overlap, they do so
    /// most there.
    #[inline(always)]
    fn put<L: Lanes>(&mut self, lanes: Bits, nearest: usize, a: &[u32; 4], b: &[u32; 4]) {
        // Known before the tests have ended, other than the lanes.
        let of_leaves = of_leaves(a, b);
        if of_leaves == 0 || of_leaves == 0xffff {
            // An index and no branch: which kind it is can hardly be foreseen.
            self.open.pairs[of_leaves as usize % 2].push::<L>(lanes, nearest, a, b);
        } else {
            self.open.pairs[BOXES].push::<L>(lanes & !of_leaves, nearest, a, b);
            self.open.pairs[LEAVES].push::<L>(lanes & of_leaves, nearest, a, b);
        }
    }

    /// Compares the children of two nodes, or a leaf with the children of a node.
    #[inline(always)]
    fn boxes<L: Lanes>(&mut self, a: Link, b: Link) {
        let Placed { a: tree_a, b: tree_b, relative, .. } = self.pair;
        let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
        let live = live(a, b);
        self.work.bv_tests(u64::from(live.count_ones()));
        let (left, nearest) = if L::NARROW {
            narrow::overlap([a, b], node_a, node_b, relative, live)
        } else {
            against!(overlap, [a, b], node_a, node_b, relative, live)
        };
        self.put::<L>(left, nearest, &successors(a, node_a), &successors(b, node_b));
    }

    /// Compares the triangles of all pairs of leaves that were put off, the latest first; `all` if nothing may be put
    /// off any more. Says whether to go on.
    #[inline(always)]
    fn leaves<L: Lanes>(&mut self, all: bool) -> bool {
        let Placed { a: tree_a, b: tree_b, relative, .. } = self.pair;
        let count = self.open.pairs[LEAVES].len();
        for place in count.saturating_sub(AHEAD)..count {
            self.fetch::<L>(self.open.pairs[LEAVES].get(place));
        }
        for place in (0..count).rev() {
            let [a, b] = self.open.pairs[LEAVES].get(place);
            if let Some(ahead) = place.checked_sub(AHEAD) {
                self.fetch::<L>(self.open.pairs[LEAVES].get(ahead));
            }
            let (leaf_a, leaf_b) = (tree_a.node(a), tree_b.node(b));
            let placed = relative.place::<L>(leaf_b, true);
            let live = live(a, b);
            if self.work.is_counting() {
                each(live, |i, j| self.work.primitive_test(leaf_a.children[i], leaf_b.children[j]));
            }
            let mut left = left_by_planes::<L>(&leaf_a.vectors, &placed, relative.slack, live);
            let placed = stored(&placed);
            while left != 0 {
                let (i, j) = lowest(left);
                left &= left - 1;
                self.open.waiting.push([&leaf_a.vectors, &placed], [i, j], [leaf_a.children[i], leaf_b.children[j]]);
                if self.open.waiting.is_full() && !self.look_closer::<L>() {
                    return false;
                }
            }
        }
        self.open.pairs[LEAVES].clear();
        let due = if all { 1 } else { ENOUGH };
        self.open.waiting.count < due || self.look_closer::<L>()
    }

    /// Compares pairs of triangles by the other directions, and exactly. Says whether to go on.
    #[inline(always)]
    fn look_closer<L: Lanes>(&mut self) -> bool {
        let waiting = &mut self.open.waiting;
        let (of_a, of_b) = waiting.faces::<L>();
        let mut left = left_by_edges(&of_a, &of_b, self.pair.relative.slack, (1 << waiting.count) - 1);
        waiting.count = 0;
        while left != 0 {
            let [a, b] = self.open.waiting.ids[left.trailing_zeros() as usize % 16];
            left &= left - 1;
            if !self.meets(a, b) {
                return false;
            }
        }
        true
    }

    /// Says whether to go on.
    fn meets(&mut self, a: u32, b: u32) -> bool {
        let Placed { a: tree_a, b: tree_b, frame, .. } = self.pair;
        let (of_a, of_b) = (frame.place_a(&tree_a.local.triangle(a)), frame.place_b(&tree_b.local.triangle(b)));
        !meet(&of_a, &of_b) || (self.visit)(a, b)
    }
}

/// What takes a node's place when it is opened.
#[inline(always)]
pub fn successors(link: Link, node: &Node) -> [u32; 4] {
    if link.is_leaf() { [link.0; 4] } else { node.children }
}

/// The lanes in which both are leaves.
#[inline(always)]
fn of_leaves(a: &[u32; 4], b: &[u32; 4]) -> Bits {
    let (mut of_a, mut of_b) = (0, 0);
    for i in 0..4 {
        of_a |= Bits::from(Link(a[i]).is_leaf()) * (0x1111 << i);
        of_b |= Bits::from(Link(b[i]).is_leaf()) * (0xf << (4 * i));
    }
    of_a & of_b
}

/// The lanes in which there is a pair to test: places of A by places of B; a leaf against an inner node is one place.
#[inline(always)]
pub fn live(a: Link, b: Link) -> Bits {
    let both = a.is_leaf() == b.is_leaf();
    let places = |link: Link| if both || !link.is_leaf() { link.count() } else { 1 };
    let of_a = 0x1111 * ((1 << places(a)) - 1);
    let of_b = 0xffff >> (16 - 4 * places(b));
    of_a & of_b
}

/// The places of A and B in the lowest lane of these.
#[inline(always)]
pub fn lowest(left: Bits) -> (usize, usize) {
    let lane = left.trailing_zeros() as usize;
    (lane % 4, lane / 4 % 4)
}

/// Calls a function for the places of all lanes of these. Not for kernels: the function is compiled for any processor.
#[inline(always)]
pub fn each(mut left: Bits, mut f: impl FnMut(usize, usize)) {
    while left != 0 {
        let (i, j) = lowest(left);
        left &= left - 1;
        f(i, j);
    }
}
