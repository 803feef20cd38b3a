//! The usual hierarchy of one object: every node holds its volume.

use opencollbench_plugin::Mesh;

use crate::{Hierarchy, Leaves, Volume};

/// A volume: an inner node or a leaf.
#[derive(Clone, Copy, Debug)]
struct Node<V> {
    /// In the object's frame.
    volume: V,
    /// Leaf: its triangle. Inner node: its first child; the second one follows it.
    first: u32,
    leaf: bool,
}

/// A mesh as a hierarchy.
#[derive(Debug)]
pub struct Tree<V> {
    /// The root is the first.
    nodes: Vec<Node<V>>,
    leaves: Leaves,
}

impl<V: Volume> Tree<V> {
    /// Builds the tree, top down.
    pub fn build(mesh: &Mesh<'_>) -> Self {
        let mut leaves = Leaves::new(mesh);
        let node = |leaves: &Leaves, first: usize, end: usize| Node {
            volume: V::around(&leaves.triangles[first..end], leaves.radius),
            first: first as u32,
            leaf: end - first == 1,
        };
        let all = leaves.triangles.len();
        let mut nodes = Vec::with_capacity(2 * all);
        nodes.push(node(&leaves, 0, all));
        let mut open = vec![(0, 0, all, 0)];
        while let Some((at, first, end, depth)) = open.pop() {
            if end - first <= 1 {
                continue;
            }
            let direction = V::split_along(&nodes[at as usize].volume, &leaves.triangles[first..end]);
            let middle = leaves.split(first, end, direction, depth);
            let child = nodes.len() as u32;
            nodes[at as usize].first = child;
            nodes.push(node(&leaves, first, middle));
            nodes.push(node(&leaves, middle, end));
            open.extend([(child, first, middle, depth + 1), (child + 1, middle, end, depth + 1)]);
        }
        Self { nodes, leaves }
    }
}

impl<V: Volume> Hierarchy for Tree<V> {
    type Volume = V;
    type At = u32;

    #[inline(always)]
    fn root(&self) -> u32 {
        0
    }

    #[inline(always)]
    fn volume<'s>(&'s self, at: &'s u32) -> &'s V {
        &self.nodes[*at as usize].volume
    }

    #[inline(always)]
    fn is_leaf(&self, at: &u32) -> bool {
        self.nodes[*at as usize].leaf
    }

    #[inline(always)]
    fn children(&self, at: &u32) -> [u32; 2] {
        let first = self.nodes[*at as usize].first;
        [first, first + 1]
    }

    #[inline(always)]
    fn triangle(&self, at: &u32) -> usize {
        self.nodes[*at as usize].first as usize
    }

    fn leaves(&self) -> &Leaves {
        &self.leaves
    }
}
