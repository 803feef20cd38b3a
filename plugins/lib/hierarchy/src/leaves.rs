//! The triangles of one object, in the order of the leaves.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add, dot};
use opencollbench_plugin::Mesh;

/// The triangles of a mesh.
#[derive(Debug)]
pub struct Leaves {
    /// Corners in the object's frame.
    pub triangles: Vec<Triangle>,
    /// Ids of `triangles`.
    pub ids: Vec<u32>,
    /// Length of the longest corner.
    pub radius: f64,
}

/// From here on triangles are halved in any order, so that no mesh makes a deep tree.
const DEEPEST: u32 = 64;

impl Leaves {
    /// In the order of the mesh.
    pub fn new(mesh: &Mesh<'_>) -> Self {
        let triangles: Vec<Triangle> = (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)).collect();
        let lengths = triangles.as_flattened().iter().map(|corner| dot(*corner, *corner).sqrt());
        let radius = lengths.fold(0.0, f64::max);
        let ids = (0..triangles.len() as u32).collect();
        Self { triangles, ids, radius }
    }

    /// Puts the triangles whose middles lie below the mean first, and says where the others begin: neither part is empty.
    pub fn split(&mut self, first: usize, end: usize, direction: Vector, depth: u32) -> usize {
        let along = |t: &Triangle| dot(direction, add(add(t[0], t[1]), t[2]));
        let mean = self.triangles[first..end].iter().map(along).sum::<f64>() / (end - first) as f64;
        let mut middle = first;
        for i in first..end {
            if along(&self.triangles[i]) < mean {
                self.triangles.swap(i, middle);
                self.ids.swap(i, middle);
                middle += 1;
            }
        }
        if depth >= DEEPEST || middle == first || middle == end { usize::midpoint(first, end) } else { middle }
    }
}
