//! The closest pair of points of two objects.

use core::cmp::Ordering;
use std::collections::BinaryHeap;

use ocb_triangles::{Closest, distance_below};
use opencollbench_plugin::{Count, Separation};

use crate::query::Pair;
use crate::{Hierarchy, Open, Query, Volume};

/// How to look for the closest pair.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Most pairs of volumes that wait for their turn, at least 2; beyond that a pair is searched depth first.
    pub queue_size: usize,
    /// The answer may be too large by so much of the true distance,
    pub relative_error: f64,
    /// and by no more than this length.
    pub absolute_error: f64,
}

impl Default for Search {
    /// Exact, and always the nearest pair first.
    fn default() -> Self {
        Self { queue_size: usize::MAX, relative_error: 0.0, absolute_error: 0.0 }
    }
}

impl Search {
    /// Whatever is at least so far away cannot improve the best distance so far by more than the errors allowed.
    #[inline(always)]
    fn reach(&self, best: f64) -> f64 {
        (best - self.absolute_error).max(best / (1.0 + self.relative_error))
    }
}

/// Pairs of volumes with a lower bound of their distance.
#[derive(Debug)]
pub(crate) struct Pending<At> {
    nearest_first: BinaryHeap<Bounded<At>>,
    depth_first: Vec<Bounded<At>>,
}

impl<At> Default for Pending<At> {
    fn default() -> Self {
        Self { nearest_first: BinaryHeap::new(), depth_first: Vec::new() }
    }
}

#[derive(Clone, Copy, Debug)]
struct Bounded<At> {
    bound: f64,
    pair: Pair<At>,
}

impl<At> Ord for Bounded<At> {
    /// The nearest is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl<At> PartialOrd for Bounded<At> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<At> PartialEq for Bounded<At> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<At> Eq for Bounded<At> {}

/// The closest pair of triangles so far.
struct Best {
    closest: Closest,
    ids: [u32; 2],
    /// Bounds from here on are of no interest.
    reach: f64,
}

impl<H: Hierarchy, C: Count> Query<'_, H, C> {
    /// The closest pair of points.
    pub fn nearest(&mut self, open: &mut Open<H::At>, search: &Search) -> Separation {
        let closest = Closest { squared: f64::INFINITY, a: [0.0; 3], b: [0.0; 3] };
        let mut best = Best { closest, ids: [0, 0], reach: f64::INFINITY };
        self.dive(search, &mut best);
        let Pending { nearest_first: queue, depth_first } = &mut open.pending;
        queue.clear();
        queue.push(Bounded { bound: 0.0, pair: (self.a.root(), self.b.root()) });
        while let Some(next) = queue.pop() {
            if next.bound >= best.reach {
                break;
            }
            if queue.len() + 2 > search.queue_size {
                self.search_depth_first(next, depth_first, search, &mut best);
            } else if let Some(children) = self.bounds(&next.pair) {
                queue.extend(children.into_iter().filter(|child| child.bound < best.reach));
            } else {
                self.measure(&next.pair, search, &mut best);
            }
        }
        Separation {
            distance: best.closest.squared.sqrt(),
            points: Some([self.frame.to_world(best.closest.a), self.frame.to_world(best.closest.b)]),
            triangles: Some(best.ids),
        }
    }

    /// A first bound: straight down to one pair of leaves, always to the nearer pair of volumes.
    fn dive(&mut self, search: &Search, best: &mut Best) {
        let mut pair = (self.a.root(), self.b.root());
        while let Some([left, right]) = self.bounds(&pair) {
            pair = if right.bound < left.bound { right.pair } else { left.pair };
        }
        self.measure(&pair, search, best);
    }

    fn search_depth_first(
        &mut self,
        start: Bounded<H::At>,
        stack: &mut Vec<Bounded<H::At>>,
        search: &Search,
        best: &mut Best,
    ) {
        stack.clear();
        stack.push(start);
        while let Some(next) = stack.pop() {
            if next.bound >= best.reach {
                continue;
            }
            if let Some(mut children) = self.bounds(&next.pair) {
                // The nearer one is taken first.
                children.sort_unstable();
                stack.extend(children.into_iter().filter(|child| child.bound < best.reach));
            } else {
                self.measure(&next.pair, search, best);
            }
        }
    }

    /// The two pairs that a pair is opened into; none for leaves.
    #[inline(always)]
    fn bounds(&mut self, pair: &Pair<H::At>) -> Option<[Bounded<H::At>; 2]> {
        let relative = self.relative;
        let mut children = [Bounded { bound: 0.0, pair: *pair }; 2];
        let mut places = children.iter_mut();
        let opened = self.open(pair, |pair, a, b, shared| {
            if let Some(place) = places.next() {
                *place = Bounded { bound: relative.distance(a.gap(b, shared)), pair };
            }
        });
        opened.then_some(children)
    }

    fn measure(&mut self, pair: &Pair<H::At>, search: &Search, best: &mut Best) {
        let (triangles, ids) = self.leaves(pair);
        self.work.primitive_test(ids[0], ids[1]);
        if let Some(closest) = distance_below(&triangles[0], &triangles[1], best.closest.squared) {
            *best = Best { closest, ids, reach: search.reach(closest.squared.sqrt()) };
        }
    }
}
