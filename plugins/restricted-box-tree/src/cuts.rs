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
    /// What comes next.
    first: u32,
    /// Which side has been moved: twice the axis, and 1 for the upper one.
    side: u8,
    next: Next,
}

/// What a node's `first` is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Next {
    /// The first child; the second one follows it.
    Children,
    /// The only child, which cuts off more of the same box.
    Cut,
    /// The triangle of a leaf.
    Triangle,
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
        let next = if count == 1 { Next::Triangle } else { Next::Children };
        let mut nodes = vec![Node { cut: all.sides[0][0], first: 0, side: 0, next }];
        let mut open = vec![(0, all, all, 0, count, 0)];
        while let Some((mut at, mut bounds, tight, first, end, depth)) = open.pop() {
            while let Some(side) = bounds.loosest_side(&tight) {
                bounds = bounds.cut(side, tight.side(side));
                let more = Node { cut: tight.side(side), side, ..nodes[at] };
                (nodes[at].first, nodes[at].next) = (nodes.len() as u32, Next::Cut);
                at = nodes.len();
                nodes.push(more);
            }
            if end - first <= 1 {
                continue;
            }
            let direction: Vector = bounds.split_along(&leaves.triangles[first..end]);
            let axis = (0..3).find(|&k| direction[k] > 0.0).unwrap_or(0);
            let middle = leaves.split(first, end, direction, depth);
            let child = nodes.len();
            nodes[at].first = child as u32;
            for (from, to, upper) in [(first, middle, true), (middle, end, false)] {
                let tight = Bounds::around(&leaves.triangles[from..to], leaves.radius);
                let next = if to - from == 1 { Next::Triangle } else { Next::Children };
                let side = 2 * axis as u8 + u8::from(upper);
                nodes.push(Node { cut: tight.side(side), first: from as u32, side, next });
                open.push((
                    child + usize::from(!upper),
                    bounds.cut(side, tight.side(side)),
                    tight,
                    from,
                    to,
                    depth + 1,
                ));
            }
        }
        Self { nodes, all, leaves }
    }
}

impl Cuts {
    /// The box of a node from that of its parent.
    #[inline(always)]
    fn at(&self, mut node: u32, mut bounds: Bounds) -> At {
        loop {
            let Node { cut, first, side, next } = self.nodes[node as usize];
            bounds = bounds.cut(side, cut);
            if next != Next::Cut {
                return At { node, bounds };
            }
            node = first;
        }
    }
}

impl Hierarchy for Cuts {
    type Volume = Bounds;
    type At = At;

    #[inline(always)]
    fn root(&self) -> At {
        self.at(0, self.all)
    }

    #[inline(always)]
    fn volume<'s>(&'s self, at: &'s At) -> &'s Bounds {
        &at.bounds
    }

    #[inline(always)]
    fn is_leaf(&self, at: &At) -> bool {
        self.nodes[at.node as usize].next == Next::Triangle
    }

    #[inline(always)]
    fn children(&self, at: &At) -> [At; 2] {
        let first = self.nodes[at.node as usize].first;
        [self.at(first, at.bounds), self.at(first + 1, at.bounds)]
    }

    #[inline(always)]
    fn triangle(&self, at: &At) -> usize {
        self.nodes[at.node as usize].first as usize
    }

    fn leaves(&self) -> &Leaves {
        &self.leaves
    }
}
