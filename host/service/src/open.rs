//! Opening a service on its data folder, and closing it.

use std::sync::Arc;

use crate::boxed;
use crate::engine::{Engine, Inner};
use crate::model::Status;
use crate::runs::priority::BACKGROUND;
use crate::store::now_us;
use crate::{EngineConfig, EngineError, Result};

impl Engine {
    /// Opens the data folder, migrates the database, puts the work of its dead predecessor back into the queue and begins to work on it.
    ///
    /// # Errors
    /// [`EngineError::Busy`] when another process has this folder open; `Fault` when folder, database, blob storage or
    /// runner cannot be used.
    #[boxed]
    pub async fn open(config: EngineConfig) -> Result<Self> {
        std::fs::create_dir_all(&config.data).map_err(|e| {
            EngineError::Fault(format!("The data folder {} cannot be created: {e}.", config.data.display()))
        })?;
        let inner = Arc::new(Inner::of(config).await?);
        let engine = Self { inner: inner.clone() };
        inner.registry.renew().await?;
        inner.classes.learn_from(&inner.store).await?;
        let leases = inner.leases();
        if inner.config.dispatch {
            inner.store.believe_machines().await?;
            leases.take_back(Some(&inner.work.worker)).await?;
            engine.open_house().await?;
            inner.tasks.spawn(inner.dispatcher().work());
            if !inner.config.elsewhere {
                inner.tasks.spawn(inner.advices.clone().work());
            }
            inner.tasks.spawn(engine.clone().sweep());
            inner.tasks.spawn(engine.clone().look_after_campaigns());
            let (outbox, house) = (inner.outbox.clone(), inner.house.clone());
            inner.tasks.spawn(async move { outbox.post(&house).await });
            if let Some(jobs) = inner.config.slurm.clone() {
                inner.tasks.spawn(engine.clone().supply(jobs));
            }
        }
        inner.tasks.spawn(leases.beat());
        #[cfg(feature = "postgres")]
        if let Some(url) = inner.config.postgres_url() {
            inner.tasks.listen(inner.notifications().hear(url.to_owned()));
        }
        Ok(engine)
    }

    /// Stops working: a run under way goes back into the queue; when this returns, everything known is on disk and another
    /// engine may open the folder, even while handles of this one exist.
    #[boxed]
    pub async fn shutdown(&self) {
        self.inner.work.close();
        self.inner.advices.stop_all();
        self.inner.house.close();
        self.inner.tasks.ended().await;
        self.inner.house.leave().await;
        self.inner.store.close().await;
        self.inner.work.leave();
    }

    /// The service at a glance.
    #[boxed]
    pub async fn status(&self) -> Result<Status> {
        let store = &self.inner.store;
        let (queued, expected_seconds) = store.waiting_in_all(BACKGROUND).await?;
        let machines = if self.inner.config.elsewhere { store.machines().await? } else { Vec::new() };
        let now = now_us();
        Ok(Status {
            version: env!("CARGO_PKG_VERSION").into(),
            hardware_class: self.inner.classes.usual(),
            classes: self.inner.classes.status(store).await?,
            running: store.running_in_all().await?,
            queued,
            oldest_seconds: store.oldest_seconds().await?,
            expected_seconds,
            idle_work: self.inner.config.idle,
            elsewhere: self.inner.config.elsewhere,
            machines: machines.iter().filter_map(|machine| machine.status(now)).collect(),
            algorithms: self.inner.registry.algorithms(None).len() as u32,
            problems: self.inner.registry.problems(),
        })
    }
}
