//! Why a file is no object.

use super::limits::{MAX_CORNERS, MAX_LINE_BYTES, MAX_TRIANGLES, MAX_VERTICES};
use crate::mesh::MAX_COORDINATE;

/// What is wrong at a place, and how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// A NUL byte in a text.
    #[error("this is not text (it holds a NUL byte); export or download the file again")]
    Binary,
    /// Longer than [`MAX_LINE_BYTES`].
    #[error("longer than {MAX_LINE_BYTES} bytes (1 MiB); break it into several lines")]
    LineTooLong,
    /// More than [`MAX_VERTICES`].
    #[error("more than {MAX_VERTICES} vertices; reduce the object")]
    TooManyVertices,
    /// More than [`MAX_TRIANGLES`].
    #[error("more than {MAX_TRIANGLES} triangles; reduce the object")]
    TooManyTriangles,
    /// More than [`MAX_CORNERS`].
    #[error("a face with {0} corners, but at most {MAX_CORNERS} are read; cut it into smaller faces")]
    TooManyCorners(usize),
    /// A coordinate that is no number.
    #[error("'{0}' is not a number; write coordinates like -1.25 or 3e-4")]
    NotANumber(String),
    /// NaN or infinite.
    #[error("'{0}' is not a finite number; remove or repair that vertex")]
    NotFinite(String),
    /// Beyond [`MAX_COORDINATE`].
    #[error("'{0}' is larger than {MAX_COORDINATE:e}; scale the object down")]
    TooFar(String),
    /// A face names a vertex that does not exist; vertices are numbered from 0.
    #[error("vertex number {index}, but the {vertices} vertices are numbered from 0; correct the number")]
    NoSuchVertex {
        /// The number as written.
        index: i64,
        /// Vertices in the file.
        vertices: usize,
    },
    /// A fault of one format, as a sentence.
    #[error("{0}")]
    Said(String),
}

impl From<&str> for Fault {
    fn from(sentence: &str) -> Self {
        Self::Said(sentence.to_owned())
    }
}

impl From<String> for Fault {
    fn from(sentence: String) -> Self {
        Self::Said(sentence)
    }
}
