//! The culling hierarchy of oracle and sampling: oriented boxes, eight to a node, in f32 with bounds widened outward.
//!
//! A box in the tree certainly contains its triangles, and a distance reported by `Frame` is certainly a lower bound:
//! every rounding of f32, every deviation of a pose from a rotation and the size of the numbers is paid for by one
//! `slack` that is computed per configuration and subtracted. So culling can cost time, never an answer.
//!
//! Coordinates inside a tree are relative to the centre of the object's bounding box and scaled by a power of two into
//! [-1, 1]; an object far from the origin, or a thousand times smaller than its partner, loses nothing.

mod best_first;
mod bounds;
mod build;
mod frame;
mod leaf;
mod obb;
mod probe;
mod reach;
mod wide_node;

pub(crate) use best_first::BestFirst;
pub(crate) use frame::Frame;
pub(crate) use wide_node::Slot;

use nalgebra::{Point3, Vector3};
use wide_node::{Single, WideNode};

/// A hierarchy over the triangles of one object.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Node 0 holds the root box alone.
    nodes: Vec<WideNode>,
    /// The same boxes one by one, for the other side of a test: a slot's box lies in one cache line.
    boxes: Vec<Single>,
    /// Where the tree's coordinates have their origin, in the object's own.
    origin: Point3<f64>,
    /// Tree coordinates times this power of two are lengths of the object.
    unit: f64,
}

impl Tree {
    /// Builds the hierarchy; positions must be finite.
    pub(crate) fn new(positions: &[Point3<f64>], triangles: &[[u32; 3]]) -> Self {
        let (lo, hi) = triangles
            .iter()
            .flatten()
            .fold((Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)), |(lo, hi), &v| {
                (lo.inf(&positions[v as usize].coords), hi.sup(&positions[v as usize].coords))
            });
        let origin = Point3::from(lo * 0.5 + hi * 0.5);
        let extent = (hi * 0.5 - lo * 0.5).amax();
        let unit = power_of_two_above(extent);
        let local: Vec<[Vector3<f64>; 3]> =
            triangles.iter().map(|t| t.map(|v| (positions[v as usize] - origin) / unit)).collect();
        let nodes = build::build(&local);
        let boxes = nodes.iter().flat_map(WideNode::singles).collect();
        Self { nodes, boxes, origin, unit }
    }

    /// The one box around everything.
    pub(crate) fn root(&self) -> Slot {
        Slot::ROOT
    }

    /// The triangle in a slot, if it holds one and no further node.
    pub(crate) fn triangle(&self, slot: Slot) -> Option<u32> {
        self.nodes[slot.node()].triangle(slot.lane())
    }
}

/// A power of two not below `x`, which is not negative; 1 for 0.
pub(crate) fn power_of_two_above(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    // Subnormal sizes count as the smallest normal one.
    let exponent = ((x.max(f64::MIN_POSITIVE).to_bits() >> 52) as i32 - 1023 + 1).clamp(-1021, 1023);
    2f64.powi(exponent)
}
