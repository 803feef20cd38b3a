//! What objects are, as the spool has them.

use crate::{Error, Refusal};

/// Largest coordinate of a mesh, smallest and largest length of a primitive.
const LARGEST: f64 = 1e18;
const SMALLEST: f64 = 1e-100;
/// Vertices and triangles of a mesh that can be replayed.
const MOST_VERTICES: usize = 5_000_000;
const MOST_TRIANGLES: usize = 10_000_000;

/// What an object is. Lengths have one unit in the whole recording; primitives stand around the origin of their own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<'a> {
    /// Triangles.
    Mesh {
        /// Three coordinates each.
        vertices: &'a [[f64; 3]],
        /// Three numbers of vertices each, from 0.
        triangles: &'a [[u32; 3]],
    },
    /// A box.
    Box {
        /// Lengths of the edges along x, y and z.
        size: [f64; 3],
    },
    /// A ball.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A cylinder along z.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
    },
    /// A cylinder along z with two half balls as caps.
    Capsule {
        /// Its radius.
        radius: f64,
        /// Its length without the caps; 0 for a ball.
        length: f64,
    },
}

impl Shape<'_> {
    /// Its geometry as JSON; `keep` puts the file of a mesh (PLY) into the spool and gives the JSON of it.
    pub(crate) fn geometry(&self, keep: impl FnOnce(&[u8]) -> Result<String, Error>) -> Result<String, Error> {
        // `{:?}` is the shortest text that gives the number back.
        Ok(match *self {
            Self::Mesh { vertices, triangles } => keep(&ply(vertices, triangles)?)?,
            Self::Box { size: [x, y, z] } => {
                format!(r#"{{"kind": "box", "size": [{:?}, {:?}, {:?}]}}"#, length(x)?, length(y)?, length(z)?)
            }
            Self::Sphere { radius } => format!(r#"{{"kind": "sphere", "radius": {:?}}}"#, length(radius)?),
            Self::Cylinder { radius, length: long } => {
                format!(r#"{{"kind": "cylinder", "radius": {:?}, "length": {:?}}}"#, length(radius)?, length(long)?)
            }
            Self::Capsule { radius, length: long } => {
                let long = if long == 0.0 { 0.0 } else { length(long)? };
                format!(r#"{{"kind": "capsule", "radius": {:?}, "length": {long:?}}}"#, length(radius)?)
            }
        })
    }
}

/// A length that can be computed with.
fn length(length: f64) -> Result<f64, Refusal> {
    if (SMALLEST..=LARGEST).contains(&length) { Ok(length) } else { Err(Refusal::Length) }
}

/// A mesh as binary PLY.
fn ply(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Vec<u8>, Refusal> {
    if triangles.is_empty() {
        return Err(Refusal::NoTriangles);
    }
    if vertices.len() > MOST_VERTICES || triangles.len() > MOST_TRIANGLES {
        return Err(Refusal::LargeMesh);
    }
    if !vertices.as_flattened().iter().all(|x| x.abs() <= LARGEST) {
        return Err(Refusal::Coordinate);
    }
    if triangles.as_flattened().iter().any(|&vertex| vertex as usize >= vertices.len()) {
        return Err(Refusal::Vertex);
    }
    if !triangles.iter().any(|triangle| has_area(triangle.map(|vertex| vertices[vertex as usize]))) {
        return Err(Refusal::NoArea);
    }
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices.len(),
        triangles.len()
    );
    let mut bytes = Vec::with_capacity(head.len() + 24 * vertices.len() + 13 * triangles.len());
    bytes.extend_from_slice(head.as_bytes());
    bytes.extend(vertices.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    for triangle in triangles {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    Ok(bytes)
}

/// Has its projection to a plane of two axes any area?
fn has_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    [(1, 2), (2, 0), (0, 1)].into_iter().any(|(u, v)| (b[u] - a[u]) * (c[v] - a[v]) != (b[v] - a[v]) * (c[u] - a[u]))
}
