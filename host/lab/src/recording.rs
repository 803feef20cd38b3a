//! Recordings (`.ocbrec`): the scene of a program, and the queries that it asked about it.
//!
//! A recording is a scene file with two more files in it: `queries.parquet` and `about.json`. Recorders write a spool, a folder
//! that only grows, so that a killed program leaves what it had asked; [`pack`] makes a recording of it.

mod merge;
mod poses;
mod spool;

use std::path::Path;

use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, SceneObject};
use ocb_core::workload::Recorded;
use serde::{Deserialize, Serialize};

use crate::columns::{read_recorded, recorded_parquet};
use crate::scene_file::{Reader, SceneFile};
use crate::{LabError, Result};

pub use merge::{Packed, pack};
pub use poses::{from_json, from_pair};

/// The queries in the archive.
const QUERIES: &str = "queries.parquet";
/// What the recording says of itself.
const ABOUT: &str = "about.json";
/// Largest file of queries, and of words about them, bytes.
const MOST_QUERIES: u64 = 4 << 30;
const MOST_ABOUT: u64 = 1 << 20;

/// Where a recording comes from, and what it does not hold.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// The recorded program.
    pub program: String,
    /// What recorded it.
    pub recorder: String,
    /// The libraries that answered, with their versions.
    pub libraries: Vec<String>,
    /// Queries that the recorder saw.
    pub seen: u64,
    /// Queries that are not in the recording, by reason.
    pub dropped: Vec<Dropped>,
}

/// An object as recordings have it: the poses of the queries place it.
fn object(name: String, geometry: Geometry, source: String) -> SceneObject {
    let (link, pose, scale, licence) = (None, Pose::identity(), [1.0; 3], None);
    SceneObject { name, link, geometry, pose, source, scale, licence }
}

/// Queries that were left out for one reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Dropped {
    /// Why.
    pub reason: String,
    /// How many.
    pub count: u64,
}

/// A recording, read as a whole.
pub struct Recording {
    /// The objects.
    pub scene: SceneFile,
    /// Where it comes from.
    pub about: About,
    /// In the order in which they were asked.
    pub queries: Vec<Recorded>,
}

impl Recording {
    /// Reads the recording in this file.
    ///
    /// # Errors
    /// `Invalid`, with one sentence, for a file that is no recording, also for a scene without queries.
    pub fn read(path: &Path) -> Result<Self> {
        Self::read_as(path, &path.file_name().unwrap_or_default().to_string_lossy())
    }

    /// The same for a file that its owner knows by another name.
    pub fn read_as(path: &Path, name: &str) -> Result<Self> {
        let read = Self::or_scene(path, name)?;
        if read.queries.is_empty() {
            return Err(LabError::Invalid(format!("{name:?} is not a recording: it is a scene without queries.")));
        }
        Ok(read)
    }

    /// The same, or the scene in a file that has no queries.
    pub fn or_scene(path: &Path, name: &str) -> Result<Self> {
        let bad = |why: String| LabError::Invalid(format!("{name:?} is not a recording: {why}."));
        let mut file = Reader::open_as(path, name)?;
        let scene = file.scene()?;
        let Some(queries) = file.other(QUERIES, MOST_QUERIES)? else {
            return Ok(Self { scene, about: About::default(), queries: Vec::new() });
        };
        let about = file.other(ABOUT, MOST_ABOUT)?.ok_or_else(|| bad(format!("{ABOUT} is missing")))?;
        let about = serde_json::from_slice(&about).map_err(|e| bad(format!("{ABOUT} cannot be read ({e})")))?;
        let mut queries = read_recorded(&queries, scene.scene.objects.len())
            .map_err(|why| bad(format!("{QUERIES} cannot be read ({why})")))?;
        queries.sort_by_key(|query| query.sequence);
        Ok(Self { scene, about, queries })
    }

    /// How much is in it.
    pub fn packed(&self) -> Packed {
        let Self { scene, about, queries } = self;
        let dropped = about.dropped.clone();
        Packed { objects: scene.scene.objects.len(), queries: queries.len(), seen: about.seen, dropped }
    }

    /// Writes it; a file of that name is replaced as a whole.
    pub fn write(&self, path: &Path) -> Result<()> {
        let about =
            serde_json::to_vec_pretty(&self.about).map_err(|e| LabError::fault("Writing the recording failed", e))?;
        let queries = recorded_parquet(&self.queries)?;
        self.scene.write(path, &[(ABOUT, &about), (QUERIES, &queries)])
    }
}
