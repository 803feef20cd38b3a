//! glTF 2.0 and GLB: the default scene, its nodes flattened with their transforms, in metres.
//!
//! Read are the positions and the triangles (lists, strips and fans) of each mesh, once for each node that shows it.
//! Materials, cameras and animations are ignored, and so are skins and morph targets, with a warning. Buffers are inside
//! the file: in the binary part of a GLB file, or as `data:` addresses in base64.

mod container;
mod data;
mod document;
mod scene;
#[cfg(test)]
mod tests;

use super::read::{Contents, ReadError};

/// Reads a file that begins with `glTF` (GLB) or `{`.
pub fn read(bytes: &[u8]) -> Result<Contents, ReadError> {
    let parts = container::open(bytes)?;
    let document = document::read(&parts)?;
    let buffers = data::Buffers::open(&document, parts.binary)?;
    scene::flatten(&document, &buffers, parts.warnings)
}
