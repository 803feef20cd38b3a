//! The one handle for server and command line.

use std::fs::File;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::configuration::{ConfigurationSet, Method};
use ocb_core::heatmap::VertexMap;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;
use ocb_lab::check::{Extent, Term, check_plugin};
use tokio::sync::Notify;
use tokio::task::JoinHandle;

use crate::advice::work::Advices;
use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::boxed;
use crate::cache::Cache;
use crate::columns::RecordColumns;
use crate::machine::{Machine, lock_data_folder};
use crate::measure::Stop;
use crate::model::{
    AlgorithmInfo, Ecdf, Estimate, Heatmap, HeatmapRequest, ObjectInfo, Page, Part, PluginReport, RunSpec, Status,
};
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::results::Format;
use crate::runs::log::RunEvents;
use crate::runs::{dispatcher, estimate, spec};
use crate::store::Store;
use crate::suite::Suite;
use crate::{EngineConfig, EngineError, Result, configurations};

/// Runs, objects, algorithms and results behind one cheap-to-clone handle.
///
/// `viewer`, `owner` and `caller` are the guest's id (or the name that the command line uses); `None` owns nothing. What a
/// viewer may look at is asked for with `run_is_for`, `object_is_for` and `advice_is_for`, once, at the service's door;
/// functions without a viewer answer whoever got so far. Only its owner may change a run.
#[derive(Clone)]
pub struct Engine {
    pub(crate) inner: Arc<Inner>,
}

/// What all parts of one engine share.
pub struct Inner {
    pub config: EngineConfig,
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Objects,
    pub registry: Registry,
    pub machine: Machine,
    pub run_events: RunEvents,
    /// What public plugins are measured on.
    pub suite: Suite,
    /// Held while it is found out what of the suite is missing, until that is in the queue.
    pub planning: tokio::sync::Mutex<()>,
    /// Held while a plugin is published: its ids must still be free then.
    pub publishing: tokio::sync::Mutex<()>,
    /// Held while a run is admitted: its quota must still be free then.
    pub asking: tokio::sync::Mutex<()>,
    /// Rung when the queue has something new.
    pub wake: Notify,
    /// The run at work and how it is stopped.
    pub current: Mutex<Option<(String, Stop)>>,
    pub sets: Cache<ConfigurationSet>,
    pub records: Cache<RecordColumns>,
    pub maps: Cache<VertexMap>,
    pub shapes: Cache<Shape>,
    pub charts: Cache<ocb_chart::Chart>,
    pub advices: Advices,
    pub closing: AtomicBool,
    /// Rung when the engine shuts down, for what would sleep on.
    pub closed: Notify,
    /// Rung when there is a mail to bring, or the engine shuts down.
    pub posting: Notify,
    /// What closing waits for.
    pub tasks: Mutex<Vec<JoinHandle<()>>>,
    /// Held as long as this process uses the folder.
    pub lock: File,
}

impl Inner {
    /// The engine is shutting down.
    pub fn closing(&self) -> bool {
        self.closing.load(Ordering::SeqCst)
    }

    /// Work that closing waits for.
    pub fn spawn(&self, work: impl Future<Output = ()> + Send + 'static) {
        let mut tasks = self.tasks.lock().unwrap_or_else(PoisonError::into_inner);
        tasks.retain(|task| !task.is_finished());
        tasks.push(tokio::spawn(work));
    }
}

impl Engine {
    /// Opens the data folder, migrates the database, puts interrupted runs back into the queue and begins to work on it.
    ///
    /// # Errors
    /// [`EngineError::Busy`] when another process has this folder open; `Fault` when folder, database, blob storage or
    /// runner cannot be used.
    #[boxed]
    pub async fn open(config: EngineConfig) -> Result<Self> {
        std::fs::create_dir_all(&config.data).map_err(|e| {
            EngineError::Fault(format!("The data folder {} cannot be made: {e}.", config.data.display()))
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
            suite,
            planning: tokio::sync::Mutex::default(),
            publishing: tokio::sync::Mutex::default(),
            asking: tokio::sync::Mutex::default(),
            wake: Notify::new(),
            current: Mutex::new(None),
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
    /// engine may open the folder, whoever still holds a handle of this one.
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
            queued: self.inner.store.waiting(i64::MAX).await?.0,
            algorithms: self.inner.registry.algorithms(None).len() as u32,
            problems: self.inner.registry.problems(),
        })
    }

    /// Stock objects in front of the first part, then those that the viewer added and the public ones of others, newest
    /// first.
    #[boxed]
    pub async fn objects(&self, viewer: Option<&str>, page: &Page) -> Result<Part<ObjectInfo>> {
        self.inner.objects.list(viewer, page).await
    }

    /// One object by id (`stock:NAME@TRIANGLES`, `stock:bunny`, `stock:dragon` or a UUID).
    #[boxed]
    pub async fn object(&self, id: &str, viewer: Option<&str>) -> Result<ObjectInfo> {
        self.inner.objects.info_for(id, viewer).await
    }

    /// An unnamed temporary file in the data folder.
    pub fn temporary_file(&self) -> Result<File> {
        tempfile::tempfile_in(&self.inner.config.data)
            .map_err(|e| EngineError::fault("Making a temporary file failed", e))
    }

    /// Reads an OBJ file and keeps its mesh; the same mesh of the same owner is kept once. Nothing is kept on error.
    #[boxed]
    pub async fn add_object(&self, name: &str, bytes: Vec<u8>, owner: Option<&str>) -> Result<ObjectInfo> {
        self.has_room_for_an_object(owner, bytes.len()).await?;
        self.inner.objects.add(name, bytes, owner).await
    }

    /// The mesh of an object.
    #[boxed]
    pub async fn mesh(&self, id: &str) -> Result<Arc<Mesh>> {
        self.inner.objects.mesh(id).await
    }

    /// Keeps a file of configurations (a Parquet set of ours, JSON, CSV or raw f64 matrices) and gives the method that
    /// names it in a [`RunSpec`].
    #[boxed]
    pub async fn add_configurations(&self, bytes: Vec<u8>) -> Result<Method> {
        let bytes = blocking(move || {
            configurations::read_file(&bytes)?;
            Ok(bytes)
        })
        .await?;
        let length = bytes.len();
        let _keeping = self.inner.blobs.keeping().await;
        let sha256 = self.inner.blobs.put(bytes).await?;
        self.inner.store.add_blob(&sha256, length, "application/octet-stream").await?;
        Ok(Method::File { sha256 })
    }

    /// All algorithms of all plugins that this viewer may ask for, by id.
    pub fn algorithms(&self, viewer: Option<&str>) -> Vec<AlgorithmInfo> {
        self.inner.registry.algorithms(viewer)
    }

    /// Checks a plugin file: format, loading in the jail, ABI, descriptor, answers on smoke configurations.
    ///
    /// What is wrong with the plugin is in the report; an error means that the check itself could not be made.
    #[boxed]
    pub async fn check_plugin(&self, file: &Path, extent: Extent) -> Result<PluginReport> {
        let (runner, file) = (self.inner.registry.runner().clone(), file.to_owned());
        // A thread of its own: a jail ends with the thread that started it.
        let (sender, report) = tokio::sync::oneshot::channel();
        let limit = self.inner.config.check_limit;
        std::thread::spawn(move || {
            let stop = Stop::default();
            let term = Term::new(&stop, limit);
            sender.send(check_plugin(&runner, &file, &extent, &term, &mut |_| true))
        });
        let report = report.await.map_err(|_| EngineError::Fault("The plugin check broke down.".into()))?;
        Ok(report?)
    }

    /// Number of configurations, expected time and wait of a run that is not asked for yet; checks the spec as `submit`.
    #[boxed]
    pub async fn estimate(&self, spec: &RunSpec, viewer: Option<&str>) -> Result<Estimate> {
        estimate::estimate(&self.inner, &self.check(spec, viewer).await?).await
    }

    /// The same for a visitor, with what their limits say of it.
    #[boxed]
    pub async fn estimate_for(&self, spec: &RunSpec, owner: &str) -> Result<Estimate> {
        let checked = self.check(spec, Some(owner)).await?;
        let expected = estimate::estimate(&self.inner, &checked).await?;
        match self.inner.may_be_asked_for(owner, &checked.spec, expected.total_seconds) {
            Ok(()) => Ok(expected),
            Err(EngineError::Invalid(why)) => Ok(Estimate { refused: Some(why), ..expected }),
            Err(e) => Err(e),
        }
    }

    pub(crate) async fn check(&self, spec: &RunSpec, viewer: Option<&str>) -> Result<spec::Checked> {
        let inner = &self.inner;
        spec::check(spec, &inner.objects, &inner.registry, &inner.store, &inner.blobs, viewer).await
    }

    /// Values on the vertices of one object of the run.
    #[boxed]
    pub async fn heatmap(&self, run: &str, request: &HeatmapRequest) -> Result<Heatmap> {
        self.inner.heatmap(run, request).await
    }

    /// The coloured object as glTF binary, with the raw values.
    #[boxed]
    pub async fn heatmap_glb(
        &self,
        run: &str,
        request: &HeatmapRequest,
        map: Colormap,
        scale: Scale,
    ) -> Result<Vec<u8>> {
        self.inner.export(run, request, map, scale, Format::Glb).await
    }

    /// The coloured object as PLY, with the raw values.
    #[boxed]
    pub async fn heatmap_ply(
        &self,
        run: &str,
        request: &HeatmapRequest,
        map: Colormap,
        scale: Scale,
    ) -> Result<Vec<u8>> {
        self.inner.export(run, request, map, scale, Format::Ply).await
    }

    /// Distribution of the time per query of one algorithm, over all configurations or those that a selection holds.
    #[boxed]
    pub async fn ecdf(&self, run: &str, algorithm: &str, selection: Option<&str>) -> Result<Ecdf> {
        self.inner.ecdf(run, algorithm, selection).await
    }

    /// The records of one algorithm as Parquet.
    #[boxed]
    pub async fn records_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.records_parquet(run, algorithm).await
    }

    /// The records of one algorithm as CSV with a header line.
    #[boxed]
    pub async fn records_csv(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.records_csv(run, algorithm).await
    }

    /// The run's configuration set with its truth as Parquet.
    #[boxed]
    pub async fn configurations_parquet(&self, run: &str) -> Result<Vec<u8>> {
        self.inner.configurations_parquet(run).await
    }
}
