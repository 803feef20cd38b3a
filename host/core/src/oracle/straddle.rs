//! The second lower bound of the margin, for closed meshes.
//!
//! The margin of a pair of triangles is 0 when the crossing runs exactly through an edge that two coplanar triangles
//! share, although the meshes cross robustly (two cubes whose face diagonals meet). What survives is topology: when a
//! connected part of one object has a vertex strictly inside a closed other one and a vertex strictly outside, then the
//! part must cross the surface, and it does so as long as neither vertex can reach the surface: with every vertex moving
//! by at most `m`, as long as `2 m` is less than both distances.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use super::Shape;
use super::closest::closest;
use super::filter::certain_crossing;
use super::scene::Scene;
use super::triangle::Triangle;
use crate::pose::Pose;

/// Points times triangles that one bound may look at. The bound is needed for few configurations, but a set of touching
/// ones may consist of them.
const BUDGET: usize = 500_000;

/// A lower bound of the scene's margin, in units; 0 when neither object straddles the other.
pub(super) fn margin(scene: &Scene) -> f64 {
    let (a, b) = (scene.pair.a, scene.pair.b);
    let c = scene.configuration;
    straddles(scene, a, &c.pose_a, b, &c.pose_b).max(straddles(scene, b, &c.pose_b, a, &c.pose_a))
}

/// `part` against the closed surface of `solid`.
fn straddles(scene: &Scene, part: &Shape, pose_part: &Pose, solid: &Shape, pose_solid: &Pose) -> f64 {
    let welded = weld(solid);
    if !is_closed(&welded) {
        return 0.0;
    }
    let inverse = 1.0 / scene.unit;
    let surface: Vec<Triangle> =
        (0..solid.triangles().len() as u32).map(|t| Triangle::mapped(pose_solid, &solid.corners(t), inverse)).collect();
    let samples = (BUDGET / surface.len()).max(2);
    let mut best = 0.0f64;
    for component in components(part) {
        // Deepest inside and farthest outside among evenly chosen vertices.
        let (mut inside, mut outside) = (0.0f64, 0.0f64);
        for &vertex in component.iter().step_by(component.len().div_ceil(samples)) {
            let point = Triangle::mapped(pose_part, &[vertex; 3], inverse);
            let clearance = surface.iter().map(|t| closest(&point, t).lo).fold(f64::INFINITY, f64::min);
            if clearance <= inside.min(outside) {
                continue;
            }
            match is_inside(&point, &surface) {
                Some(true) => inside = inside.max(clearance),
                Some(false) => outside = outside.max(clearance),
                None => {}
            }
        }
        best = best.max(inside.min(outside) / 2.0 * (1.0 - 1e-14));
    }
    best
}

/// Parity of the crossings along a ray out of the scene; `None` when every ray tried comes too close to an edge.
fn is_inside(point: &Triangle, surface: &[Triangle]) -> Option<bool> {
    const DIRECTIONS: [[f64; 3]; 4] =
        [[0.9127, 0.3311, 0.2397], [-0.2713, 0.8642, 0.4239], [0.1873, -0.4921, 0.8502], [-0.5519, -0.6127, -0.5657]];
    let start = point.vertices[0];
    let reach = surface.iter().flat_map(|t| t.vertices).map(|v| (v - start).norm()).fold(0.0, f64::max);
    DIRECTIONS.iter().find_map(|&direction| {
        let end = start + Vector3::from(direction) * (4.0 * reach + 1.0);
        surface
            .iter()
            .try_fold(false, |inside, t| certain_crossing(&start, &end, point.error, t).map(|crosses| inside ^ crosses))
    })
}

/// Triangles over vertices that are one where their coordinates are the same; those that collapse are left out.
fn weld(shape: &Shape) -> Vec<[usize; 3]> {
    let mut number = HashMap::new();
    // Adding 0 makes -0 and 0 one key.
    let mut name = |p: &Point3<f64>| {
        let next = number.len();
        *number.entry([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).or_insert(next)
    };
    let corners = (0..shape.triangles().len() as u32).map(|t| shape.corners(t).each_ref().map(&mut name));
    corners.filter(|[a, b, c]| a != b && b != c && c != a).collect()
}

/// Does every edge belong to an even number of triangles? Then each point off the surface is inside or outside.
fn is_closed(triangles: &[[usize; 3]]) -> bool {
    let mut odd = HashMap::new();
    for t in triangles {
        for i in 0..3 {
            let (p, q) = (t[i], t[(i + 1) % 3]);
            *odd.entry((p.min(q), p.max(q))).or_insert(false) ^= true;
        }
    }
    !odd.is_empty() && odd.values().all(|odd| !odd)
}

/// The vertices of each connected part.
fn components(shape: &Shape) -> Vec<Vec<Point3<f64>>> {
    let mut parent: Vec<usize> = (0..shape.positions().len()).collect();
    fn root(parent: &mut [usize], mut v: usize) -> usize {
        while parent[v] != v {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        v
    }
    for t in shape.triangles() {
        for &v in &t[1..] {
            let (x, y) = (root(&mut parent, t[0] as usize), root(&mut parent, v as usize));
            parent[x] = y;
        }
    }
    let mut used = vec![false; parent.len()];
    shape.triangles().iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut parts: Vec<Vec<Point3<f64>>> = Vec::new();
    let mut part_of = HashMap::new();
    for v in (0..parent.len()).filter(|&v| used[v]) {
        let part = *part_of.entry(root(&mut parent, v)).or_insert_with(|| {
            parts.push(Vec::new());
            parts.len() - 1
        });
        parts[part].push(shape.positions()[v]);
    }
    parts
}
