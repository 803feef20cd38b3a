//! A closed surface of triangles, its vertices welded by position.

use std::collections::{HashMap, HashSet};

use ocb_triangles::vector::Vector;
use opencollbench_plugin::Mesh;

/// Triangles that close a surface: each edge belongs to exactly two of them.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The vertices that triangles use, each place once.
    pub points: Vec<Vector>,
    /// The triangles, wound either way.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The surface of a mesh.
    ///
    /// # Errors
    /// Why the mesh is not closed, as the end of a sentence.
    pub fn of(mesh: &Mesh<'_>) -> Result<Self, String> {
        let (mut points, mut numbers) = (Vec::new(), HashMap::new());
        let mut number = |vertex: u32| {
            let point = mesh.positions[vertex as usize];
            *numbers.entry(point.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                points.push(point);
                points.len() as u32 - 1
            })
        };
        let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.map(&mut number)).collect();
        closed(&triangles)?;
        Ok(Self { points, triangles })
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.triangles[triangle].map(|vertex| self.points[vertex as usize])
    }
}

/// Does each edge belong to two triangles, and is each triangle there once?
fn closed(triangles: &[[u32; 3]]) -> Result<(), String> {
    let edges = triangles.iter().flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut edges: Vec<_> = edges.map(|(from, to)| (from.min(to), from.max(to))).collect();
    edges.sort_unstable();
    if let Some(edge) = edges.chunk_by(|one, other| one == other).find(|same| same.len() != 2) {
        return Err(format!("an edge of this one belongs to {} triangles and not to 2", edge.len()));
    }
    let mut seen = HashSet::new();
    let again = triangles.iter().position(|&(mut triangle)| {
        triangle.sort_unstable();
        !seen.insert(triangle)
    });
    again.map_or(Ok(()), |triangle| Err(format!("triangle {triangle} of this one comes twice")))
}
