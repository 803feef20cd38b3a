//! Both trees at once: from the pair of roots down to pairs of leaves.

use ocb_triangles::vector::{Vector, dot, sub};
use ocb_triangles::{Closest, Frame, Triangle, distance_below, meet};
use opencollbench_plugin::{Count, Placed, Separation};

use crate::BoxTree;
use crate::nearest_first::NearestFirst;
use crate::relative::{Direction, Relative};
use crate::tree::{Node, Tree};

/// Largest value of the parameter `leaf_size`.
pub const MAX_LEAF: usize = 32;

/// Pairs of boxes that are still to be opened.
#[derive(Debug, Default)]
pub struct Open {
    /// Nodes of A and B whose boxes overlap; the next one last.
    overlapping: Vec<[u32; 2]>,
    /// Nodes for a distance query, with a lower bound of their distance.
    within: NearestFirst,
}

/// One query.
pub struct Traversal<'a, C> {
    a: &'a Tree,
    b: &'a Tree,
    frame: Frame,
    relative: Relative,
    work: &'a mut C,
}

impl<'a, C: Count> Traversal<'a, C> {
    pub fn new(a: Placed<'a, BoxTree>, b: Placed<'a, BoxTree>, work: &'a mut C) -> Self {
        let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
        let relative = Relative::new(&frame, &a.object.nodes[0], &b.object.nodes[0]);
        Self { a: a.object, b: b.object, frame, relative, work }
    }

    /// Visits every pair of triangles that meet, until the visitor says false.
    pub fn each_contact(&mut self, open: &mut Open, mut visit: impl FnMut(u32, u32) -> bool) {
        let open = &mut open.overlapping;
        open.clear();
        self.work.bv_tests(1);
        if !self.relative.apart(&self.a.nodes[0], &self.b.nodes[0]) {
            open.push([0, 0]);
        }
        while let Some(pair) = open.pop() {
            let (a, b) = (&self.a.nodes[pair[0] as usize], &self.b.nodes[pair[1] as usize]);
            let Some(children) = children(pair, a, b) else {
                if !self.each_contact_of_leaves(a, b, &mut visit) {
                    return;
                }
                continue;
            };
            for child in children {
                self.work.bv_tests(1);
                if !self.relative.apart(&self.a.nodes[child[0] as usize], &self.b.nodes[child[1] as usize]) {
                    open.push(child);
                }
            }
        }
    }

    fn each_contact_of_leaves(&mut self, a: &Node, b: &Node, visit: &mut impl FnMut(u32, u32) -> bool) -> bool {
        let mut of_b = [[[0.0; 3]; 3]; MAX_LEAF];
        for (placed, j) in of_b.iter_mut().zip(range(b)) {
            *placed = self.frame.place_b(&self.b.triangles[j]);
        }
        for i in range(a) {
            let triangle = self.frame.place_a(&self.a.triangles[i]);
            for (other, j) in of_b.iter().zip(range(b)) {
                let (id_a, id_b) = (self.a.ids[i], self.b.ids[j]);
                self.work.primitive_test(id_a, id_b);
                if meet(&triangle, other) && !visit(id_a, id_b) {
                    return false;
                }
            }
        }
        true
    }

    /// The closest pair of points. Nearest pairs of boxes first: depth first opens two to eight times as many until it
    /// has a good bound.
    pub fn nearest(&mut self, open: &mut Open) -> Separation {
        let mut best = self.dive();
        let open = &mut open.within;
        open.restart(best.distance);
        open.push(0.0, [0, 0]);
        while let Some((bound, pair)) = open.pop() {
            if bound >= best.distance {
                continue;
            }
            let (a, b) = (&self.a.nodes[pair[0] as usize], &self.b.nodes[pair[1] as usize]);
            let Some(children) = children(pair, a, b) else {
                self.nearest_of_leaves(a, b, &mut best);
                continue;
            };
            self.work.bv_tests(2);
            for pair in children {
                let (a, b) = (&self.a.nodes[pair[0] as usize], &self.b.nodes[pair[1] as usize]);
                let bound = self.relative.distance(a, b, &best.toward);
                if bound < best.distance {
                    open.push(bound, pair);
                }
            }
        }
        Separation {
            distance: best.distance,
            points: Some([self.frame.to_world(best.closest.a), self.frame.to_world(best.closest.b)]),
            triangles: Some(best.ids),
        }
    }

    /// A first bound: straight down to one pair of leaves, always to the nearer middle.
    fn dive(&mut self) -> Best {
        let (mut pair, mut best) = ([0, 0], Best::none());
        loop {
            let (a, b) = (&self.a.nodes[pair[0] as usize], &self.b.nodes[pair[1] as usize]);
            let Some(children) = children(pair, a, b) else {
                self.nearest_of_leaves(a, b, &mut best);
                return best;
            };
            self.work.bv_tests(2);
            let [left, right] = children.map(|[a, b]| {
                self.relative.squared_middle_distance(&self.a.nodes[a as usize], &self.b.nodes[b as usize])
            });
            pair = children[usize::from(right < left)];
        }
    }

    fn nearest_of_leaves(&mut self, a: &Node, b: &Node, best: &mut Best) {
        let mut of_b = [[[0.0; 3]; 3]; MAX_LEAF];
        for (placed, j) in of_b.iter_mut().zip(range(b)) {
            *placed = self.frame.place_b(&self.b.triangles[j]);
        }
        for i in range(a) {
            let triangle = self.frame.place_a(&self.a.triangles[i]);
            for (other, j) in of_b.iter().zip(range(b)) {
                // A triangle is thin where its box is thick: most pairs are told apart along the best direction so far.
                self.work.bv_tests(1);
                if gap_along(best.unit, &triangle, other) - self.relative.slack >= best.distance {
                    continue;
                }
                let ids = [self.a.ids[i], self.b.ids[j]];
                self.work.primitive_test(ids[0], ids[1]);
                if let Some(closest) = distance_below(&triangle, other, best.closest.squared) {
                    *best = Best::new(closest, ids, &self.frame);
                }
            }
        }
    }
}

/// The closest pair of triangles so far.
struct Best {
    closest: Closest,
    ids: [u32; 2],
    distance: f64,
    /// From A to B, in the frame of the query; 0 before there is any.
    unit: Vector,
    toward: Direction,
}

impl Best {
    fn none() -> Self {
        let closest = Closest { squared: f64::INFINITY, a: [0.0; 3], b: [0.0; 3] };
        Self { closest, ids: [0, 0], distance: f64::INFINITY, unit: [0.0; 3], toward: Direction::NONE }
    }

    fn new(closest: Closest, ids: [u32; 2], frame: &Frame) -> Self {
        let distance = closest.squared.sqrt();
        let unit = if distance > 0.0 { sub(closest.b, closest.a).map(|x| x / distance) } else { [0.0; 3] };
        Self { closest, ids, distance, unit, toward: Direction::new(frame, unit) }
    }
}

/// How far b lies beyond a in a direction.
#[inline(always)]
fn gap_along(unit: Vector, a: &Triangle, b: &Triangle) -> f64 {
    let [of_a, of_b] = [a, b].map(|t| t.map(|corner| dot(unit, corner)));
    of_b[0].min(of_b[1]).min(of_b[2]) - of_a[0].max(of_a[1]).max(of_a[2])
}

/// Opens the larger box of a pair, a leaf never; none for two leaves.
#[inline(always)]
fn children(pair: [u32; 2], a: &Node, b: &Node) -> Option<[[u32; 2]; 2]> {
    if !a.is_leaf() && (b.is_leaf() || a.size() >= b.size()) {
        Some([[a.first, pair[1]], [a.first + 1, pair[1]]])
    } else if !b.is_leaf() {
        Some([[pair[0], b.first], [pair[0], b.first + 1]])
    } else {
        None
    }
}

/// The triangles of a leaf.
#[inline(always)]
fn range(leaf: &Node) -> core::ops::Range<usize> {
    leaf.first as usize..(leaf.first + leaf.count) as usize
}
