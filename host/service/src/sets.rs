//! Configuration sets by themselves, without a run.

pub mod saved;
mod saved_sql;
pub mod sql;
pub mod stored;

use std::sync::Arc;

use ocb_core::configuration::{Configuration, ConfigurationSet, Method};
use ocb_core::mesh::Mesh;
use ocb_lab::pairing::Pairing;

use crate::Result;
use crate::blocking::blocking;
use crate::boxed;
use crate::configurations::{Gauge, make, read_file, set_key};
use crate::engine::Engine;
use crate::model::{RunSpec, SetInfo};
use crate::runs::spec;

/// A set that was asked for: checked, with all that is needed to find it.
pub struct SetJob {
    spec: RunSpec,
    key: String,
    meshes: [Arc<Mesh>; 2],
    poses: Option<Vec<Configuration>>,
    /// Number of configurations, before any is missed.
    pub size: u64,
    /// It was made before.
    pub stored: Option<SetInfo>,
}

impl SetJob {
    /// Finds and certifies it on all CPUs; `None` when it was stopped.
    pub fn find(&self, gauge: &Gauge) -> Result<Option<ConfigurationSet>> {
        let [a, b] = self.meshes.clone();
        let pairing = Pairing::new(a, self.spec.object_b.is_some().then_some(b));
        Ok(make(&pairing, &self.spec, self.poses.as_deref(), gauge, None)?)
    }
}

impl Engine {
    /// Keeps a file of configurations (a Parquet set of ours, JSON, CSV or raw f64 matrices) and gives the method that
    /// names it in a [`RunSpec`].
    #[boxed]
    pub async fn add_configurations(&self, bytes: Vec<u8>) -> Result<Method> {
        let bytes = blocking(move || {
            read_file(&bytes)?;
            Ok(bytes)
        })
        .await?;
        let length = bytes.len();
        let _keeping = self.inner.store.locks.keeping().await?;
        let sha256 = self.inner.blobs.put(bytes).await?;
        self.inner.store.add_blob(&sha256, length, "application/octet-stream").await?;
        Ok(Method::File { sha256 })
    }

    /// Checks a request for a set. Of the spec, the objects, the method and the separation count.
    #[boxed]
    pub async fn set_job(&self, spec: &RunSpec) -> Result<SetJob> {
        let inner = &self.inner;
        let size = spec::set_size(spec, &inner.store, &inner.blobs).await?;
        let mesh_a = inner.objects.mesh(&spec.object_a).await?;
        let mesh_b = match &spec.object_b {
            Some(id) => inner.objects.mesh(id).await?,
            None => mesh_a.clone(),
        };
        let poses = match &spec.method {
            Method::File { sha256 } => Some(read_file(&inner.blobs.get(sha256).await?)?.poses),
            _ => None,
        };
        let key = set_key(&mesh_a.sha256(), &mesh_b.sha256(), spec)?;
        let stored = inner.store.set(&key).await?.map(|stored| stored.info);
        Ok(SetJob { spec: spec.clone(), key, meshes: [mesh_a, mesh_b], poses, size, stored })
    }

    /// Keeps a set that was found in so many seconds; later runs and requests use it again.
    #[boxed]
    pub async fn keep_set(&self, job: &SetJob, set: &ConfigurationSet, seconds: f64) -> Result<SetInfo> {
        let _keeping = self.inner.store.locks.keeping().await?;
        self.inner.sets.keep(&job.key, job.meshes.each_ref().map(AsRef::as_ref), set, seconds).await
    }

    /// A kept set with its truth as Parquet.
    #[boxed]
    pub async fn set_parquet(&self, info: &SetInfo) -> Result<Vec<u8>> {
        self.inner.blobs.get(&info.sha256).await
    }
}
