//! Top-down construction with full nodes.

use ocb_hierarchy::fit::{Axes, Moments};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, dot};

use super::obb::{Obb, face_axes, orthonormal};
use super::tree::{FOUR, Link, Node};

/// The nodes over triangles in [-1, 1], the link to the root, and the length of the longest vector in the nodes.
pub fn build(triangles: &[Triangle]) -> (Vec<Node>, Link, f64) {
    let mut ids: Vec<u32> = (0..triangles.len() as u32).collect();
    let moments = triangles.iter().map(Moments::of).collect();
    let nodes = Vec::with_capacity(triangles.len() * 3 / 8);
    let mut builder = Builder { triangles, moments, nodes, squared_radius: 0.0 };
    let fit = builder.fit(&ids, &[]);
    let root = builder.node(&mut ids, &fit);
    (builder.nodes, root, builder.squared_radius.sqrt() * (1.0 + f64::EPSILON))
}

struct Builder<'a> {
    triangles: &'a [Triangle],
    moments: Vec<Moments>,
    nodes: Vec<Node>,
    squared_radius: f64,
}

/// What is fitted to a set of triangles.
struct Fit {
    obb: Obb,
    axes: Axes,
}

impl Builder<'_> {
    /// The best of a few boxes around triangles, and the principal axes. A patch of surface that is as wide as long has any
    /// principal axes within its plane, but its sides are those along which it was cut.
    fn fit(&mut self, ids: &[u32], cuts: &[Vector]) -> Fit {
        let axes = self.principal_axes(ids);
        let mut best = Obb::around(self.triangles, ids, &axes);
        let mut try_axes = |axes: &Axes| {
            let other = Obb::around(self.triangles, ids, axes);
            if other.area() < best.area() {
                best = other;
            }
        };
        if ids.len() <= FOUR {
            ids.iter().for_each(|&id| try_axes(&face_axes(&self.triangles[id as usize])));
        } else {
            cuts.iter().for_each(|&cut| try_axes(&orthonormal(axes[2], cut)));
        }
        self.reach(best.center.map(f64::from));
        Fit { obb: best, axes }
    }

    fn principal_axes(&self, ids: &[u32]) -> Axes {
        let mut all = Moments::NONE;
        for &id in ids {
            all.add(&self.moments[id as usize]);
        }
        all.axes()
    }

    fn reach(&mut self, vector: [f64; 3]) {
        self.squared_radius = self.squared_radius.max(dot(vector, vector));
    }

    /// The node over `ids`.
    fn node(&mut self, ids: &mut [u32], fit: &Fit) -> Link {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        if ids.len() <= FOUR {
            self.leaf(index, ids, &fit.obb);
            return Link::new(index, ids.len(), true);
        }
        // Parts of a full size (a power of four) leave no place below them unused.
        let mut size = FOUR;
        while size * FOUR < ids.len() {
            size *= FOUR;
        }
        let middle = (ids.len().div_ceil(size).div_ceil(2) * size).min(ids.len());
        self.part(ids, fit.axes[0], middle);
        let mut place = 0;
        for half in <[_; 2]>::from(ids.split_at_mut(middle)) {
            let mut cuts = [fit.axes[0]; 2];
            if half.len() > size {
                cuts[1] = self.principal_axes(half)[0];
                self.part(half, cuts[1], size);
            }
            for part in half.chunks_mut(size) {
                self.child(index, place, part, &cuts);
                place += 1;
            }
        }
        for unused in place..FOUR {
            self.repeat_first(index, unused);
        }
        Link::new(index, place, false)
    }

    /// Fills a place of an inner node.
    fn child(&mut self, index: usize, place: usize, ids: &mut [u32], cuts: &[Vector]) {
        let fit = self.fit(ids, cuts);
        let (link, obb) = (self.node(ids, &fit), &fit.obb);
        let node = &mut self.nodes[index];
        for i in 0..3 {
            node.vectors[i][place] = obb.center[i];
            for k in 0..3 {
                node.vectors[i][FOUR * (k + 1) + place] = obb.axes[k][i];
            }
            node.half[i][place] = obb.half[i];
        }
        node.children[place] = link.0;
    }

    fn repeat_first(&mut self, index: usize, place: usize) {
        let node = &mut self.nodes[index];
        for i in 0..3 {
            for k in 0..FOUR {
                node.vectors[i][FOUR * k + place] = node.vectors[i][FOUR * k];
            }
            node.half[i][place] = node.half[i][0];
        }
        node.children[place] = node.children[0];
    }

    fn leaf(&mut self, index: usize, ids: &[u32], obb: &Obb) {
        let mut node = Node::EMPTY;
        for place in 0..FOUR {
            let id = *ids.get(place).unwrap_or(&ids[0]);
            let corners = self.triangles[id as usize].map(|corner| corner.map(|x| x as f32));
            for (k, corner) in corners.iter().enumerate() {
                self.reach(corner.map(f64::from));
                for i in 0..3 {
                    node.vectors[i][FOUR * k + place] = corner[i];
                }
            }
            node.children[place] = id;
        }
        for i in 0..3 {
            node.vectors[i][12] = obb.center[i];
            for k in 0..3 {
                node.vectors[i][13 + k] = obb.axes[k][i];
            }
            node.half[0][i] = obb.half[i];
        }
        self.nodes[index] = node;
    }

    /// Orders `ids` so that the first `count` of them lie before the others along a direction.
    fn part(&self, ids: &mut [u32], direction: Vector, count: usize) {
        if count >= ids.len() {
            return;
        }
        let mut keyed: Vec<(f64, u32)> =
            ids.iter().map(|&id| (self.moments[id as usize].along(direction), id)).collect();
        // Equal keys are ordered by id, so that the tree does not depend on how the selection works.
        keyed.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (id, (_, sorted)) in ids.iter_mut().zip(keyed) {
            *id = sorted;
        }
    }
}
