//! Triangles over shared vertices: parsed at the door, never checked again.

mod aabb;
mod collada;
mod gltf;
pub mod obj;
mod off;
mod ply;
pub mod read;
mod stl;

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};
use sha2::{Digest, Sha256};

pub use aabb::Aabb;
pub use ply::write::write as write_ply;
pub use read::limits::MAX_BYTES;
pub use read::{FORMATS, FileFormat, LengthUnit, ReadError, ReadMesh, read};

/// Largest magnitude of a coordinate. Squared lengths stay finite up to here even in single precision, which is what
/// some algorithms compute in.
pub const MAX_COORDINATE: f64 = 1e18;

/// A polygon soup: triangles over shared vertices; nothing is assumed about connectivity or closedness.
///
/// Vertices and triangles keep the numbers of their file, because heatmaps, answers and downloads refer to them. So
/// unused vertices stay, and so do triangles without area: they are points or segments of the surface, counted by
/// [`Mesh::degenerate_triangles`] for a warning. Coordinates are in the object's own length unit and frame.
///
/// What [`Mesh::new`] has checked holds for every value of this type: finite coordinates of at most
/// [`MAX_COORDINATE`], indices in range, at least one triangle with area.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
    bounds: Aabb,
    degenerate_triangles: u32,
}

/// Why vertices and triangles are no mesh. Vertices and triangles are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// There is no triangle at all.
    #[error("the mesh has no triangles; it needs at least one")]
    NoTriangles,
    /// More vertices or triangles than 32-bit numbers can name.
    #[error("the mesh has more than {} vertices or triangles; reduce it", u32::MAX)]
    TooLarge,
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not a finite number; remove or repair that vertex")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A coordinate is too large to compute with.
    #[error("vertex {vertex} has a coordinate beyond {MAX_COORDINATE:e}; scale the object down")]
    TooFar {
        /// The vertex.
        vertex: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {index}, but the vertices are 0 to {}; correct the index", vertices.wrapping_sub(1))]
    IndexOutOfRange {
        /// The triangle.
        triangle: usize,
        /// The vertex number it holds.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Every triangle is a point or a segment.
    #[error("every triangle has zero area; the object needs at least one triangle with area")]
    NoArea,
}

impl Mesh {
    /// Checks everything that later code relies on.
    pub fn new(positions: Vec<Point3<f64>>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::NoTriangles);
        }
        if u32::try_from(positions.len()).is_err() || u32::try_from(triangles.len()).is_err() {
            return Err(MeshError::TooLarge);
        }
        for (vertex, p) in positions.iter().enumerate() {
            if !p.coords.iter().all(|x| x.is_finite()) {
                return Err(MeshError::NotFinite { vertex });
            }
            if p.coords.iter().any(|x| x.abs() > MAX_COORDINATE) {
                return Err(MeshError::TooFar { vertex });
            }
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&i| i as usize >= positions.len()) {
                return Err(MeshError::IndexOutOfRange { triangle, index, vertices: positions.len() });
            }
        }
        let degenerate = triangles.iter().filter(|t| !has_area(&t.map(|i| positions[i as usize]))).count();
        if degenerate == triangles.len() {
            return Err(MeshError::NoArea);
        }
        // Of the used vertices only: an unused one is no part of the surface.
        let used = triangles.iter().flatten().map(|&i| &positions[i as usize]);
        let bounds = Aabb::around(used).expect("there is a triangle");
        Ok(Self { positions, triangles, bounds, degenerate_triangles: degenerate as u32 })
    }

    /// Vertex coordinates.
    pub fn positions(&self) -> &[Point3<f64>] {
        &self.positions
    }

    /// Vertex indices per triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of a triangle. Panics when there is no such triangle.
    pub fn corners(&self, triangle: u32) -> [Point3<f64>; 3] {
        self.triangles[triangle as usize].map(|i| self.positions[i as usize])
    }

    /// The smallest axis-aligned box around the triangles (vertices that no triangle uses do not count).
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// L, the longest side of the bounding box: the unit of relative distances. Always positive.
    pub fn longest_side(&self) -> f64 {
        self.bounds.sides().max()
    }

    /// How many triangles have zero area as double precision computes it. They are part of the surface all the same.
    pub fn degenerate_triangles(&self) -> u32 {
        self.degenerate_triangles
    }

    /// Does every edge have exactly two triangles?
    ///
    /// Vertices at the same place count as one here (files split them along texture seams), and a triangle two of
    /// whose corners coincide has no edges of its own and is skipped. Winding does not matter. Linear in the mesh, not
    /// cached.
    pub fn is_closed(&self) -> bool {
        let mut place_of = HashMap::with_capacity(self.positions.len());
        let place: Vec<u32> = self
            .positions
            .iter()
            .enumerate()
            // Adding zero makes -0 and 0 one place.
            .map(|(i, p)| *place_of.entry([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).or_insert(i as u32))
            .collect();
        let mut edges = Vec::with_capacity(3 * self.triangles.len());
        for t in &self.triangles {
            let [a, b, c] = t.map(|i| place[i as usize]);
            if a != b && b != c && c != a {
                edges.extend([(a, b), (b, c), (c, a)].map(|(i, j)| (i.min(j), i.max(j))));
            }
        }
        edges.sort_unstable();
        edges.chunk_by(|x, y| x == y).all(|same| same.len() == 2)
    }

    /// SHA-256 (hex) over the coordinates (x y z per vertex, little-endian f64), then the indices (little-endian u32).
    pub fn sha256(&self) -> String {
        let mut hash = Sha256::new();
        for p in &self.positions {
            for x in p.coords.iter() {
                hash.update(x.to_le_bytes());
            }
        }
        for i in self.triangles.iter().flatten() {
            hash.update(i.to_le_bytes());
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Is each coordinate a number of single precision?
    pub fn is_f32_representable(&self) -> bool {
        self.positions.iter().all(|p| p.iter().all(|&x| f64::from(x as f32) == x))
    }

    /// The mesh with each coordinate rounded to the nearest number of single precision: what algorithms that compute in
    /// f32 get. Fails when that leaves no triangle with area (a small object far from the origin).
    pub fn to_f32_representable(self) -> Result<Self, MeshError> {
        let positions = self.positions.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
        Self::new(positions, self.triangles)
    }
}

/// Does the triangle have positive area, as double precision computes it?
///
/// The edges are scaled to length about 1 first: products of very small ones would underflow to a false zero.
fn has_area([a, b, c]: &[Point3<f64>; 3]) -> bool {
    let (u, v) = (b - a, c - a);
    let (su, sv) = (u.amax(), v.amax());
    su > 0.0 && sv > 0.0 && (u / su).cross(&(v / sv)) != Vector3::zeros()
}

#[cfg(test)]
mod tests;
