//! Charts as files of pictures: SVG as it is, or drawn as PNG.

#[cfg(feature = "png")]
#[path = "picture/png.rs"]
mod drawn;
#[cfg(not(feature = "png"))]
#[path = "picture/no_png.rs"]
mod drawn;

use std::path::Path;

pub use drawn::png;

use crate::failure::{Failure, Result};

/// The picture in the format that the end of the file's name asks for.
pub fn bytes(path: &Path, svg: String) -> Result<Vec<u8>> {
    match ending(path).as_deref() {
        Some("svg") => Ok(svg.into_bytes()),
        Some("png") => png(&svg),
        _ => Err(Failure::Input(format!("{} must end in .svg or .png.", path.display()))),
    }
}

/// The end of a file's name, in small letters.
pub fn ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_lowercase())
}
