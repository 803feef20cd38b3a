//! Points all over a surface.

use ocb_triangles::vector::{Vector, add, add_scaled, dot, sub};
use opencollbench_plugin::Mesh;

/// Points of the surface such that every point of it is within `reach` of one: the vertices, and where a triangle is larger
/// than that, points of its own.
pub fn cover(mesh: &Mesh<'_>, reach: f64) -> Vec<Vector> {
    let mut used = vec![false; mesh.positions.len()];
    mesh.triangles.iter().flatten().for_each(|&vertex| used[vertex as usize] = true);
    let vertices = mesh.positions.iter().zip(used).filter(|(_, used)| *used).map(|(&p, _)| p);
    let mut points: Vec<Vector> = vertices.collect();
    for triangle in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(triangle);
        let (u, v) = (sub(b, a), sub(c, a));
        let longest = [u, v, sub(c, b)].map(|edge| dot(edge, edge)).into_iter().fold(0.0, f64::max).sqrt();
        // Cut into n * n similar ones, each point is within longest / n / sqrt(3) of a corner of its part.
        let n = (longest / (3f64.sqrt() * reach)).ceil() as usize;
        for i in 0..=n {
            for j in 0..=n - i {
                let is_corner = [(0, 0), (n, 0), (0, n)].contains(&(i, j));
                if n > 1 && !is_corner {
                    let [s, t] = [i, j].map(|step| step as f64 / n as f64);
                    points.push(add(add_scaled(a, s, u), [v[0] * t, v[1] * t, v[2] * t]));
                }
            }
        }
    }
    points
}
