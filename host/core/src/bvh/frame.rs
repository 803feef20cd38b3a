//! Two trees in one configuration: where the boxes stand to each other, and lower bounds of their distance.

use nalgebra::{Matrix3, Vector3};
use wide::f32x8;

use super::leaf::{Leaf, Motion};
use super::obb::Obb;
use super::wide_node::{LANES, Projections, Slot, WideNode};
use super::{Tree, power_of_two_above};
use crate::pose::Pose;

/// Poses further than this from a rotation (largest entry of `M^T M - 1`) have no frame.
const MOST_DEVIATION: f64 = 1e-6;

/// Two trees and where one stands seen from the other.
///
/// Lengths are in the frame's `unit`, a power of two that brings all numbers below 4.
#[derive(Clone, Debug)]
pub(crate) struct Frame<'t> {
    a: &'t Tree,
    b: &'t Tree,
    /// Tree coordinates times this are lengths in the unit; powers of two, at most 1.
    pub(super) scale_a: f32,
    pub(super) scale_b: f32,
    /// From B's coordinates to A's: `rotation * x + translation`.
    rotation: [[f32; 3]; 3],
    translation: [f32; 3],
    /// One unit in the objects' lengths.
    pub(crate) unit: f64,
    /// What all roundings together may add to a lower bound, generously.
    pub(super) slack: f32,
}

/// B moves in a straight line; positions are told by the way it has gone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// Velocity of B in A's frame; a unit vector.
    in_a: [f32; 3],
    /// The same in B's frame.
    in_b: [f32; 3],
    /// The distance that is looked for.
    target: f32,
}

impl<'t> Frame<'t> {
    /// `None` when a pose is so far from a rotation that the trees' frames mean nothing.
    ///
    /// `size` bounds the absolute coordinates of both mapped objects.
    pub(crate) fn new(a: &'t Tree, pose_a: &Pose, b: &'t Tree, pose_b: &Pose, size: f64) -> Option<Self> {
        let deviation = deviation(&pose_a.linear).max(deviation(&pose_b.linear));
        if deviation > MOST_DEVIATION {
            return None;
        }
        let between = pose_b.apply(&b.origin) - pose_a.apply(&a.origin);
        let translation = pose_a.linear.transpose() * between;
        let rotation = pose_a.linear.transpose() * pose_b.linear;
        let unit = a.unit.max(b.unit).max(power_of_two_above(translation.amax()));
        let (scale_a, scale_b) = (a.unit / unit, b.unit / unit);
        let translation = translation / unit;
        // Every box is computed from these lengths in a few dozen operations; 64 roundings are more than all of them.
        let lengths = 1.75 * (scale_a + scale_b) + translation.norm();
        let single = f64::from(f32::EPSILON) / 2.0;
        let double = f64::EPSILON / 2.0;
        let slack = 64.0 * single * lengths + 16.0 * deviation * lengths + 64.0 * double * (size / unit);
        Some(Self {
            a,
            b,
            scale_a: scale_a as f32,
            scale_b: scale_b as f32,
            rotation: std::array::from_fn(|i| std::array::from_fn(|k| rotation[(i, k)] as f32)),
            translation: [translation.x as f32, translation.y as f32, translation.z as f32],
            unit,
            slack: (slack as f32).next_up(),
        })
    }

    /// A straight motion of B in the world; `target` is the distance looked for, in units.
    pub(crate) fn aim(&self, pose_a: &Pose, pose_b: &Pose, direction: &Vector3<f64>, target: f64) -> Aim {
        let seen = |m: &Matrix3<f64>| {
            let v = m.transpose() * direction;
            [v.x as f32, v.y as f32, v.z as f32]
        };
        Aim { in_a: seen(&pose_a.linear), in_b: seen(&pose_b.linear), target: (target as f32).next_up() }
    }

    /// The slots of both roots.
    pub(crate) fn roots(&self) -> (Slot, Slot) {
        (self.a.root(), self.b.root())
    }

    /// Both slots' triangles, when both hold one.
    pub(crate) fn triangles(&self, a: Slot, b: Slot) -> Option<[u32; 2]> {
        Some([self.a.triangle(a)?, self.b.triangle(b)?])
    }

    /// Two triangles that are probably near each other.
    pub(crate) fn nearby(&self) -> Option<[u32; 2]> {
        self.descend(|a, b, visit| self.expand(a, b, visit)).map(|(_, pair)| pair)
    }

    /// Two triangles that probably come within the target early, and a lower bound of the way after which they do.
    pub(crate) fn nearby_along(&self, aim: &Aim) -> Option<(f32, [u32; 2])> {
        self.descend(|a, b, visit| self.expand_along(aim, a, b, visit))
    }

    /// From the roots down, always to the pair with the smallest bound.
    fn descend(&self, expand: impl Fn(Slot, Slot, &mut dyn FnMut(Slot, Slot, f32))) -> Option<(f32, [u32; 2])> {
        let (mut a, mut b) = self.roots();
        let mut least = 0.0;
        loop {
            if let Some(pair) = self.triangles(a, b) {
                return Some((least, pair));
            }
            let mut best: Option<(f32, Slot, Slot)> = None;
            expand(a, b, &mut |a, b, bound| {
                if best.is_none_or(|(least, ..)| bound < least) {
                    best = Some((bound, a, b));
                }
            });
            (least, a, b) = best?;
        }
    }

    /// Opens the larger of two boxes; for each child paired with the other box: a certain lower bound of their distance
    /// in units.
    pub(crate) fn expand(&self, a: Slot, b: Slot, mut visit: impl FnMut(Slot, Slot, f32)) {
        self.open(a, b, |node, number, opened_a, projections| {
            let mut bounds = self.distance_bounds(projections);
            if let Some((leaf, other, scale)) = self.corners(node, a, b, opened_a) {
                bounds = bounds.max(self.certain(leaf.distances(&other, scale)));
            }
            let bounds = bounds.to_array();
            for (lane, &bound) in bounds.iter().enumerate().take(node.len()) {
                let child = Slot::new(number, lane);
                let (a, b) = if opened_a { (child, b) } else { (a, child) };
                visit(a, b, bound);
            }
        });
    }

    /// The same for B moving along a ray: a certain lower bound of the way after which they are within the target
    /// distance; children that never are, are not visited.
    pub(crate) fn expand_along(&self, aim: &Aim, a: Slot, b: Slot, mut visit: impl FnMut(Slot, Slot, f32)) {
        let other = |opened_a: bool| if opened_a { self.b_seen_from_a(b) } else { self.a_seen_from_b(a) };
        self.open(a, b, |node, number, opened_a, projections| {
            // Relative velocity of the opened node's boxes against the other box.
            let velocity = if opened_a { aim.in_a.map(|v| -v) } else { aim.in_b };
            let axes = other(opened_a).axes;
            let speeds = axes.map(|axis| f32x8::splat((0..3).map(|k| axis[k] * velocity[k]).sum()));
            let own_speeds = node.along(&velocity);
            let (mut enter, leave) = self.way_bounds(projections, &speeds, &own_speeds, &velocity, aim.target);
            if let Some((leaf, other, scale)) = self.corners(node, a, b, opened_a) {
                let motion = Motion { velocity, within: self.within(aim.target) };
                enter = leaf.ways(&other, scale, &motion, enter);
            }
            let (enter, leave) = (enter.to_array(), leave.to_array());
            for lane in 0..node.len() {
                if enter[lane] <= leave[lane] {
                    let child = Slot::new(number, lane);
                    let (a, b) = if opened_a { (child, b) } else { (a, child) };
                    visit(a, b, enter[lane]);
                }
            }
        });
    }

    fn open(&self, a: Slot, b: Slot, visit: impl FnOnce(&WideNode, u32, bool, &Projections)) {
        let (node_a, node_b) = (&self.a.nodes[a.node()], &self.b.nodes[b.node()]);
        let open_a = match (self.a.triangle(a), self.b.triangle(b)) {
            (Some(_), None) => false,
            (None, Some(_)) => true,
            (None, None) => {
                self.a.boxes[a.number()].size * self.scale_a >= self.b.boxes[b.number()].size * self.scale_b
            }
            (Some(_), Some(_)) => unreachable!("two triangles are compared, not opened"),
        };
        if open_a {
            let number = node_a.node(a.lane());
            let node = &self.a.nodes[number as usize];
            visit(node, number, true, &node.project(&self.b_seen_from_a(b), self.scale_a));
        } else {
            let number = node_b.node(b.lane());
            let node = &self.b.nodes[number as usize];
            visit(node, number, false, &node.project(&self.a_seen_from_b(a), self.scale_b));
        }
    }

    fn b_seen_from_a(&self, slot: Slot) -> Obb {
        let b = scaled(self.b.boxes[slot.number()].obb, self.scale_b);
        let r = &self.rotation;
        let turn =
            |x: &[f32; 3]| -> [f32; 3] { std::array::from_fn(|i| r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2]) };
        let c = turn(&b.centre);
        Obb {
            centre: std::array::from_fn(|i| c[i] + self.translation[i]),
            axes: b.axes.map(|x| turn(&x)),
            half: b.half,
        }
    }

    fn a_seen_from_b(&self, slot: Slot) -> Obb {
        let a = scaled(self.a.boxes[slot.number()].obb, self.scale_a);
        let r = &self.rotation;
        let turn =
            |x: &[f32; 3]| -> [f32; 3] { std::array::from_fn(|i| r[0][i] * x[0] + r[1][i] * x[1] + r[2][i] * x[2]) };
        let c: [f32; 3] = std::array::from_fn(|i| a.centre[i] - self.translation[i]);
        Obb { centre: turn(&c), axes: a.axes.map(|x| turn(&x)), half: a.half }
    }

    /// The corners of the opened node's triangles and those of the other slot's triangle in the same frame, when the node
    /// holds nothing but triangles and the other slot is one.
    fn corners<'n>(
        &self,
        node: &'n WideNode,
        a: Slot,
        b: Slot,
        opened_a: bool,
    ) -> Option<(&'n Leaf, [[f32; 3]; 3], f32)> {
        let leaf = node.leaf().filter(|_| (0..node.len()).all(|lane| node.triangle(lane).is_some()))?;
        let (tree, slot) = if opened_a { (self.b, b) } else { (self.a, a) };
        let home = &tree.nodes[slot.node()];
        home.triangle(slot.lane())?;
        let corners = home.leaf()?.get(slot.lane());
        let r = &self.rotation;
        Some(if opened_a {
            let seen = |x: [f32; 3]| -> [f32; 3] {
                let x = x.map(|x| x * self.scale_b);
                std::array::from_fn(|i| r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2] + self.translation[i])
            };
            (leaf, corners.map(seen), self.scale_a)
        } else {
            let seen = |x: [f32; 3]| -> [f32; 3] {
                let x: [f32; 3] = std::array::from_fn(|i| x[i] * self.scale_a - self.translation[i]);
                std::array::from_fn(|i| r[0][i] * x[0] + r[1][i] * x[1] + r[2][i] * x[2])
            };
            (leaf, corners.map(seen), self.scale_b)
        })
    }
}

fn scaled(b: Obb, scale: f32) -> Obb {
    Obb { centre: b.centre.map(|x| x * scale), axes: b.axes, half: b.half.map(|x| x * scale) }
}

/// Largest entry of `M^T M - 1`.
fn deviation(m: &Matrix3<f64>) -> f64 {
    let d = m.transpose() * m - Matrix3::identity();
    // `amax` of NaN entries would be silent.
    if d.iter().any(|x| x.is_nan()) { f64::INFINITY } else { d.amax() }
}

const _: () = assert!(LANES == 8, "f32x8 holds one node");
