//! A mesh as SIMDop keeps it: a hierarchy of k-DOPs, sixteen to a node, all leaves at the same depth.

use ocb_triangles::Triangle;
use ocb_triangles::vector::dot;
use opencollbench_plugin::Mesh;

use super::directions::{Directions, MOST};
use crate::Local;

/// Children of a node.
pub const WIDTH: usize = 16;

/// A hierarchy over the triangles of one object.
#[derive(Debug)]
pub struct Tree {
    pub(super) directions: Directions,
    nodes: Vec<Node>,
    /// For each node a row per direction with where its children begin along it, then one with where they end.
    rows: Vec<[f32; WIDTH]>,
    /// The same for the node as a whole.
    own: Vec<f32>,
    /// The length of the longest vector to a corner, in the unit.
    pub(super) radius: f64,
    pub(super) local: Local,
}

/// What a node's children are: triangles at height 1, else nodes.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub children: [u32; WIDTH],
    pub count: usize,
    pub height: usize,
}

impl Tree {
    /// Builds the hierarchy; the mesh has triangles. The root is node 0.
    pub(super) fn new(mesh: &Mesh<'_>, directions: &Directions) -> Self {
        let (mesh, local) = Local::new(mesh);
        let radius = local.iter().flatten().map(|p| dot(*p, *p)).fold(0.0, f64::max).sqrt();
        let mut tree = Self {
            directions: directions.clone(),
            nodes: Vec::new(),
            rows: Vec::new(),
            own: Vec::new(),
            radius,
            local: mesh,
        };
        let middles = local.iter().map(|[p, q, r]| core::array::from_fn(|i| (p[i] + q[i] + r[i]) as f32)).collect();
        let mut ids: Vec<u32> = (0..local.len() as u32).collect();
        let mut height = 1;
        while WIDTH.pow(height) < ids.len() {
            height += 1;
        }
        Builder { tree: &mut tree, local: &local, middles }.node(&mut ids, height);
        tree
    }

    #[inline(always)]
    pub(super) fn node(&self, index: u32) -> &Node {
        &self.nodes[index as usize]
    }

    /// Rows of a node: beginnings, then ends.
    #[inline(always)]
    pub(super) fn rows(&self, index: u32) -> &[[f32; WIDTH]] {
        let size = 2 * self.directions.normals.len();
        &self.rows[index as usize * size..][..size]
    }

    /// Beginnings and ends of a node as a whole.
    #[inline(always)]
    pub(super) fn own(&self, index: u32) -> &[f32] {
        let size = 2 * self.directions.normals.len();
        &self.own[index as usize * size..][..size]
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.rows) + size_of_val(&*self.own) + self.local.bytes()
    }
}

struct Builder<'a> {
    tree: &'a mut Tree,
    local: &'a [Triangle],
    middles: Vec<[f32; 3]>,
}

impl Builder<'_> {
    /// The node over `ids`, of whose children each has so many triangles that its subtree is full, but for the last one.
    fn node(&mut self, ids: &mut [u32], height: u32) -> u32 {
        let index = self.tree.nodes.len();
        let half = self.tree.directions.normals.len();
        self.tree.nodes.push(Node { children: [0; WIDTH], count: 0, height: height as usize });
        self.tree.rows.resize(self.tree.rows.len() + 2 * half, [0.0; WIDTH]);
        self.tree.own.resize(self.tree.own.len() + half, f32::INFINITY);
        self.tree.own.resize(self.tree.own.len() + half, f32::NEG_INFINITY);
        let size = WIDTH.pow(height - 1);
        self.part(ids, size);
        for (place, part) in ids.chunks_mut(size).enumerate() {
            let (child, extents) = if height == 1 {
                (part[0], self.extents(part[0]))
            } else {
                let child = self.node(part, height - 1);
                let mut extents = [0.0; 2 * MOST];
                extents[..2 * half].copy_from_slice(self.tree.own(child));
                (child, extents)
            };
            let node = &mut self.tree.nodes[index];
            node.children[place] = child;
            node.count = place + 1;
            for i in 0..2 * half {
                let at = index * 2 * half + i;
                self.tree.rows[at][place] = extents[i];
                let own = &mut self.tree.own[at];
                *own = if i < half { own.min(extents[i]) } else { own.max(extents[i]) };
            }
        }
        index as u32
    }

    /// Where a triangle begins and ends along each direction, rounded outwards.
    fn extents(&self, id: u32) -> [f32; 2 * MOST] {
        let normals = &self.tree.directions.normals;
        let mut extents = [0.0; 2 * MOST];
        for (i, normal) in normals.iter().enumerate() {
            let [p, q, r] = self.local[id as usize].map(|corner| dot(*normal, corner));
            extents[i] = (p.min(q).min(r) as f32).next_down();
            extents[normals.len() + i] = (p.max(q).max(r) as f32).next_up();
        }
        extents
    }

    /// Orders `ids` so that chunks of `size` lie together: halves across the longest side, again and again.
    fn part(&self, ids: &mut [u32], size: usize) {
        let parts = ids.len().div_ceil(size);
        if parts < 2 {
            return;
        }
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for &id in &*ids {
            for axis in 0..3 {
                low[axis] = low[axis].min(self.middles[id as usize][axis]);
                high[axis] = high[axis].max(self.middles[id as usize][axis]);
            }
        }
        let side = |axis: usize| high[axis] - low[axis];
        let longest = (0..3).max_by(|&i, &j| side(i).total_cmp(&side(j))).unwrap_or(0);
        let key = |&id: &u32| (self.middles[id as usize][longest], id);
        let middle = parts / 2 * size;
        // Equal keys are ordered by id, so that the tree does not depend on how the selection works.
        ids.select_nth_unstable_by(middle, |i, j| {
            let (i, j) = (key(i), key(j));
            i.0.total_cmp(&j.0).then(i.1.cmp(&j.1))
        });
        let (left, right) = ids.split_at_mut(middle);
        self.part(left, size);
        self.part(right, size);
    }
}
