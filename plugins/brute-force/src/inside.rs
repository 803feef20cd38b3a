//! Is a closed object inside another one? A ray from one of its corners crosses the other's surface an odd number of times.

use std::collections::HashMap;

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, cross, dot, norm_1, sub};
use opencollbench_plugin::{Answer, Mesh, Refusal};

/// Directions without meaning; a ray too close to an edge gives way to the next.
const DIRECTIONS: [Vector; 6] = [
    [0.9127, 0.3311, 0.2397],
    [-0.2713, 0.8642, 0.4239],
    [0.1873, -0.4921, 0.8502],
    [-0.5519, -0.6127, -0.5657],
    [0.6871, -0.2239, -0.6912],
    [-0.3307, 0.4421, -0.8338],
];
/// Below this share of the numbers it is computed from, a volume's sign is not believed.
const DOUBT: f64 = 1e-13;

/// One triangle of each part of the mesh that hangs together. Corners at the same place are one.
pub fn one_of_each_part(mesh: &Mesh<'_>) -> Vec<usize> {
    let mut first = HashMap::new();
    let key = |corner: &[f64; 3]| corner.map(|x| (x + 0.0).to_bits());
    let mut parent: Vec<usize> =
        mesh.positions.iter().enumerate().map(|(i, corner)| *first.entry(key(corner)).or_insert(i)).collect();
    for triangle in mesh.triangles {
        let [a, b, c] = triangle.map(|corner| root(&mut parent, corner as usize));
        parent[b] = a;
        let c = root(&mut parent, c);
        parent[c] = a;
    }
    let mut seen = vec![false; parent.len()];
    let is_new = |triangle: &usize| {
        let part = root(&mut parent, mesh.triangles[*triangle][0] as usize);
        !std::mem::replace(&mut seen[part], true)
    };
    (0..mesh.triangles.len()).filter(is_new).collect()
}

fn root(parent: &mut [usize], mut corner: usize) -> usize {
    while parent[corner] != corner {
        parent[corner] = parent[parent[corner]];
        corner = parent[corner];
    }
    corner
}

/// Is a point, which does not lie on the surface, inside?
pub fn encloses<'t>(surface: impl Iterator<Item = &'t Triangle> + Clone, point: Vector) -> Answer<bool> {
    let parity = |direction| surface.clone().try_fold(false, |odd, t| Some(odd ^ crosses(point, direction, t)?));
    DIRECTIONS.into_iter().find_map(parity).ok_or(Refusal::GaveUp)
}

/// Does the ray cross the triangle? `None` when it passes too close to an edge to tell.
fn crosses(start: Vector, direction: Vector, triangle: &Triangle) -> Option<bool> {
    let [a, b, c] = triangle.map(|corner| sub(corner, start));
    let sign = |p: Vector, q: Vector| {
        let volume = dot(direction, cross(p, q));
        let doubtful = volume.abs() <= DOUBT * norm_1(p) * norm_1(q);
        if doubtful { 0 } else { volume.signum() as i8 }
    };
    let sides = [sign(a, b), sign(b, c), sign(c, a)];
    if sides.contains(&1) && sides.contains(&-1) {
        return Some(false);
    }
    if sides.contains(&0) {
        return None;
    }
    // The line passes through; the triangle lies ahead when its plane does.
    let normal = cross(sub(b, a), sub(c, a));
    Some((dot(normal, a) > 0.0) == (dot(normal, direction) > 0.0))
}
