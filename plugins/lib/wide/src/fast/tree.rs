//! A mesh as ocb-fast keeps it: oriented boxes, four to a node, and triangles, four to a leaf.

use opencollbench_plugin::Mesh;

use super::build;
use crate::Local;

/// Children of a node, triangles of a leaf. Four of one object against four of the other fill the lanes.
pub const FOUR: usize = 4;

/// An inner node or a leaf; which one, whoever refers to it knows. Four cache lines.
///
/// The children of an inner node have four vectors: the middle of their box and its three axes; `half[k][i]` is half of the side along axis `k`. The triangles of a leaf
/// have three, their corners; the fourth places hold middle and axes of the leaf's own box, and `half[0]` its half sides.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub vectors: Vectors,
    pub half: [[f32; 4]; 3],
    /// Inner node: [`Link`]s. Leaf: ids of triangles. Lanes that nobody needs repeat the first one.
    pub children: [u32; 4],
}

impl Node {
    pub const EMPTY: Self = Self { vectors: [[0.0; 16]; 3], half: [[0.0; 4]; 3], children: [0; 4] };
}

/// `[axis][4 k + i]` is a coordinate of vector `k` of child `i`.
pub type Vectors = [[f32; 16]; 3];

/// A coordinate of vector `k` of the four children.
#[inline(always)]
pub fn row(vectors: &Vectors, axis: usize, k: usize) -> &[f32; 4] {
    &vectors[axis].as_chunks().0[k]
}

/// Where a node is, whether it is a leaf, and how many children or triangles it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link(pub u32);

impl Link {
    const LEAF: u32 = 1 << 31;

    pub fn new(index: usize, count: usize, leaf: bool) -> Self {
        debug_assert!((1..=FOUR).contains(&count) && index < 1 << 29);
        Self(index as u32 | (count as u32 - 1) << 29 | if leaf { Self::LEAF } else { 0 })
    }

    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & ((1 << 29) - 1)) as usize
    }

    #[inline(always)]
    pub fn count(self) -> usize {
        (self.0 >> 29 & 3) as usize + 1
    }

    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }
}

/// A hierarchy over the triangles of one object.
#[derive(Debug)]
pub struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) root: Link,
    /// The length of the longest vector to a corner or the middle of a box, in the unit.
    pub(super) radius: f64,
    pub(super) local: Local,
}

impl Tree {
    /// Builds the hierarchy; the mesh has triangles.
    pub(super) fn new(mesh: &Mesh<'_>) -> Self {
        let (local, triangles) = Local::new(mesh);
        let (nodes, root, radius) = build::build(&triangles);
        Self { nodes, root, radius, local }
    }

    #[inline(always)]
    pub(super) fn node(&self, link: Link) -> &Node {
        &self.nodes[link.index()]
    }

    /// The mesh.
    pub fn mesh(&self) -> &Local {
        &self.local
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + self.local.bytes()
    }
}
