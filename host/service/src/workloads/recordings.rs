//! Recordings as they are stored, and reading them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::cache::Cache;
use crate::model::RecordingInfo;
use crate::{EngineError, Recording, Result};

/// Queries of an uploaded recording at most, and the weight of all recordings that are kept in memory.
const MOST_QUERIES: usize = 2_000_000;

/// The recordings of one engine.
pub struct Recordings {
    blobs: Blobs,
    /// Where archives are written while they are read.
    folder: PathBuf,
    recent: Cache<Recording>,
}

impl Recordings {
    /// Those among these blobs; archives are read from a file in this folder.
    pub fn new(blobs: Blobs, folder: PathBuf) -> Self {
        Self { blobs, folder, recent: Cache::weighing(MOST_QUERIES, weight) }
    }

    /// A stored recording, from memory when it was used lately.
    pub async fn get(&self, told: &RecordingInfo) -> Result<Arc<Recording>> {
        if let Some(recording) = self.recent.get(&told.sha256) {
            return Ok(recording);
        }
        let bytes = self.blobs.get(&told.sha256).await?;
        let (name, folder) = (told.file.clone(), self.folder.clone());
        let recording = blocking(move || parsed(&name, &bytes, &folder)).await?;
        Ok(self.recent.put(&told.sha256, recording))
    }
}

/// How much memory a recording takes, in queries of some 300 bytes: an object with its names about as much, and five triangles.
fn weight(recording: &Recording) -> usize {
    let triangles: usize = recording.scene.meshes.values().map(|mesh| mesh.triangles().len()).sum();
    recording.queries.len() + recording.scene.scene.objects.len() + triangles / 5
}

/// Reads an uploaded recording; archives are read from a file.
pub fn parsed(name: &str, bytes: &[u8], folder: &Path) -> Result<Recording> {
    let fault = |e: std::io::Error| EngineError::fault("Keeping the recording while it is read failed", e);
    let file = tempfile::NamedTempFile::new_in(folder).map_err(fault)?;
    std::fs::write(file.path(), bytes).map_err(fault)?;
    let recording = Recording::or_scene(file.path(), name)?;
    if recording.queries.len() > MOST_QUERIES {
        return Err(EngineError::Invalid(format!(
            "{name:?} has {} queries; at most {MOST_QUERIES} can be replayed here. Record fewer groups, or use `ocb bench --workload`.",
            recording.queries.len()
        )));
    }
    Ok(recording)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use ocb_core::scene::Scene;
    use ocb_core::stock;
    use ocb_lab::scene_file::SceneFile;

    use super::*;

    #[test]
    fn a_scene_weighs_something_though_nothing_was_asked() {
        let mut meshes = HashMap::new();
        SceneFile::keep(&mut meshes, stock::generate("torus-knot", 800).unwrap());
        let scene = Scene { name: String::new(), objects: Vec::new(), disabled: Vec::new() };
        let recording =
            Recording { scene: SceneFile { scene, meshes }, about: Default::default(), queries: Vec::new() };
        assert_eq!(weight(&recording), 160);
    }
}
