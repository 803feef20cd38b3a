//! Filling a closed object with spheres of many sizes.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use ocb_fields::{Ball, Bounds, Lattice, Nearest, inside};
use ocb_triangles::vector::{dot, sub};
use opencollbench_plugin::Mesh;

/// Nodes inside the object per sphere: middles to choose from. More fill little better and cost in proportion.
const NODES_PER_SPHERE: f64 = 24.0;
/// Nodes along the longest side of the lattice that finds out how much of the box the object fills.
const COARSE: f64 = 48.0;
/// The finest lattice, in nodes: its two arrays take 5 bytes per node.
const MOST_NODES: f64 = 16e6;
/// How much a clearance in single precision may be rounded up.
const ROUNDED: f64 = 1.0 - 1e-6;

/// A node and the radius that a sphere around it may have.
#[derive(PartialEq)]
struct Candidate {
    clearance: f32,
    node: [u32; 3],
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.clearance.total_cmp(&other.clearance).then_with(|| other.node.cmp(&self.node))
    }
}

/// At most `count` spheres that lie inside the closed mesh and do not overlap: always the largest that is left, with its
/// middle on a node of a lattice.
pub fn pack(mesh: &Mesh<'_>, count: usize) -> Vec<Ball> {
    let lattice = lattice(mesh, count);
    let within = inside(mesh, &lattice);
    let nearest = Nearest::new(mesh);
    let mut near = 0;
    let mut clearances = vec![f32::NEG_INFINITY; lattice.count()];
    let mut candidates = Vec::new();
    for (at, within) in lattice.each().zip(within) {
        if within {
            let clearance = (nearest.distance(lattice.node(at), 0.0, &mut near) * ROUNDED) as f32;
            clearances[lattice.index(at)] = clearance;
            candidates.push(Candidate { clearance, node: at.map(|i| i as u32) });
        }
    }
    let mut candidates = BinaryHeap::from(candidates);
    let mut spheres = Vec::new();
    while let Some(best) = candidates.pop() {
        let at = best.node.map(|i| i as usize);
        let clearance = clearances[lattice.index(at)];
        if clearance < best.clearance {
            // A sphere has come near since; nobody's turn comes with less than nothing.
            if clearance > 0.0 {
                candidates.push(Candidate { clearance, ..best });
            }
            continue;
        }
        let sphere = Ball { center: lattice.node(at), radius: f64::from(clearance) * ROUNDED };
        spheres.push(sphere);
        if spheres.len() == count {
            break;
        }
        narrow(&lattice, &mut clearances, &sphere);
    }
    spheres
}

/// Takes the room of a sphere from the clearances around it. No clearance is larger than its radius, as it was the largest.
fn narrow(lattice: &Lattice, clearances: &mut [f32], sphere: &Ball) {
    let range = |axis: usize| {
        let (middle, reach) = (sphere.center[axis], 2.0 * sphere.radius / ROUNDED + lattice.spacing * 1e-6);
        lattice.between(axis, middle - reach, middle + reach)
    };
    for k in range(2) {
        for j in range(1) {
            for i in range(0) {
                let to = sub(lattice.node([i, j, k]), sphere.center);
                let clearance = &mut clearances[lattice.index([i, j, k])];
                *clearance = clearance.min(((dot(to, to).sqrt() - sphere.radius) * ROUNDED) as f32);
            }
        }
    }
}

/// So fine that the object has its share of nodes for each sphere.
fn lattice(mesh: &Mesh<'_>, count: usize) -> Lattice {
    let bounds = Bounds::of(mesh);
    let coarse = Lattice::around(&bounds, 0.0, bounds.longest_side() / COARSE);
    let within = inside(mesh, &coarse).into_iter().filter(|within| *within).count();
    let volume = within.max(1) as f64 * coarse.spacing.powi(3);
    let wanted = (volume / (NODES_PER_SPHERE * count as f64)).cbrt();
    let whole: f64 = coarse.count() as f64 * coarse.spacing.powi(3);
    Lattice::around(&bounds, 0.0, wanted.max((whole / MOST_NODES).cbrt()))
}
