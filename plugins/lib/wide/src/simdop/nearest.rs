//! How far apart? Both trees at once, nearest pairs of nodes first.

use core::cmp::Reverse;
use std::collections::BinaryHeap;

use ocb_lanes::{Lanes, Work};
use ocb_triangles::{Closest, distance_below};
use opencollbench_plugin::{Count, Separation};

use super::collide::lowest;
use super::directions::MOST;
use super::dops::{distances, distances_one, first};
use super::tree::{Node, Tree, WIDTH};
use super::turn::{Placed, Turn};
use crate::Pair;

/// Pairs of nodes by the bits of a lower bound of their squared distance: those grow with the number.
pub type Open = BinaryHeap<Reverse<(u32, [u32; 2])>>;

/// A query for the closest pair of points.
pub struct Nearest<'q, C> {
    pair: &'q Pair<'q, Tree>,
    open: &'q mut Open,
    work: &'q mut C,
    /// The squared distance is certainly not above this, in A's unit.
    limit: f32,
    closest: Closest,
    ids: [u32; 2],
}

impl<'q, C: Count> Nearest<'q, C> {
    pub fn new(pair: &'q Pair<'q, Tree>, open: &'q mut Open, work: &'q mut C) -> Self {
        let closest = Closest { squared: f64::INFINITY, a: [0.0; 3], b: [0.0; 3] };
        Self { pair, open, work, limit: f32::INFINITY, closest, ids: [0; 2] }
    }

    fn measure(&mut self, ids: [u32; 2]) {
        let Pair { a, b, frame } = self.pair;
        self.work.primitive_test(ids[0], ids[1]);
        let (of_a, of_b) = (frame.place_a(&a.local.triangle(ids[0])), frame.place_b(&b.local.triangle(ids[1])));
        if let Some(closest) = distance_below(&of_a, &of_b, self.closest.squared) {
            self.closest = closest;
            self.ids = ids;
            // Rounded up more than any of the steps can round down.
            let distance = closest.squared.sqrt() / a.local.unit;
            self.limit = ((distance * distance * (1.0 + 1e-12) + 1e-44) as f32).next_up();
        }
    }

    fn separation(&self) -> Separation {
        let frame = &self.pair.frame;
        Separation {
            distance: self.closest.squared.sqrt(),
            points: Some([frame.to_world(self.closest.a), frame.to_world(self.closest.b)]),
            triangles: Some(self.ids),
        }
    }
}

impl<C: Count> Work for Nearest<'_, C> {
    type Output = Separation;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> Separation {
        let Pair { a: tree_a, b: tree_b, frame } = self.pair;
        let turn = Turn::new::<L>(frame, tree_a, tree_b);
        let mut placed: Placed = [[0.0; WIDTH]; 2 * MOST];
        let (mut bounds, mut finer) = ([0.0; WIDTH], [0.0; WIDTH]);
        self.open.clear();
        self.open.push(Reverse((0, [0, 0])));
        while let Some(Reverse((bound, [a, b]))) = self.open.pop() {
            if f32::from_bits(bound) > self.limit || self.closest.squared == 0.0 {
                break;
            }
            let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
            if node_a.height > node_b.height {
                // The root of B against ever smaller parts of A.
                turn.place_one(tree_b.own(b), &mut placed);
                self.work.bv_tests(node_a.count as u64);
                distances::<L>(tree_a.rows(a), &placed, 0, turn.sure).store(&mut bounds);
                for i in 0..node_a.count {
                    self.put(bounds[i], [node_a.children[i], b]);
                }
                continue;
            }
            turn.place::<L>(tree_b.rows(b), &mut placed);
            self.work.bv_tests(node_b.count as u64);
            let near = distances_one::<L>(tree_a.own(a), &placed, turn.sure);
            near.store(&mut bounds);
            let mut left = first(node_b.count) & !L::bits(near.above(L::splat(self.limit)));
            // The nearest child first, so that there is a limit for the others.
            while left != 0 {
                let j = near.least(left);
                left &= !(1 << j);
                if bounds[j] > self.limit {
                    continue;
                }
                if node_a.height < node_b.height {
                    self.put(bounds[j], [a, node_b.children[j]]);
                    continue;
                }
                self.work.bv_tests(node_a.count as u64);
                let of_pairs = distances::<L>(tree_a.rows(a), &placed, j, turn.sure);
                of_pairs.store(&mut finer);
                let mut pairs = first(node_a.count) & !L::bits(of_pairs.above(L::splat(self.limit)));
                while pairs != 0 {
                    let i = lowest(pairs);
                    pairs &= pairs - 1;
                    self.compare(node_a, node_b, [i, j], finer[i]);
                }
            }
        }
        self.separation()
    }
}

impl<C: Count> Nearest<'_, C> {
    fn put(&mut self, bound: f32, pair: [u32; 2]) {
        if bound <= self.limit {
            self.open.push(Reverse((bound.to_bits(), pair)));
        }
    }

    /// Two children: triangles now, nodes later.
    fn compare(&mut self, node_a: &Node, node_b: &Node, [i, j]: [usize; 2], bound: f32) {
        let ids = [node_a.children[i], node_b.children[j]];
        if node_a.height > 1 {
            self.put(bound, ids);
        } else if bound <= self.limit {
            self.measure(ids);
        }
    }
}
