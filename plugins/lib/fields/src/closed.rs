//! Is a mesh closed?

use std::collections::HashMap;

use opencollbench_plugin::Mesh;

/// How many edges belong to an odd number of triangles; 0 for a closed mesh.
pub fn odd_edges(mesh: &Mesh<'_>) -> usize {
    let mut first = HashMap::new();
    // 0.0 + -0.0 is 0.0: one place, one vertex.
    let place = |p: &[f64; 3]| p.map(|x| (x + 0.0).to_bits());
    let vertices: Vec<u32> =
        mesh.positions.iter().enumerate().map(|(i, p)| *first.entry(place(p)).or_insert(i as u32)).collect();
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for triangle in mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
        edges.extend([(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to))));
    }
    edges.retain(|(from, to)| from != to);
    edges.sort_unstable();
    edges.chunk_by(|one, other| one == other).filter(|same| same.len() % 2 == 1).count()
}
