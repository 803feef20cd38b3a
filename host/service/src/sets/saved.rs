//! Configurations that somebody saves, from a file or of a run, to measure on them again.

use crate::blocking::blocking;
use crate::boxed;
use crate::configurations::{ConfigurationFile, read_file, read_text};
use crate::engine::Engine;
use crate::model::{Cursor, OwnedItem, OwnedItems, Page, Part, SavedConfigurations};
use crate::objects::clean_name;
use crate::owned::sql::OwnedIds;
use crate::quotas::has_room_for_a_file;
use crate::results::not_yet;
use crate::store::{Store, now_us};
use crate::{EngineError, Result};

/// Most bytes of a file of configurations that is sent: 250,000 pairs of matrices as text.
pub const MAX_CONFIGURATION_BYTES: usize = 64 << 20;

impl Engine {
    /// Saves the configurations of a file (JSON, CSV or raw f64 matrices). The same file sent twice is one.
    ///
    /// # Errors
    /// `Invalid` with the row when it is no such file.
    #[boxed]
    pub async fn save_configurations(&self, name: &str, bytes: Vec<u8>, owner: &str) -> Result<SavedConfigurations> {
        let shown = name.to_owned();
        let (bytes, file) = blocking(move || {
            let file = read_text(&bytes).map_err(|e| EngineError::Invalid(format!("{shown:?} cannot be used: {e}")))?;
            Ok((bytes, file))
        })
        .await?;
        let length = bytes.len();
        has_room_for_a_file(&self.inner.store, Some(owner), length).await?;
        let _keeping = self.inner.store.locks.keeping().await?;
        let blob = self.inner.blobs.put(bytes).await?;
        self.inner.store.add_blob(&blob, length, "application/octet-stream").await?;
        self.inner.store.keep_saved(&clean_name(name, "configurations"), blob, &file, owner).await
    }

    /// Saves the configurations that a run was measured on.
    #[boxed]
    pub async fn save_configurations_of(&self, run: &str, owner: &str) -> Result<SavedConfigurations> {
        let row = self.inner.store.run_row(run).await?;
        // What the run was measured on may go with its last run, but not while it is saved here.
        let _keeping = self.inner.store.locks.keeping().await?;
        let blob = row.set_blob.clone().ok_or_else(|| not_yet(run))?;
        let bytes = self.inner.blobs.get(&blob).await?;
        has_room_for_a_file(&self.inner.store, Some(owner), bytes.len()).await?;
        let file = blocking(move || Ok(read_file(&bytes)?)).await?;
        let name = format!("{} x {}", row.object_a_name, row.object_b_name);
        self.inner.store.keep_saved(&name, blob, &file, owner).await
    }

    /// This owner's, newest first.
    #[boxed]
    pub async fn saved_configurations(&self, owner: &str, page: &Page) -> Result<Part<SavedConfigurations>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.saved_of(owner, &from, limit + 1).await?;
        Ok(Part::of(rows, limit, |saved: &SavedConfigurations| Cursor::behind(saved.created_us, &saved.id)))
    }

    /// The file, as it came, and what it is.
    #[boxed]
    pub async fn saved_file(&self, id: &str, owner: &str) -> Result<(SavedConfigurations, Vec<u8>)> {
        let saved = self.inner.store.own_saved(id, owner).await?;
        let bytes = self.inner.blobs.get(&saved.sha256).await?;
        Ok((saved, bytes))
    }

    /// What goes with them: they alone.
    #[boxed]
    pub async fn deletion_preview_of_saved(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let saved = self.inner.store.own_saved(id, owner).await?;
        self.inner.owned.told(owner, alone(saved)).await
    }

    /// Takes them away; runs that were measured on them keep the file.
    #[boxed]
    pub async fn remove_saved(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let saved = self.inner.store.own_saved(id, owner).await?;
        self.remove(owner, alone(saved)).await
    }

    /// # Errors
    /// `NotFound` when they are not this viewer's.
    #[boxed]
    pub async fn saved_are_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        self.inner.store.own_saved(id, viewer.unwrap_or_default()).await.map(drop)
    }
}

fn alone(saved: SavedConfigurations) -> OwnedIds {
    let configurations = vec![OwnedItem { id: saved.id, name: saved.name }];
    OwnedIds { configurations, ..OwnedIds::default() }
}

impl Store {
    async fn own_saved(&self, id: &str, owner: &str) -> Result<SavedConfigurations> {
        let missing = || EngineError::NotFound(format!("You have no saved configurations {id:?}."));
        self.saved(id, owner).await?.ok_or_else(missing)
    }

    /// Adds the row, while `Blobs::keeping` is held.
    async fn keep_saved(
        &self,
        name: &str,
        blob: String,
        file: &ConfigurationFile,
        owner: &str,
    ) -> Result<SavedConfigurations> {
        if let Some(known) = self.saved_from(&blob, owner).await? {
            return Ok(known);
        }
        let saved = SavedConfigurations {
            id: uuid::Uuid::now_v7().to_string(),
            name: name.to_owned(),
            sha256: blob,
            configurations: file.poses.len() as u32,
            straightened: file.straightened as u32,
            created_us: now_us(),
        };
        self.add_saved(&saved, owner).await?;
        Ok(saved)
    }
}
