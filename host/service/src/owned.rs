//! What somebody has made: how long it stays, what goes with it, and taking it away.

pub mod archive;
pub mod items;
pub mod sql;
pub mod unused;

use std::time::Duration;

use crate::boxed;
use crate::engine::Engine;
use crate::model::{OwnedItems, Owner, State};
use crate::owned::sql::OwnedIds;
use crate::store::now_us;
use crate::{EngineError, Result};

/// How often it is looked whose time is over.
const LOOK: Duration = Duration::from_secs(3600);

impl Engine {
    /// Everything that this owner has, which is what `delete_all` takes away.
    #[boxed]
    pub async fn owned_items(&self, owner: &str) -> Result<OwnedItems> {
        let all = self.inner.store.owned_ids(owner, None).await?;
        self.inner.owned.told(owner, all).await
    }

    /// What goes with one of the owner's runs.
    #[boxed]
    pub async fn deletion_preview_of_run(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let run = self.inner.owned.own_run(id, owner).await?;
        self.inner.owned.told(owner, run).await
    }

    /// What goes with one of the owner's objects: it, and their runs and advice with it.
    #[boxed]
    pub async fn deletion_preview_of_object(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let object = self.inner.owned.own_object(id, owner).await?;
        self.inner.owned.told(owner, object).await
    }

    /// Takes away everything that this owner has, and tells what it was. Plugins stay: results belong to them.
    #[boxed]
    pub async fn delete_all(&self, owner: &str) -> Result<OwnedItems> {
        let all = self.inner.store.owned_ids(owner, None).await?;
        self.remove(owner, all).await
    }

    /// Takes away a run of this owner.
    #[boxed]
    pub async fn remove_run(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let run = self.inner.owned.own_run(id, owner).await?;
        self.remove(owner, run).await
    }

    /// Takes away an object of this owner, and their runs and advice with it.
    #[boxed]
    pub async fn remove_object(&self, id: &str, owner: &str) -> Result<OwnedItems> {
        let object = self.inner.owned.own_object(id, owner).await?;
        self.remove(owner, object).await
    }

    /// A guest's things stay as long again from now on.
    #[boxed]
    pub async fn keep_longer(&self, owner: &str) -> Result<OwnedItems> {
        self.inner.store.keep_longer(owner).await?;
        self.owned_items(owner).await
    }

    pub(crate) async fn remove(&self, owner: &str, what: OwnedIds) -> Result<OwnedItems> {
        self.end_all(owner, &what).await?;
        let told = self.inner.owned.told(owner, what.clone()).await?;
        self.inner.owned.take_away(&what).await?;
        Ok(told)
    }

    /// Ends what waits or is at work of these, which are the owner's.
    pub(crate) async fn end_all(&self, owner: &str, what: &OwnedIds) -> Result<()> {
        for run in &what.runs {
            let now = self.cancel(&run.id, Some(owner)).await?;
            if matches!(now.state, State::Queued | State::Running) {
                return Err(EngineError::Busy("One of these runs is just ending; try again in a moment.".to_owned()));
            }
        }
        for run in &what.stability {
            self.inner.work.end_stability(&self.inner.store, run, None).await?;
        }
        for workload in &what.workloads {
            self.inner.work.end_workload(&self.inner.store, workload, None).await?;
        }
        for advice in &what.advice {
            self.cancel_advice(advice, Some(owner)).await?;
        }
        Ok(())
    }

    /// Takes away what guests have left behind every hour, while this service keeps house.
    pub(crate) async fn sweep(self) {
        while self.inner.house.here().await {
            if let Err(e) = self.forget_requests().await {
                tracing::error!("keys of old requests could not be deleted: {e}");
            }
            if let Err(e) = self.inner.store.forget_empty_buckets().await {
                tracing::error!("rate limits that nobody is near could not be deleted: {e}");
            }
            if let Err(e) = self.sweep_once(now_us()).await {
                tracing::error!("expired data of guests could not be deleted: {e}");
            }
            tokio::select! {
                () = tokio::time::sleep(LOOK) => {}
                () = self.inner.house.gone() => {}
            }
        }
    }

    /// Takes away everything of guests whose time is over, and what was being made while its account was deleted; gives how many
    /// they were.
    #[boxed]
    pub async fn sweep_once(&self, now_us: i64) -> Result<u32> {
        let mut swept = 0;
        for owner in self.inner.store.owners().await? {
            let over = match Owner::of(&owner) {
                Owner::Account(account) => self.inner.store.is_former(account).await?,
                Owner::Guest(_) | Owner::Operator(_) => {
                    self.inner.owned.kept_until(&owner).await?.is_some_and(|until| until < now_us)
                }
            };
            if over {
                self.delete_all(&owner).await?;
                swept += 1;
            }
        }
        Ok(swept)
    }
}
