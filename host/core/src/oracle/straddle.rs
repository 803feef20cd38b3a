//! The second lower bound of the margin, for closed meshes.
//!
//! The margin of a pair of triangles is 0 when the crossing runs exactly through an edge that two coplanar triangles
//! share, although the meshes cross robustly (two cubes whose face diagonals meet). What survives is topology: when a
//! connected part of one object has a vertex strictly inside a closed other one and a vertex strictly outside, then the
//! part must cross the surface, and it does so as long as neither vertex can reach the surface: with every vertex moving
//! by at most `m`, as long as `2 m` is less than both distances.

use super::Shape;
use super::inside::Solid;
use super::scene::Scene;
use crate::pose::Pose;

/// Vertices that are looked at: so many of those at contacts, where a shallow crossing is deepest, ...
const AT_CONTACTS: usize = 24;
/// ... and so many evenly chosen ones of each part, where a deep one is.
const ELSEWHERE: usize = 8;

/// A lower bound of the scene's margin, in units; 0 when neither object straddles the other. `contacts` are meeting
/// pairs of triangles.
pub(super) fn margin(scene: &Scene, contacts: &[[u32; 2]]) -> f64 {
    let (a, b) = (scene.pair.a, scene.pair.b);
    let c = scene.configuration;
    let at = |side: usize| contacts.iter().map(move |pair| pair[side]);
    let a_through_b = straddles(a, &c.pose_a, at(0), &Solid::new(scene, b, &c.pose_b), b);
    let b_through_a = straddles(b, &c.pose_b, at(1), &Solid::new(scene, a, &c.pose_a), a);
    a_through_b.max(b_through_a)
}

/// `part`, which meets the surface at the triangles `at`, against the surface of `solid`.
fn straddles(part: &Shape, pose: &Pose, at: impl Iterator<Item = u32>, solid: &Solid, shape: &Shape) -> f64 {
    if !shape.topology.closed {
        return 0.0;
    }
    let topology = &part.topology;
    let mut corners: Vec<u32> = at.flat_map(|t| part.triangles()[t as usize]).collect();
    corners.sort_unstable();
    corners.dedup();
    let mut parts: Vec<u32> = corners.iter().map(|&v| topology.component_of[v as usize]).collect();
    parts.sort_unstable();
    parts.dedup();
    let mut best = 0.0f64;
    for component in parts {
        let all = &topology.components[component as usize];
        let here: Vec<u32> =
            corners.iter().copied().filter(|&v| topology.component_of[v as usize] == component).collect();
        // Deepest inside and farthest outside.
        let (mut inside, mut outside) = (0.0f64, 0.0f64);
        for vertex in evenly(all, ELSEWHERE).chain(evenly(&here, AT_CONTACTS)) {
            let vertex = &part.positions()[vertex as usize];
            let clearance = solid.clearance(pose, vertex);
            if clearance <= inside.min(outside) {
                continue;
            }
            if solid.encloses(pose, vertex) {
                inside = inside.max(clearance);
            } else {
                outside = outside.max(clearance);
            }
        }
        best = best.max(inside.min(outside) / 2.0 * (1.0 - 1e-14));
    }
    best
}

fn evenly(all: &[u32], most: usize) -> impl Iterator<Item = u32> {
    all.iter().copied().step_by(all.len().div_ceil(most).max(1))
}
