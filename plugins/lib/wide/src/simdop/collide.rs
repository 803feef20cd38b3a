//! Which triangles meet? Both trees at once, depth first.

use ocb_lanes::{Bits, Lanes, Work};
use ocb_triangles::meet;
use opencollbench_plugin::Count;

use super::directions::MOST;
use super::dops::{first, overlap, overlap_one};
use super::tree::{Tree, WIDTH};
use super::turn::{Placed, Turn};
use crate::Pair;

/// A query that visits pairs of triangles that meet, until the visitor says false.
pub struct Contacts<'q, C> {
    pair: &'q Pair<'q, Tree>,
    /// Pairs of nodes that are still to be opened.
    open: &'q mut Vec<[u32; 2]>,
    work: &'q mut C,
    visit: &'q mut dyn FnMut(u32, u32) -> bool,
}

impl<'q, C: Count> Contacts<'q, C> {
    pub fn new(
        pair: &'q Pair<'q, Tree>,
        open: &'q mut Vec<[u32; 2]>,
        work: &'q mut C,
        visit: &'q mut dyn FnMut(u32, u32) -> bool,
    ) -> Self {
        Self { pair, open, work, visit }
    }
}

impl<C: Count> Work for Contacts<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Pair { a: tree_a, b: tree_b, frame } = self.pair;
        let turn = Turn::new::<L>(frame, tree_a, tree_b);
        let mut placed: Placed = [[0.0; WIDTH]; 2 * MOST];
        self.open.clear();
        self.open.push([0, 0]);
        while let Some([a, b]) = self.open.pop() {
            let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
            if node_a.height > node_b.height {
                // The root of B against ever smaller parts of A.
                turn.place_one(tree_b.own(b), &mut placed);
                self.work.bv_tests(node_a.count as u64);
                let mut left = overlap::<L>(tree_a.rows(a), &placed, 0, first(node_a.count));
                while left != 0 {
                    self.open.push([node_a.children[lowest(left)], b]);
                    left &= left - 1;
                }
                continue;
            }
            turn.place::<L>(tree_b.rows(b), &mut placed);
            self.work.bv_tests(node_b.count as u64);
            let mut left = overlap_one::<L>(tree_a.own(a), &placed, first(node_b.count));
            while left != 0 {
                let j = lowest(left);
                left &= left - 1;
                if node_a.height < node_b.height {
                    self.open.push([a, node_b.children[j]]);
                    continue;
                }
                self.work.bv_tests(node_a.count as u64);
                let mut pairs = overlap::<L>(tree_a.rows(a), &placed, j, first(node_a.count));
                while pairs != 0 {
                    let ids = [node_a.children[lowest(pairs)], node_b.children[j]];
                    pairs &= pairs - 1;
                    if node_a.height > 1 {
                        self.open.push(ids);
                    } else if !self.meets(ids) {
                        return;
                    }
                }
            }
        }
    }
}

impl<C: Count> Contacts<'_, C> {
    /// Says whether to go on.
    fn meets(&mut self, [a, b]: [u32; 2]) -> bool {
        let Pair { a: tree_a, b: tree_b, frame } = self.pair;
        self.work.primitive_test(a, b);
        let (of_a, of_b) = (frame.place_a(&tree_a.local.triangle(a)), frame.place_b(&tree_b.local.triangle(b)));
        !meet(&of_a, &of_b) || (self.visit)(a, b)
    }
}

/// The place of the lowest bit.
#[inline(always)]
pub fn lowest(left: Bits) -> usize {
    left.trailing_zeros() as usize % WIDTH
}
