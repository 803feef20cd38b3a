//! What an owner has: finding it, telling of it, and taking it away.

use std::sync::Arc;

use crate::blobs::Blobs;
use crate::model::{OwnedItems, Owner};
use crate::objects::Objects;
use crate::owned::sql::OwnedIds;
use crate::store::Store;
use crate::{EngineError, Result};

const DAY_US: i64 = 24 * 3600 * 1_000_000;

/// The owned items of one engine.
pub struct Owned {
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Arc<Objects>,
    /// How long the items of a guest stay.
    pub guest_days: u32,
}

impl Owned {
    /// The run, if it is this owner's.
    pub async fn own_run(&self, id: &str, owner: &str) -> Result<OwnedIds> {
        let row = self.store.run_row(id).await?;
        if row.owner.as_deref() != Some(owner) {
            return Err(EngineError::Forbidden("Only the owner of this run may delete it.".to_owned()));
        }
        let all = self.store.owned_ids(owner, None).await?;
        let runs = all.runs.into_iter().filter(|run| run.id == id).collect();
        Ok(OwnedIds { runs, ..OwnedIds::default() })
    }

    /// The object, if it is this owner's, and their runs and advice with it.
    pub async fn own_object(&self, id: &str, owner: &str) -> Result<OwnedIds> {
        if !self.objects.info_for(id, Some(owner)).await?.mine {
            return Err(EngineError::Forbidden("Only the owner of this object may delete it.".to_owned()));
        }
        self.store.owned_ids(owner, Some(id)).await
    }

    /// What these are, how much goes with them, and until when they are kept.
    pub async fn told(&self, owner: &str, what: OwnedIds) -> Result<OwnedItems> {
        let bytes = self.store.unused_without(&what).await?.iter().map(|file| file.bytes).sum();
        let kept_until_us = self.kept_until(owner).await?;
        Ok(OwnedItems {
            runs: what.runs,
            objects: what.objects,
            configurations: what.configurations,
            advice: what.advice.len() as u32,
            stability: what.stability.len() as u32,
            workloads: what.workloads.len() as u32,
            bytes,
            kept_until_us,
        })
    }

    /// When the things of this owner go by themselves: only guests', and only if they have any. All of them expire together,
    /// counted from the newest: there is one date to show and to extend, and nothing goes that a newer link still needs.
    pub async fn kept_until(&self, owner: &str) -> Result<Option<i64>> {
        if !matches!(Owner::of(owner), Owner::Guest(_)) {
            return Ok(None);
        }
        let last = self.store.last_wanted(owner).await?;
        Ok(last.map(|last| last + i64::from(self.guest_days) * DAY_US))
    }

    /// The rows first, then the files: what the database speaks of is always there.
    pub async fn take_away(&self, what: &OwnedIds) -> Result<()> {
        // Nobody stores a file meanwhile that is about to go.
        let _alone = self.store.locks.removing().await?;
        for file in self.store.take_away(what).await? {
            self.blobs.remove(&file.sha256).await?;
        }
        Ok(())
    }
}
