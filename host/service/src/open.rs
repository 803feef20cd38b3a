//! Opening a service on its data folder, and closing it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::Notify;

use crate::advice::work::Advices;
use crate::blobs::Blobs;
use crate::boxed;
use crate::cache::Cache;
use crate::engine::{Engine, Inner};
use crate::idle;
use crate::machine::{Machine, lock_data_folder};
use crate::model::Status;
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::runs::dispatcher;
use crate::runs::log::RunEvents;
use crate::runs::priority::BACKGROUND;
use crate::store::Store;
use crate::suite::Suite;
use crate::{EngineConfig, EngineError, Result};

impl Engine {
    /// Opens the data folder, migrates the database, puts interrupted runs back into the queue and begins to work on it.
    ///
    /// # Errors
    /// [`EngineError::Busy`] when another process has this folder open; `Fault` when folder, database, blob storage or
    /// runner cannot be used.
    #[boxed]
    pub async fn open(config: EngineConfig) -> Result<Self> {
        std::fs::create_dir_all(&config.data).map_err(|e| {
            EngineError::Fault(format!("The data folder {} cannot be created: {e}.", config.data.display()))
        })?;
        let lock = lock_data_folder(&config.data)?;
        let store = Store::open(&config.data, config.database_url.as_deref()).await?;
        let blobs = Blobs::open(&config.data, config.blob_url.as_deref())?;
        let registry = Registry::open(&config, &store).await?;
        let suite = Suite::open(config.suite.as_deref())?;
        let inner = Arc::new(Inner {
            objects: Objects::new(store.clone(), blobs.clone(), config.stock_dir.clone()),
            machine: Machine::observe()?.noted(config.machine_note.as_deref()),
            run_events: RunEvents::new(),
            under_way: Arc::default(),
            suite,
            planning: tokio::sync::Mutex::default(),
            publishing: tokio::sync::Mutex::default(),
            asking: tokio::sync::Mutex::default(),
            wake: Notify::new(),
            current: Mutex::new(None),
            asked: AtomicU64::new(0),
            sets: Cache::new(4),
            records: Cache::new(16),
            maps: Cache::new(8),
            shapes: Cache::new(4),
            charts: Cache::weighing(crate::charts::KEPT_POINTS, crate::charts::points),
            advices: Advices::default(),
            closing: AtomicBool::new(false),
            closed: Notify::new(),
            posting: Notify::new(),
            tasks: Mutex::default(),
            lock,
            config,
            store,
            blobs,
            registry,
        });
        let engine = Self { inner };
        engine.inner.renew_plugins().await?;
        if engine.inner.config.dispatch {
            dispatcher::recover(&engine.inner).await?;
            if !engine.inner.config.idle {
                idle::end_waiting(&engine.inner).await?;
            }
            engine.recover_advice().await?;
            engine.feature_a_run().await?;
            engine.catch_up_with_the_suite().await?;
            engine.take_up_campaigns().await;
            engine.inner.spawn(dispatcher::work(engine.inner.clone()));
            engine.inner.spawn(engine.clone().sweep());
            engine.inner.spawn(engine.inner.clone().post());
        }
        Ok(engine)
    }

    /// Stops working: a run under way goes back into the queue; when this returns, everything known is on disk and another
    /// engine may open the folder, even while handles of this one exist.
    #[boxed]
    pub async fn shutdown(&self) {
        self.inner.closing.store(true, Ordering::SeqCst);
        self.inner.stop_current(None, None);
        self.inner.advices.stop_all();
        self.inner.wake.notify_one();
        self.inner.closed.notify_one();
        self.inner.posting.notify_one();
        let tasks = std::mem::take(&mut *self.inner.tasks.lock().unwrap_or_else(PoisonError::into_inner));
        for task in tasks {
            let _ = task.await;
        }
        self.inner.store.close().await;
        // Closing the file does it too; at the latest then it is free.
        let _ = self.inner.lock.unlock();
    }

    /// The service at a glance.
    #[boxed]
    pub async fn status(&self) -> Result<Status> {
        Ok(Status {
            version: env!("CARGO_PKG_VERSION").into(),
            hardware_class: self.inner.machine.hardware_class.clone(),
            running: self.inner.store.running().await?.len() as u32,
            queued: self.inner.store.waiting(BACKGROUND).await?.0,
            algorithms: self.inner.registry.algorithms(None).len() as u32,
            problems: self.inner.registry.problems(),
        })
    }
}
