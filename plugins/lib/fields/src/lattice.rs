//! Points in regular rows around an object, and which of them lie inside.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, cross, norm_1, sub};
use opencollbench_plugin::Mesh;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: Vector,
    /// The largest.
    pub max: Vector,
}

impl Bounds {
    /// Around nothing.
    pub const NONE: Self = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };

    /// Around all triangles of a mesh.
    pub fn of(mesh: &Mesh<'_>) -> Self {
        let corners = mesh.triangles.iter().flatten().map(|&vertex| mesh.positions[vertex as usize]);
        corners.fold(Self::NONE, Self::with)
    }

    /// Around a point, too.
    pub fn with(self, p: Vector) -> Self {
        Self {
            min: core::array::from_fn(|i| self.min[i].min(p[i])),
            max: core::array::from_fn(|i| self.max[i].max(p[i])),
        }
    }

    /// The lengths of the sides.
    pub fn sides(&self) -> Vector {
        sub(self.max, self.min)
    }

    /// The axis of the longest side.
    pub fn longest_axis(&self) -> usize {
        let side = self.sides();
        (0..3).max_by(|&i, &j| side[i].total_cmp(&side[j])).unwrap_or(0)
    }

    /// The length of the longest side.
    pub fn longest_side(&self) -> f64 {
        self.sides()[self.longest_axis()]
    }

    /// The nearest point of the box.
    pub fn clamp(&self, p: Vector) -> Vector {
        core::array::from_fn(|i| p[i].max(self.min[i]).min(self.max[i]))
    }

    /// The squared distance of a point from the box; 0 inside.
    pub fn squared_distance(&self, p: Vector) -> f64 {
        let gap = |i: usize| (self.min[i] - p[i]).max(p[i] - self.max[i]).max(0.0);
        gap(0).powi(2) + gap(1).powi(2) + gap(2).powi(2)
    }
}

/// Nodes at equal distances along the three axes.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// The first node.
    pub origin: Vector,
    /// From one node to the next.
    pub spacing: f64,
    /// How many along each axis; at least two.
    pub nodes: [usize; 3],
}

impl Lattice {
    /// The lattice of this spacing that reaches over `bounds` by `margin` on every side, and by up to a spacing more.
    pub fn around(bounds: &Bounds, margin: f64, spacing: f64) -> Self {
        let nodes = bounds.sides().map(|side| ((side + 2.0 * margin) / spacing).ceil() as usize + 1);
        let nodes = nodes.map(|n| n.max(2));
        let middle = |i: usize| 0.5 * (bounds.min[i] + bounds.max[i]);
        let origin = core::array::from_fn(|i| middle(i) - 0.5 * spacing * (nodes[i] - 1) as f64);
        Self { origin, spacing, nodes }
    }

    /// How many nodes it has.
    pub fn count(&self) -> usize {
        self.nodes.iter().product()
    }

    /// The place of a node in an array of all nodes: along the first axis they follow each other.
    #[inline(always)]
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.nodes[1] + j) * self.nodes[0] + i
    }

    /// Where a node is.
    #[inline(always)]
    pub fn node(&self, at: [usize; 3]) -> Vector {
        core::array::from_fn(|i| self.origin[i] + self.spacing * at[i] as f64)
    }

    /// All nodes, in the order of [`Self::index`].
    pub fn each(&self) -> impl Iterator<Item = [usize; 3]> {
        let [x, y, z] = self.nodes;
        (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
    }

    /// The box of all nodes.
    pub fn bounds(&self) -> Bounds {
        Bounds { min: self.origin, max: self.node(self.nodes.map(|n| n - 1)) }
    }

    /// The nodes of an axis between two coordinates.
    pub fn between(&self, axis: usize, from: f64, to: f64) -> core::ops::Range<usize> {
        let first = ((from - self.origin[axis]) / self.spacing).ceil().max(0.0) as usize;
        let last = ((to - self.origin[axis]) / self.spacing).floor();
        if last < 0.0 { 0..0 } else { first..(last as usize + 1).min(self.nodes[axis]) }
    }
}

/// For each node of the lattice: does it lie inside the closed mesh?
pub fn inside(mesh: &Mesh<'_>, lattice: &Lattice) -> Vec<bool> {
    let mut flips = vec![false; lattice.count()];
    for triangle in 0..mesh.triangles.len() {
        let t = mesh.corners(triangle);
        let range = |axis: usize| {
            let (low, high) = (t[0][axis].min(t[1][axis]).min(t[2][axis]), t[0][axis].max(t[1][axis]).max(t[2][axis]));
            // A little wider, so that rounding leaves no line out for one of two triangles; `covers` decides.
            lattice.between(axis, low - 1e-6 * lattice.spacing, high + 1e-6 * lattice.spacing)
        };
        for k in range(2) {
            for j in range(1) {
                let line = lattice.node([0, j, k]);
                if covers(&t, line) {
                    let behind = (crossing(&t, line) - lattice.origin[0]) / lattice.spacing;
                    let first = (behind.floor() + 1.0).max(0.0) as usize;
                    if first < lattice.nodes[0] {
                        flips[lattice.index([first, j, k])] ^= true;
                    }
                }
            }
        }
    }
    for row in flips.chunks_mut(lattice.nodes[0]) {
        let mut within = false;
        row.iter_mut().for_each(|node| {
            within ^= *node;
            *node = within;
        });
    }
    flips
}

/// Does the triangle cover the line along the first axis? Even-odd, so that the number of triangles of a closed mesh that
/// cover a line is even, whatever it touches: an edge decides the same for all of its triangles.
fn covers(t: &Triangle, line: Vector) -> bool {
    let passes = |p: Vector, q: Vector| {
        let (p, q) = if p < q { (p, q) } else { (q, p) };
        if (p[1] > line[1]) == (q[1] > line[1]) {
            return false;
        }
        p[2] + (line[1] - p[1]) * (q[2] - p[2]) / (q[1] - p[1]) > line[2]
    };
    passes(t[0], t[1]) ^ passes(t[1], t[2]) ^ passes(t[2], t[0])
}

/// Where the line crosses the triangle, along the first axis.
fn crossing(t: &Triangle, line: Vector) -> f64 {
    let normal = cross(sub(t[1], t[0]), sub(t[2], t[0]));
    let (low, high) = (t[0][0].min(t[1][0]).min(t[2][0]), t[0][0].max(t[1][0]).max(t[2][0]));
    let rise = normal[1] * (line[1] - t[0][1]) + normal[2] * (line[2] - t[0][2]);
    // A triangle seen edge-on is crossed somewhere in its extent.
    if normal[0].abs() <= f64::EPSILON * norm_1(normal) { low } else { (t[0][0] - rise / normal[0]).clamp(low, high) }
}
