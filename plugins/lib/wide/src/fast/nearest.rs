//! How far apart? Both trees at once, nearest pairs of nodes first.

use ocb_lanes::{Bits, Lanes, Work};
use ocb_triangles::vector::{Vector, dot, sub};
use ocb_triangles::{Closest, Triangle, distance_below};
use opencollbench_plugin::{Count, Separation};

use super::Placed;
use super::boxes::{Boxes, against, squared_distance};
use super::collide::{each, live, lowest, successors};
use super::faces::{distances, rough_distance};
use super::queue::NearestFirst;
use super::relative::stored;
use super::tree::{Link, Tree};
use super::waiting::Waiting;
use crate::Pair;

/// What is still to be done, kept from query to query for its memory.
#[derive(Debug, Default)]
pub struct Open {
    pairs: NearestFirst,
    /// Pairs of triangles that are not apart by the limit, as far as a rough bound can tell.
    waiting: Waiting,
    /// Pairs of triangles that may be the closest, each with a lower bound of its distance.
    candidates: Vec<(f32, [u32; 2])>,
}

/// So many pairs of nodes are opened in a row: a processor works on several of them at the same time.
const ROW: usize = 4;

/// A query for the closest pair of points.
///
/// Kernels in single precision give certain bounds of every pair of triangles that matters; pairs that may be the closest
/// are kept, and measured in double precision when all bounds are known.
pub struct Query<'q, C> {
    pub pair: &'q Pair<'q, Tree>,
    pub open: &'q mut Open,
    pub work: &'q mut C,
}

impl<C: Count> Work for Query<'_, C> {
    type Output = Separation;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Separation {
        Nearest::new(&Placed::new::<L>(self.pair), self.open, self.work).separate::<L>()
    }
}

/// The query where B's place in A's frame is known.
struct Nearest<'q, C> {
    pair: &'q Placed<'q>,
    open: &'q mut Open,
    work: &'q mut C,
    /// The least of the bounds of the triangles that wait.
    least: f32,
    /// The distance is certainly not above this, in A's unit.
    limit: f32,
    closest: Closest,
    ids: [u32; 2],
}

impl<'q, C: Count> Nearest<'q, C> {
    fn new(pair: &'q Placed<'q>, open: &'q mut Open, work: &'q mut C) -> Self {
        let closest = Closest { squared: f64::INFINITY, a: [0.0; 3], b: [0.0; 3] };
        Self { pair, open, work, least: f32::INFINITY, limit: f32::INFINITY, closest, ids: [0; 2] }
    }

    /// Measures a pair of triangles.
    fn measure(&mut self, ids: [u32; 2]) {
        let Placed { a, b, frame, relative } = self.pair;
        let (of_a, of_b) = (frame.place_a(&a.local.triangle(ids[0])), frame.place_b(&b.local.triangle(ids[1])));
        // Neighbours share the closest point. Along the vector found they are no nearer, but for roundings, which are
        // nothing beside the slack.
        let found = self.limit > relative.slack;
        if found && gap_along(sub(self.closest.b, self.closest.a), &of_a, &of_b) >= self.closest.squared * (1.0 - 1e-14)
        {
            return;
        }
        if let Some(closest) = distance_below(&of_a, &of_b, self.closest.squared) {
            self.closest = closest;
            self.ids = ids;
            self.limit = self.limit.min(((closest.squared.sqrt() / a.local.unit) as f32).next_up());
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

/// How far b lies beyond a in a direction, times its length.
fn gap_along(direction: Vector, a: &Triangle, b: &Triangle) -> f64 {
    let [of_a, of_b] = [a, b].map(|t| t.map(|corner| dot(direction, corner)));
    of_b[0].min(of_b[1]).min(of_b[2]) - of_a[0].max(of_a[1]).max(of_a[2])
}

/// A pair of nodes and a lower bound of its squared distance.
type Bounded = (f32, [Link; 2]);

impl<C: Count> Nearest<'_, C> {
    #[inline(always)]
    fn separate<L: Lanes>(mut self) -> Separation {
        self.open.candidates.clear();
        self.open.pairs.clear();
        self.open.waiting.count = 0;
        self.open.pairs.push(0.0, [self.pair.a.root, self.pair.b.root]);
        loop {
            let (row, count) = self.take::<L>();
            // Triangles that may be nearer than all nodes, or give the first bound, are next.
            let due = count == 0 || row[0].0 > self.least * self.least || self.limit == f32::INFINITY;
            if self.open.waiting.count > 0 && due {
                self.look_closer::<L>();
            } else if count == 0 {
                break;
            }
            self.row::<L>(&row[..count]);
            if self.closest.squared == 0.0 {
                return self.separation();
            }
        }
        let mut candidates = core::mem::take(&mut self.open.candidates);
        candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        for &(least, ids) in &candidates {
            if least > self.limit {
                break;
            }
            self.measure(ids);
        }
        self.open.candidates = candidates;
        self.separation()
    }

    /// Takes the nearest pairs of nodes, and asks for their memory.
    #[inline(always)]
    fn take<L: Lanes>(&mut self) -> ([Bounded; ROW], usize) {
        let mut row = [(0.0, [self.pair.a.root, self.pair.b.root]); ROW];
        let mut count = 0;
        let limit = self.limit * self.limit;
        while count < ROW
            && let Some((squared, pair)) = self.open.pairs.pop(limit)
        {
            if squared <= limit {
                L::prefetch(self.pair.a.node(pair[0]));
                L::prefetch(self.pair.b.node(pair[1]));
                row[count] = (squared, pair);
                count += 1;
            }
        }
        (row, count)
    }

    /// Opens pairs of nodes, or compares their triangles.
    #[inline(always)]
    fn row<L: Lanes>(&mut self, row: &[Bounded]) {
        let mut bounds = [[0.0; 16]; ROW];
        let mut left = [0; ROW];
        for (place, &(squared, [a, b])) in row.iter().enumerate() {
            if squared > self.limit * self.limit {
                continue;
            }
            if a.is_leaf() && b.is_leaf() {
                self.leaves::<L>(a, b);
            } else {
                left[place] = self.boxes::<L>(a, b, &mut bounds[place]);
            }
        }
        for (place, &(_, [a, b])) in row.iter().enumerate() {
            let next_a = successors(a, self.pair.a.node(a));
            let next_b = successors(b, self.pair.b.node(b));
            each(left[place], |i, j| {
                self.open.pairs.push(bounds[place][4 * j + i], [Link(next_a[i]), Link(next_b[j])]);
            });
        }
    }

    /// Lower bounds of the squared distances of the children of two nodes, and those that are within the limit.
    #[inline(always)]
    fn boxes<L: Lanes>(&mut self, a: Link, b: Link, squared: &mut [f32; 16]) -> Bits {
        let Placed { a: tree_a, b: tree_b, relative, .. } = self.pair;
        let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
        let live = live(a, b);
        self.work.bv_tests(u64::from(live.count_ones()));
        let bounds = against!(squared_distance, [a, b], node_a, node_b, relative);
        bounds.store(squared);
        live & !L::bits(bounds.above(L::splat(self.limit * self.limit)))
    }

    /// Rough bounds for the triangles of two leaves; those that are within the limit have to wait.
    #[inline(always)]
    fn leaves<L: Lanes>(&mut self, a: Link, b: Link) {
        let Placed { a: tree_a, b: tree_b, relative, .. } = self.pair;
        let (leaf_a, leaf_b) = (tree_a.node(a), tree_b.node(b));
        let live = live(a, b);
        self.work.bv_tests(u64::from(live.count_ones()));
        let placed = relative.place::<L>(leaf_b, true);
        let rough = rough_distance::<L>(&leaf_a.vectors, &placed, relative.slack);
        let placed = stored(&placed);
        let mut left = live & !L::bits(rough.above(L::splat(self.limit)));
        let mut bounds = [0.0; 16];
        rough.store(&mut bounds);
        // No closure here: it would be compiled for any processor.
        while left != 0 {
            let (i, j) = lowest(left);
            left &= left - 1;
            let bound = bounds[4 * j + i].max(0.0);
            if self.open.waiting.is_full() {
                self.look_closer::<L>();
            }
            if bound <= self.limit {
                let ids = [leaf_a.children[i], leaf_b.children[j]];
                self.work.primitive_test(ids[0], ids[1]);
                self.least = self.least.min(bound);
                self.open.waiting.push([&leaf_a.vectors, &placed], [i, j], ids);
            }
        }
    }

    /// Bounds from below and above for the triangles that wait. Those that meet, as far as the bounds can tell, are measured
    /// now, the others when all bounds are known.
    #[inline(always)]
    fn look_closer<L: Lanes>(&mut self) {
        let (of_a, of_b) = self.open.waiting.faces::<L>();
        let found = distances(&of_a, &of_b, self.pair.relative.slack);
        for lane in 0..self.open.waiting.count.min(16) {
            let (least, most) = (found.least[lane], found.most[lane]);
            let ids = self.open.waiting.ids[lane];
            if least > self.limit {
                continue;
            }
            self.limit = self.limit.min(most);
            if least > 0.0 {
                self.open.candidates.push((least, ids));
            } else {
                self.measure(ids);
            }
        }
        self.open.waiting.count = 0;
        self.least = f32::INFINITY;
    }
}
