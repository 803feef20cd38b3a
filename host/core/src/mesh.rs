//! Triangles over shared vertices.

use nalgebra::Point3;

/// A polygon soup: triangles over shared vertices; nothing is assumed about connectivity or closedness.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Vertex coordinates.
    pub fn positions(&self) -> &[Point3<f64>] {
        &self.positions
    }

    /// Vertex indices per triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
}
