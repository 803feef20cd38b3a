//! Why a file is no object.

use std::fmt;

use super::limits::{MAX_BYTES, MAX_CORNERS, MAX_LINE_BYTES, MAX_TRIANGLES, MAX_VERTICES};
use crate::mesh::obj::ObjError;
use crate::mesh::{MAX_COORDINATE, MeshError};

/// Why a file is no object. Displays as one sentence: the place, what is wrong, how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// Longer than [`MAX_BYTES`].
    #[error("the file has {0} bytes, but at most {MAX_BYTES} (256 MiB) are read; reduce the object")]
    TooLong(usize),
    /// No bytes, or only white space.
    #[error("the file is empty; export the object again")]
    Empty,
    /// The content is of none of the formats.
    #[error("the content is in no format that is read ({}); export the object in one of them", super::FORMATS)]
    Unknown,
    /// An OBJ file at fault.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// One place in a file of another format is at fault.
    #[error("{place}: {fault}")]
    At {
        /// Where.
        place: Place,
        /// What is wrong there.
        fault: Fault,
    },
    /// No single place is at fault; the sentence says what the file lacks.
    #[error("{0}")]
    Whole(Fault),
    /// The places are fine, but the whole is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// A line of a text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
    /// An entry of a glTF document, such as `nodes[3]`: the list's name in the document and the number from 0.
    Entry(String),
}

impl Place {
    /// The error of this fault here.
    pub(in crate::mesh) fn has(self, fault: impl Into<Fault>) -> ReadError {
        ReadError::At { place: self, fault: fault.into() }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Entry(entry) => f.write_str(entry),
        }
    }
}

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
