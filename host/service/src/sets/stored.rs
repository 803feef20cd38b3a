//! Configuration sets as they are stored.

use std::sync::Arc;

use ocb_core::configuration::ConfigurationSet;
use ocb_core::mesh::Mesh;

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::cache::Cache;
use crate::columns::{SetOf, read_set, set_parquet};
use crate::configurations::describe;
use crate::model::SetInfo;
use crate::store::Store;
use crate::{Result, boxed};

/// So many sets stay in memory.
const RECENT: usize = 4;

/// The sets of one engine.
pub struct Sets {
    store: Store,
    blobs: Blobs,
    recent: Cache<ConfigurationSet>,
}

impl Sets {
    /// Those of this store.
    pub fn new(store: Store, blobs: Blobs) -> Self {
        Self { store, blobs, recent: Cache::new(RECENT) }
    }

    /// A stored set, from memory when it was used lately.
    pub async fn get(&self, blob: &str) -> Result<Arc<ConfigurationSet>> {
        if let Some(set) = self.recent.get(blob) {
            return Ok(set);
        }
        let bytes = self.blobs.get(blob).await?;
        let set = blocking(move || Ok(read_set(&bytes)?)).await?;
        Ok(self.remember(blob, set))
    }

    /// Holds in memory a set that was just stored.
    pub fn remember(&self, blob: &str, set: ConfigurationSet) -> Arc<ConfigurationSet> {
        self.recent.put(blob, set)
    }

    /// Keeps a new set under its key, while `Locks::keeping` is held.
    #[boxed]
    pub async fn keep(&self, key: &str, [a, b]: [&Mesh; 2], set: &ConfigurationSet, seconds: f64) -> Result<SetInfo> {
        let bytes = set_parquet(&SetOf { mesh_a: &a.sha256(), mesh_b: &b.sha256() }, set)?;
        let length = bytes.len();
        let blob = self.blobs.put(bytes).await?;
        let triangles = [a.triangles().len(), b.triangles().len()];
        let info = describe(set, &blob, triangles);
        self.store.add_blob(&blob, length, "application/vnd.apache.parquet").await?;
        self.store.keep_set(key, &info, &blob, triangles.iter().sum::<usize>() as u64, seconds).await?;
        Ok(info)
    }
}
