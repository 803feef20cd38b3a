//! The tree of cuts.

use ocb_hierarchy::{Hierarchy, Leaves, Volume};
use ocb_triangles::vector::Vector;
use opencollbench_plugin::Mesh;

use crate::bounds::Bounds;

/// A node: how its box differs from that of its parent, which is one side.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Where the moved side lies.
    cut: f64,
    /// Leaf: its triangle. Inner node: its first child; the second one follows it.
    first: u32,
    /// Which side has been moved: twice the axis, and 1 for the upper one. And whether this is a leaf.
    side: u16,
    leaf: bool,
}

const _: () = assert!(size_of::<Node>() == 16, "what the tree is for");

/// A mesh as a tree of cuts.
#[derive(Debug)]
pub struct Cuts {
    nodes: Vec<Node>,
    /// The box of the root.
    all: Bounds,
    leaves: Leaves,
}

/// A node and its box, which only the way down tells.
#[derive(Clone, Copy, Debug)]
pub struct At {
    node: u32,
    bounds: Bounds,
}

impl Cuts {
    /// Builds the tree, top down.
    pub fn build(mesh: &Mesh<'_>) -> Self {
        let mut leaves = Leaves::new(mesh);
        let count = leaves.triangles.len();
        let all = Bounds::around(&leaves.triangles, leaves.radius);
        let mut nodes = vec![Node { cut: 0.0, first: 0, side: 0, leaf: count == 1 }];
        let mut open = vec![(0, all, 0, count, 0)];
        while let Some((at, bounds, first, end, depth)) = open.pop() {
            if end - first <= 1 {
                continue;
            }
            let direction: Vector = bounds.split_along(&leaves.triangles[first..end]);
            let axis = (0..3).find(|&k| direction[k] > 0.0).unwrap_or(0);
            let middle = leaves.split(first, end, direction, depth);
            let child = nodes.len();
            nodes[at] = Node { first: child as u32, ..nodes[at] };
            for (i, (from, to)) in [(first, middle), (middle, end)].into_iter().enumerate() {
                let upper = i == 0;
                let cut = Bounds::around(&leaves.triangles[from..to], leaves.radius).sides[usize::from(upper)][axis];
                let side = 2 * axis as u16 + u16::from(upper);
                nodes.push(Node { cut, first: from as u32, side, leaf: to - from == 1 });
                open.push((child + i, bounds.cut(upper, axis, cut), from, to, depth + 1));
            }
        }
        Self { nodes, all, leaves }
    }
}

impl Hierarchy for Cuts {
    type Volume = Bounds;
    type At = At;

    #[inline(always)]
    fn root(&self) -> At {
        At { node: 0, bounds: self.all }
    }

    #[inline(always)]
    fn volume<'s>(&'s self, at: &'s At) -> &'s Bounds {
        &at.bounds
    }

    #[inline(always)]
    fn is_leaf(&self, at: &At) -> bool {
        self.nodes[at.node as usize].leaf
    }

    #[inline(always)]
    fn children(&self, at: &At) -> [At; 2] {
        let first = self.nodes[at.node as usize].first;
        [first, first + 1].map(|child| {
            let Node { cut, side, .. } = self.nodes[child as usize];
            At { node: child, bounds: at.bounds.cut(side & 1 == 1, usize::from(side / 2), cut) }
        })
    }

    #[inline(always)]
    fn triangle(&self, at: &At) -> usize {
        self.nodes[at.node as usize].first as usize
    }

    fn leaves(&self) -> &Leaves {
        &self.leaves
    }
}
