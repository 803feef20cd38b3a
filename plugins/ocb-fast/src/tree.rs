//! A mesh as ocb-fast keeps it: oriented boxes, four to a node, and triangles, four to a leaf.

use ocb_triangles::Triangle;
use ocb_triangles::vector::Vector;
use opencollbench_plugin::Mesh;

use crate::build;

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
///
/// The nodes' coordinates are relative to `origin` and in a `unit` that brings all of them into [-1, 1]. What is exact is
/// done with the mesh itself.
#[derive(Debug)]
pub struct Tree {
    pub nodes: Vec<Node>,
    pub root: Link,
    /// In the object's coordinates.
    pub origin: Vector,
    /// A power of two.
    pub unit: f64,
    /// The length of the longest vector to a corner or the middle of a box, in the unit.
    pub radius: f64,
    positions: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
}

impl Tree {
    /// Builds the hierarchy; the mesh has triangles.
    pub fn new(mesh: &Mesh<'_>) -> Self {
        let corners = || mesh.triangles.iter().flatten().map(|&vertex| mesh.positions[vertex as usize]);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in corners() {
            for axis in 0..3 {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
        }
        // Halved before they are added, so that nothing overflows.
        let origin: Vector = core::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let extent = (0..3).map(|axis| 0.5 * high[axis] - 0.5 * low[axis]).fold(0.0, f64::max);
        let unit = power_of_two_above(extent);
        let local: Vec<Triangle> = (0..mesh.triangles.len())
            .map(|id| mesh.corners(id).map(|corner| core::array::from_fn(|i| (corner[i] - origin[i]) / unit)))
            .collect();
        let (nodes, root, radius) = build::build(&local);
        let (positions, triangles) = (mesh.positions.to_vec(), mesh.triangles.to_vec());
        Self { nodes, root, origin, unit, radius, positions, triangles }
    }

    #[inline(always)]
    pub fn node(&self, link: Link) -> &Node {
        &self.nodes[link.index()]
    }

    /// The corners of a triangle as they were given.
    #[inline(always)]
    pub fn triangle(&self, id: u32) -> Triangle {
        self.triangles[id as usize].map(|vertex| self.positions[vertex as usize])
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.positions) + size_of_val(&*self.triangles)
    }
}

/// A power of two not below `x`, which is not negative; 1 for 0.
fn power_of_two_above(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    // Subnormal sizes count as the smallest normal one.
    let exponent = ((x.max(f64::MIN_POSITIVE).to_bits() >> 52) as i32 - 1023 + 1).clamp(-1021, 1023);
    2f64.powi(exponent)
}
