//! A mesh in its own unit, around its own middle: neither unit nor place of the world matters to single precision then.

use ocb_triangles::vector::{Vector, add, norm_1, rotate, sub};
use ocb_triangles::{Frame, Triangle};
use opencollbench_plugin::Mesh;

/// What every hierarchy keeps of a mesh besides its nodes, whose coordinates are relative to `origin` and in a `unit` that
/// brings all of them into [-1, 1]. What is exact is done with the mesh itself.
#[derive(Debug)]
pub struct Local {
    /// In the object's coordinates.
    pub(crate) origin: Vector,
    /// A power of two.
    pub(crate) unit: f64,
    /// Its inverse, exactly: as good as a division, and sooner.
    per_unit: f64,
    positions: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
}

impl Local {
    /// A mesh that has triangles, and these in the local coordinates.
    pub fn new(mesh: &Mesh<'_>) -> (Self, Vec<Triangle>) {
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
        let per_unit = 1.0 / unit;
        let local = (0..mesh.triangles.len())
            .map(|id| mesh.corners(id).map(|corner| core::array::from_fn(|i| (corner[i] - origin[i]) * per_unit)))
            .collect();
        (Self { origin, unit, per_unit, positions: mesh.positions.to_vec(), triangles: mesh.triangles.to_vec() }, local)
    }

    /// The corners of a triangle as they were given.
    #[inline(always)]
    pub fn triangle(&self, id: u32) -> Triangle {
        self.triangles[id as usize].map(|vertex| self.positions[vertex as usize])
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.positions) + size_of_val(&*self.triangles)
    }
}

/// Where the middle and the unit of B lie in those of A.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    /// From the middle of A to that of B, in directions of the world and in A's unit.
    pub middles: Vector,
    /// B's unit in A's; a power of two.
    pub scale: f64,
    /// What was rounded in double precision on the way, in A's unit: offsets and places of the middles.
    pub lengths: f64,
}

/// Units that differ by more than this factor have no placement in single precision.
const MOST_RATIO: f64 = (1u64 << 40) as f64;

impl Between {
    /// For objects in their poses.
    #[inline(always)]
    pub fn new(frame: &Frame, a: &Local, b: &Local) -> Self {
        let (origin_a, origin_b) = (rotate(&frame.rotation_a, a.origin), rotate(&frame.rotation_b, b.origin));
        let [x, y, z] = sub(add(frame.offset, origin_b), origin_a);
        let lengths = (norm_1(frame.offset) + norm_1(a.origin) + norm_1(b.origin)) * a.per_unit;
        Self { middles: [x * a.per_unit, y * a.per_unit, z * a.per_unit], scale: b.unit * a.per_unit, lengths }
    }

    /// Whether single precision has numbers for objects of these units that reach so far; false for a NaN.
    #[inline(always)]
    pub fn is_in_range(&self, reach: f64) -> bool {
        self.scale < MOST_RATIO && self.scale > 1.0 / MOST_RATIO && reach < MOST_RATIO
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
