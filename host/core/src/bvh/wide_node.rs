//! Eight boxes side by side, tested at once against a ninth.

use nalgebra::Vector3;
use wide::f32x8;

use super::leaf::Leaf;
use super::obb::Obb;

/// Children per node.
pub(crate) const LANES: usize = 8;

/// Position of a box in the tree: node and lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u32);

impl Slot {
    pub(super) const ROOT: Slot = Slot(0);

    pub(super) fn number(self) -> usize {
        self.0 as usize
    }

    pub(super) fn new(node: u32, lane: usize) -> Self {
        Self(node * LANES as u32 + lane as u32)
    }

    pub(super) fn node(self) -> usize {
        self.0 as usize / LANES
    }

    pub(super) fn lane(self) -> usize {
        self.0 as usize % LANES
    }
}

/// What a lane holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Child {
    Node(u32),
    Triangle(u32),
}

/// Marks a triangle among the children's numbers; a mesh has fewer than 2^31 triangles.
const TRIANGLE: u32 = 1 << 31;

/// One box, aligned to a cache line.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Single {
    pub(super) obb: Obb,
    /// Half the diagonal is at most this.
    pub(super) size: f32,
}

#[derive(Clone, Debug)]
pub(super) struct WideNode {
    centre: [f32x8; 3],
    axes: [[f32x8; 3]; 3],
    half: [f32x8; 3],
    children: [u32; LANES],
    len: usize,
    /// Corners of the lanes that hold triangles; lanes that do not hold one are zero.
    leaf: Option<Box<Leaf>>,
}

/// Separation of the eight boxes from another one, all of them certain up to the frame's slack.
pub(super) struct Projections {
    /// Along the other box's axes: signed distance of centres, and the sum of both extents.
    pub(super) other: [(f32x8, f32x8); 3],
    /// Along the eight boxes' own axes.
    pub(super) own: [(f32x8, f32x8); 3],
    /// From the other box's centre to the eight boxes'.
    pub(super) centres: [f32x8; 3],
    /// Half extents of the other box, and of the eight.
    pub(super) half: [(f32x8, f32x8); 3],
}

impl Projections {
    /// Squared distance of the centres, and both boxes' extents along their line times that distance.
    pub(super) fn along_centres(&self) -> (f32x8, f32x8) {
        let d = &self.centres;
        let mut extent = f32x8::splat(0.0);
        for i in 0..3 {
            extent += self.other[i].0.abs() * self.half[i].0 + self.own[i].0.abs() * self.half[i].1;
        }
        (d[0] * d[0] + d[1] * d[1] + d[2] * d[2], extent)
    }
}

impl WideNode {
    pub(super) fn empty() -> Self {
        let zero = f32x8::splat(0.0);
        Self { centre: [zero; 3], axes: [[zero; 3]; 3], half: [zero; 3], children: [0; LANES], len: 0, leaf: None }
    }

    pub(super) fn set(&mut self, lane: usize, b: &Obb, content: Child) {
        let put = |field: &mut f32x8, value: f32| {
            let mut lanes = field.to_array();
            lanes[lane] = value;
            *field = f32x8::new(lanes);
        };
        for i in 0..3 {
            put(&mut self.centre[i], b.centre[i]);
            put(&mut self.half[i], b.half[i]);
            for k in 0..3 {
                put(&mut self.axes[i][k], b.axes[i][k]);
            }
        }
        self.children[lane] = match content {
            Child::Node(n) => n,
            Child::Triangle(t) => t | TRIANGLE,
        };
        self.len = self.len.max(lane + 1);
    }

    /// Remembers the corners of the triangle in a lane.
    pub(super) fn set_corners(&mut self, lane: usize, corners: &[Vector3<f64>; 3]) {
        self.leaf.get_or_insert_default().set(lane, corners);
    }

    /// The corners of the triangles, if a lane holds one.
    pub(super) fn leaf(&self) -> Option<&Leaf> {
        self.leaf.as_deref()
    }

    /// All lanes one by one; unused ones are empty boxes.
    pub(super) fn singles(&self) -> [Single; LANES] {
        std::array::from_fn(|lane| {
            let at = |field: &f32x8| field.as_array()[lane];
            let half = self.half.each_ref().map(at);
            let obb = Obb {
                centre: self.centre.each_ref().map(at),
                axes: self.axes.each_ref().map(|axis| axis.each_ref().map(at)),
                half,
            };
            Single { obb, size: half.iter().sum() }
        })
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn triangle(&self, lane: usize) -> Option<u32> {
        let child = self.children[lane];
        (child & TRIANGLE != 0).then_some(child & !TRIANGLE)
    }

    /// The node below a lane that holds no triangle.
    pub(super) fn node(&self, lane: usize) -> u32 {
        debug_assert!(self.triangle(lane).is_none());
        self.children[lane]
    }

    /// Projects the eight boxes (their coordinates times `scale`) and `other`, which is given in the same frame.
    pub(super) fn project(&self, other: &Obb, scale: f32) -> Projections {
        let scale = f32x8::splat(scale);
        let d: [f32x8; 3] = std::array::from_fn(|k| self.centre[k] * scale - f32x8::splat(other.centre[k]));
        let half: [f32x8; 3] = std::array::from_fn(|k| self.half[k] * scale);
        let axes = other.axes.map(|axis| axis.map(f32x8::splat));
        let reach = other.half.map(f32x8::splat);
        let dot = |x: &[f32x8; 3], y: &[f32x8; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let mut own_extent = half;
        let mut others = [(f32x8::splat(0.0), f32x8::splat(0.0)); 3];
        for i in 0..3 {
            let mut extent = reach[i];
            for j in 0..3 {
                let cosine = dot(&axes[i], &self.axes[j]).abs();
                extent += cosine * half[j];
                own_extent[j] += cosine * reach[i];
            }
            others[i] = (dot(&axes[i], &d), extent);
        }
        let own: [(f32x8, f32x8); 3] = std::array::from_fn(|j| (dot(&self.axes[j], &d), own_extent[j]));
        Projections { other: others, own, centres: d, half: std::array::from_fn(|i| (reach[i], half[i])) }
    }

    /// The eight boxes' own axes times a direction.
    pub(super) fn along(&self, direction: &[f32; 3]) -> [f32x8; 3] {
        let v = direction.map(f32x8::splat);
        self.axes.each_ref().map(|axis| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2])
    }
}
