//! What can go wrong.

use std::fmt::{self, Display, Formatter};
use std::io;
use std::path::PathBuf;

/// Why something is not in the recording.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// It cannot be recorded. The recording goes on.
    Refused(Refusal),
    /// A file of the spool cannot be made or written, for example because the disk is full. The recording ends here, and what was
    /// written before stays readable.
    File {
        /// Which file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The recording ended at an earlier [`Error::File`].
    Ended,
}

/// Why an object or a query is not recorded. Its text is the reason under which queries are counted in the recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// A name, program, library or version is longer than 200 bytes, or the program has no name.
    Name,
    /// The mesh has no triangles.
    NoTriangles,
    /// A mesh has more than 5,000,000 vertices or 10,000,000 triangles.
    LargeMesh,
    /// A coordinate of the mesh is not finite, or beyond 1e18.
    Coordinate,
    /// A triangle names a vertex that does not exist.
    Vertex,
    /// Every triangle of the mesh has zero area.
    NoArea,
    /// A length of a primitive is not between 1e-100 and 1e18. The length of a capsule may be 0.
    Length,
    /// A recording has at most 20,000 objects.
    TooManyObjects,
    /// The meshes of a recording have at most 4 GiB.
    TooManyBytes,
    /// The object belongs to another recording.
    Object,
    /// A number of a pose is not finite.
    Pose,
    /// The tolerance of a query is negative or not finite.
    Tolerance,
}

impl Refusal {
    /// The reason as it stands in the recording.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Name => "a name is empty or has more than 200 bytes",
            Self::NoTriangles => "a mesh has no triangles",
            Self::LargeMesh => "a mesh has more than 5000000 vertices or 10000000 triangles",
            Self::Coordinate => "a mesh has a coordinate that is not a number, or too large",
            Self::Vertex => "a triangle of a mesh names a vertex that does not exist",
            Self::NoArea => "every triangle of a mesh has zero area",
            Self::Length => "a primitive has a length that cannot be computed with",
            Self::TooManyObjects => "an object is beyond the first 20000",
            Self::TooManyBytes => "the meshes have more than 4 GiB",
            Self::Object => "an object was not recorded",
            Self::Pose => "a pose is not finite",
            Self::Tolerance => "the limit of a query is negative or not finite",
        }
    }
}

impl Display for Refusal {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.reason())
    }
}

impl Display for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(refusal) => write!(f, "not recorded: {refusal}"),
            Self::File { path, source } => write!(f, "the recording cannot be written: {}: {source}", path.display()),
            Self::Ended => f.write_str("the recording ended when a file could not be written"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File { source, .. } => Some(source),
            Self::Refused(_) | Self::Ended => None,
        }
    }
}

impl From<Refusal> for Error {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}
