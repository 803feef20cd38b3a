//! The files that an order names.

use ocb_lab::mesh_file::to_bytes;

use crate::attempts::Kind;
use crate::blocking::blocking;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{Errand, Wanted, WorkOrder};
use crate::{EngineError, Result};

impl Engine {
    /// A file of the machine's current attempt: the mesh `a` or `b`, the configuration `set` as Parquet, the `recording`, or
    /// `plugin-` with the SHA-256 of a plugin file that is measured, checked or tried.
    #[boxed]
    pub async fn file_of_order(&self, machine: &str, attempt: &str, name: &str) -> Result<Vec<u8>> {
        let inner = &self.inner;
        let unknown = || EngineError::NotFound(format!("The work of this machine has no file {name:?}."));
        let attempt = inner.store.attempt_of(machine, attempt).await?;
        if attempt.as_ref().is_some_and(|attempt| attempt.kind != Kind::Measure) {
            let (_, errand) = inner.store.with_order::<Errand>(attempt).await?.ok_or_else(unknown)?;
            return self.file_of_errand(&errand, name).await?.ok_or_else(unknown);
        }
        let (attempt, order) = inner.store.with_order::<WorkOrder>(attempt).await?.ok_or_else(unknown)?;
        let row = inner.store.run_row(&attempt.job).await?;
        match name {
            "a" | "b" => {
                let id = if name == "a" { row.object_a() } else { row.object_b() };
                let mesh = inner.objects.mesh(id).await?;
                blocking(move || Ok(to_bytes(&mesh))).await
            }
            "set" => inner.blobs.get(&row.set_blob.ok_or_else(unknown)?).await,
            _ => {
                let hash = name.strip_prefix("plugin-").ok_or_else(unknown)?;
                let mut ordered = order.algorithms.iter().chain(&order.reference);
                ordered.find(|it| it.info.plugin_sha256 == hash).ok_or_else(unknown)?;
                // Installed files are on the machine; submitted ones are stored, also when they are no longer offered.
                inner.blobs.get(hash).await
            }
        }
    }

    async fn file_of_errand(&self, errand: &Errand, name: &str) -> Result<Option<Vec<u8>>> {
        let inner = &self.inner;
        let blob = match &errand.wanted {
            Wanted::Advise { .. } => {
                let [a, b] = inner.advices.meshes_for(&errand.job).await?;
                let mesh = if name == "a" { a } else { b };
                let named = name == "a" || name == "b";
                return if named { blocking(move || Ok(Some(to_bytes(&mesh)))).await } else { Ok(None) };
            }
            Wanted::Replay { recording, .. } if name == "recording" => Some(recording.sha256.as_str()),
            wanted => {
                let plugins = wanted.plugins();
                name.strip_prefix("plugin-").filter(|hash| plugins.contains(hash))
            }
        };
        match blob {
            Some(blob) => inner.blobs.get(blob).await.map(Some),
            None => Ok(None),
        }
    }
}
