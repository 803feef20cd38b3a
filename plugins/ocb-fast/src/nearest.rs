//! How far apart? Both trees at once, nearest pairs of nodes first.

use ocb_triangles::vector::{Vector, dot, sub};
use ocb_triangles::{Closest, Triangle, distance_below};
use opencollbench_plugin::{Count, Separation};

use crate::Pair;
use crate::boxes::{Boxes, squared_distance};
use crate::collide::{each, live};
use crate::faces::{Faces, distances, rough_distance};
use crate::lanes::{Lanes, Work};
use crate::queue::NearestFirst;
use crate::tree::Link;

/// A query for the closest pair of points.
///
/// Kernels in single precision give certain bounds of every pair of triangles that matters; pairs that may be the closest
/// are kept, and measured in double precision when all bounds are known.
pub struct Nearest<'q, C> {
    pair: &'q Pair<'q>,
    open: &'q mut NearestFirst,
    work: &'q mut C,
    /// The distance is certainly not above this, in A's unit.
    limit: f32,
    closest: Closest,
    ids: [u32; 2],
}

/// A pair of triangles, and a lower bound of its distance.
type Candidate = (f32, [u32; 2]);

impl<'q, C: Count> Nearest<'q, C> {
    pub fn new(pair: &'q Pair<'q>, open: &'q mut NearestFirst, work: &'q mut C) -> Self {
        let closest = Closest { squared: f64::INFINITY, a: [0.0; 3], b: [0.0; 3] };
        Self { pair, open, work, limit: f32::INFINITY, closest, ids: [0; 2] }
    }

    /// Measures a pair of triangles.
    fn measure(&mut self, ids: [u32; 2]) {
        let Pair { a, b, frame, relative } = self.pair;
        let (of_a, of_b) = (frame.place_a(&a.triangle(ids[0])), frame.place_b(&b.triangle(ids[1])));
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
            self.limit = self.limit.min(((closest.squared.sqrt() / relative.unit) as f32).next_up());
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

impl<C: Count> Work for Nearest<'_, C> {
    type Output = Separation;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> Separation {
        let Pair { a: tree_a, b: tree_b, relative, .. } = self.pair;
        let mut candidates: Vec<Candidate> = Vec::new();
        self.open.clear();
        self.open.push(0.0, [tree_a.root, tree_b.root]);
        while let Some((squared, [a, b])) = self.open.pop(self.limit * self.limit) {
            let squared_limit = self.limit * self.limit;
            if squared > squared_limit {
                continue;
            }
            if let Some([next_a, next_b]) = self.open.peek() {
                L::prefetch(tree_a.node(next_a));
                L::prefetch(tree_b.node(next_b));
            }
            let (node_a, node_b) = (tree_a.node(a), tree_b.node(b));
            let placed = relative.place::<L>(node_b, b.is_leaf());
            let live = live(a, b);
            self.work.bv_tests(u64::from(live.count_ones()));
            if a.is_leaf() && b.is_leaf() {
                let (of_a, of_b) = (Faces::<L>::spread(node_a), Faces::tile(&placed));
                let rough = rough_distance(&of_a, &of_b, relative.slack);
                let left = live & !L::bits(rough.above(L::splat(self.limit)));
                if left == 0 {
                    continue;
                }
                let found = distances(&of_a, &of_b, relative.slack);
                each(left, |i, j| {
                    let (least, most) = (found.least[4 * i + j], found.most[4 * i + j]);
                    let ids = [node_a.children[i], node_b.children[j]];
                    self.work.primitive_test(ids[0], ids[1]);
                    if least > self.limit {
                        return;
                    }
                    self.limit = self.limit.min(most);
                    if least > 0.0 {
                        candidates.push((least, ids));
                    } else {
                        self.measure(ids);
                    }
                });
                if self.closest.squared == 0.0 {
                    return self.separation();
                }
                continue;
            }
            let of_a = if a.is_leaf() { Boxes::<L>::of_leaf(node_a) } else { Boxes::spread(node_a) };
            let of_b = if b.is_leaf() { Boxes::<L>::of_leaf(&placed) } else { Boxes::tile(&placed) };
            let bounds = squared_distance(&of_a, &of_b);
            let left = live & !L::bits(bounds.above(L::splat(squared_limit)));
            let mut squared = [0.0; 16];
            bounds.store(&mut squared);
            each(left, |i, j| {
                let next_a = if a.is_leaf() { a } else { Link(node_a.children[i]) };
                let next_b = if b.is_leaf() { b } else { Link(node_b.children[j]) };
                self.open.push(squared[4 * i + j], [next_a, next_b]);
            });
        }
        candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        for (least, ids) in candidates {
            if least > self.limit {
                break;
            }
            self.measure(ids);
        }
        self.separation()
    }
}
