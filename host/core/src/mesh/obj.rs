//! Wavefront OBJ, in and out.
//!
//! tobj parses the numbers and builds the faces. In front of it stands a pre-pass of ours (`prepass.rs`), because tobj
//! alone names no line in its errors, accepts NaN, drops a vertex behind a byte-order mark, renumbers vertices per
//! group and sets no limits. Behind it, faces of more than three corners are cut by ear clipping (`read/polygon.rs`).

mod prepass;
#[cfg(test)]
mod tests;

use std::fmt::Write;
use std::io::{BufRead, Read};

use nalgebra::Point3;

use super::read::limits::MAX_BYTES;
use super::read::{Fault, surface::Surface};
use super::{Mesh, MeshError};

/// A mesh and what was noticed while reading it.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadObj {
    /// The surface. Vertex i (from 0) is the file's i-th `v` line. Triangles are in the order of the file's faces; a
    /// face of n corners gives n-2 triangles in a row, wound as the face is.
    pub mesh: Mesh,
    /// What was skipped or mended, one sentence each.
    pub warnings: Vec<String>,
}

/// Why a file is no object. Displays as one sentence with the line (from 1), the reason and how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ObjError {
    /// Longer than [`MAX_BYTES`].
    #[error("the file has {0} bytes, but at most {MAX_BYTES} (256 MiB) are read; reduce the object")]
    TooLong(usize),
    /// No bytes, or only white space.
    #[error("the file is empty; export the object again")]
    Empty,
    /// No line begins with `f`.
    #[error("the file has no faces (lines that start with 'f'); make sure it is an OBJ file with a polygon mesh")]
    NoFaces,
    /// A line is at fault.
    #[error("line {line}: {fault}")]
    Line {
        /// The line, from 1; the first one of continued lines.
        line: usize,
        /// What is wrong in it.
        fault: LineFault,
    },
    /// The lines are fine, but the whole is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The parser refused what the pre-pass let through.
    #[error("the OBJ parser stopped: {0}; export the object again from another program")]
    Parser(String),
}

/// What is wrong in one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LineFault {
    /// A NUL byte.
    #[error("this is not text (it holds a NUL byte); an OBJ file is plain text in UTF-8 or Latin-1")]
    Binary,
    /// What may be wrong in a file of any format.
    #[error(transparent)]
    Shared(#[from] Fault),
    /// A `v` line with the wrong number of numbers.
    #[error("a vertex needs 3 coordinates, and may have a weight or a colour after them, but here are {0} numbers")]
    CoordinateCount(usize),
    /// The weight of a vertex makes its place infinite.
    #[error("the weight '{0}' puts this vertex at infinity; use a weight that is not 0")]
    Weight(String),
    /// An index that is no whole number.
    #[error("'{0}' is not a vertex number; faces are written like 'f 1 2 3' or 'f 1/1/1 2/2/2 3/3/3'")]
    NotAnIndex(String),
    /// Index 0.
    #[error("vertex number 0, but vertices are numbered from 1")]
    IndexZero,
    /// An index beyond the file's vertices.
    #[error("vertex number {index}, but the file has only {vertices} vertices; correct the number")]
    IndexTooLarge {
        /// The index as written.
        index: i64,
        /// Vertices in the file.
        vertices: usize,
    },
    /// A negative index that reaches before the first vertex.
    #[error("vertex number {index} counts back {} vertices, but only {vertices} precede it; correct the number", index.unsigned_abs())]
    IndexTooSmall {
        /// The index as written.
        index: i64,
        /// Vertices above this line.
        vertices: usize,
    },
}

/// Reads an object; groups, materials, normals and texture coordinates are ignored, and no other file is opened.
///
/// Never panics, whatever the bytes are.
pub fn read(bytes: &[u8]) -> Result<ReadObj, ObjError> {
    let clean = prepass::run(bytes)?;
    let mut warnings = clean.warnings;

    // tobj numbers vertices in the order of first use and drops unused ones. A point element for each vertex, before
    // all faces, makes its numbering the file's.
    let vertices = clean.vertex_count;
    let mut points = String::with_capacity(8 * vertices);
    for i in 1..=vertices {
        let _ = writeln!(points, "f {i}");
    }
    let text = clean.vertices.as_bytes().chain(points.as_bytes()).chain(clean.faces.as_bytes());
    let (positions, corners, arities) = parse(text, vertices)?;

    let mut surface = Surface::over(positions);
    let mut rest = &corners[..];
    for arity in arities {
        let (face, tail) = rest.split_at(arity as usize);
        rest = tail;
        surface.face(face).map_err(|e| ObjError::Parser(e.to_string()))?;
    }
    Ok(ReadObj { mesh: surface.finish(&mut warnings)?, warnings })
}

/// Positions, then the corners of all faces and the number of corners of each, point elements left out.
type Parsed = (Vec<Point3<f64>>, Vec<u32>, Vec<u32>);

fn parse(mut text: impl BufRead, vertices: usize) -> Result<Parsed, ObjError> {
    let options = tobj::LoadOptions::default();
    // The pre-pass removed all material lines; should one get through, it still opens no file.
    let no_materials = |_: &std::path::Path| tobj::MTLLoadResult::Err(tobj::LoadError::OpenFileFailed);
    let (models, _) =
        tobj::load_obj_buf(&mut text, &options, no_materials).map_err(|e| ObjError::Parser(e.to_string()))?;
    let [model] = &models[..] else {
        return Err(ObjError::Parser(format!("it found {} objects in one", models.len())));
    };
    let mesh = &model.mesh;
    let sum: usize = mesh.face_arities.iter().map(|&n| n as usize).sum();
    if mesh.positions.len() != 3 * vertices || mesh.face_arities.len() < vertices || sum != mesh.indices.len() {
        return Err(ObjError::Parser("it lost vertices".into()));
    }
    let positions = mesh.positions.chunks_exact(3).map(|p| Point3::new(p[0], p[1], p[2])).collect();
    Ok((positions, mesh.indices[vertices..].to_vec(), mesh.face_arities[vertices..].to_vec()))
}

/// The mesh as OBJ text; [`read`] gives back the same mesh, bit for bit.
pub fn write(mesh: &Mesh) -> String {
    let mut text = String::with_capacity(48 * mesh.positions().len() + 24 * mesh.triangles().len());
    for p in mesh.positions() {
        // Display of f64 is the shortest decimal that reads back as the same number.
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}
