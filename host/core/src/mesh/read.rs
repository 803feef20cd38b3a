//! Files of users: recognised by content, read within one set of limits, refused with one sentence.
//!
//! Coordinates keep the file's frame, axes and length unit; only the transforms inside a file (nodes and instances) are
//! applied. No other file is ever opened.
//!
//! What is read by a crate: OBJ by tobj, JSON by `serde_json`, XML by roxmltree, base64 by base64. STL, PLY and the numbers of
//! glTF are read here. The living crates for them name neither line nor byte of a fault, and keep more than the surface in
//! memory: `stl_io` 0.11 makes a string of each word and wants a name behind `solid`; ply-rs-bw 4.0 keeps each skipped
//! element and knows no number like `.5`; gltf 1.4 keeps each material, and computes with the file's offsets unchecked.
//! `tests/formats/peers.rs` has all three read what we read, and compares.

pub mod fault;
pub mod limits;
pub(super) mod lines;
pub(super) mod placing;
pub(super) mod polygon;
mod recognise;
pub(super) mod surface;
pub(super) mod words;

use std::fmt;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Mesh, collada, gltf, obj, off, ply, stl};
pub use fault::{Fault, Place, ReadError};
use limits::MAX_BYTES;

/// The formats that [`read`] reads, as a sentence names them.
pub const FORMATS: &str = "OBJ, STL, PLY, OFF, glTF, GLB, COLLADA";

/// A file format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum FileFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary of either byte order.
    Ply,
    /// OFF (Geomview's object file format), text.
    Off,
    /// glTF 2.0, JSON with its buffers inside.
    Gltf,
    /// glTF 2.0, binary.
    Glb,
    /// COLLADA 1.4 or 1.5.
    Collada,
}

impl fmt::Display for FileFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Off => "OFF",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
            Self::Collada => "COLLADA",
        })
    }
}

/// A unit of length that a file states. Coordinates are in this unit and are not converted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LengthUnit {
    /// The name in the file, such as `centimeter`.
    pub name: String,
    /// Length of one unit in metres; positive and finite.
    pub metres: f64,
}

impl LengthUnit {
    pub(super) fn metre() -> Self {
        Self { name: "meter".to_owned(), metres: 1.0 }
    }
}

/// A mesh, and what there is to say of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadMesh {
    /// The surface. Vertices are in the order of the file, triangles in the order of its faces; a face of n corners gives
    /// n-2 triangles in a row. What a scene places several times is there several times.
    pub mesh: Mesh,
    /// The format that the content was recognised as.
    pub format: FileFormat,
    /// The unit of the coordinates, where the format has one: COLLADA states it, glTF is in metres.
    pub unit: Option<LengthUnit>,
    /// What was skipped, merged or mended, one sentence each.
    pub warnings: Vec<String>,
}

/// What a reader of one format gives.
pub(super) type Contents = (Mesh, Vec<String>);

/// Reads an object in any of the [`FORMATS`]. The content decides which, never a name.
///
/// Never panics, whatever the bytes are. Memory is bounded by the file's length and the limits in [`limits`], whatever
/// counts the file claims.
pub fn read(bytes: &[u8]) -> Result<ReadMesh, ReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLong(bytes.len()));
    }
    if without_mark(bytes).iter().all(u8::is_ascii_whitespace) {
        return Err(ReadError::Empty);
    }
    let format = recognise::format(bytes).ok_or(ReadError::Unknown)?;
    let mut unit = None;
    let (mesh, warnings) = match format {
        FileFormat::Obj => obj::read(bytes).map(|read| (read.mesh, read.warnings))?,
        FileFormat::Stl => stl::read(bytes)?,
        FileFormat::Ply => ply::read(bytes)?,
        FileFormat::Off => off::read(bytes)?,
        FileFormat::Gltf | FileFormat::Glb => {
            unit = Some(LengthUnit::metre());
            gltf::read(bytes)?
        }
        FileFormat::Collada => {
            let (stated, contents) = collada::read(bytes)?;
            unit = Some(stated);
            contents
        }
    };
    Ok(ReadMesh { mesh, format, unit, warnings })
}

/// The text behind a byte-order mark of UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
