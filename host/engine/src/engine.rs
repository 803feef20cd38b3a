//! The one handle for server and command line.

use std::path::Path;
use std::sync::Arc;

use futures::Stream;
use ocb_core::configuration::Method;
use ocb_core::mesh::Mesh;

use crate::model::{
    AlgorithmInfo, Ecdf, Estimate, Heatmap, HeatmapRequest, ObjectInfo, PluginReport, RunEvent, RunInfo, RunSpec,
    Status,
};
use crate::{EngineConfig, EngineError, Result};

/// Runs, objects, algorithms and results behind one cheap-to-clone handle.
///
/// `viewer`, `owner` and `caller` are the guest's id (or the name that the command line uses); `None` owns nothing. Who
/// knows the id of a run or of an object may look at it; only its owner may cancel a run.
#[derive(Clone)]
pub struct Engine {
    config: Arc<EngineConfig>,
}

impl Engine {
    /// Opens the data folder, migrates the database, puts interrupted runs back into the queue and begins to work on it.
    ///
    /// # Errors
    /// [`EngineError::Busy`] when another process has this folder open; `Fault` when folder, database, blob storage or
    /// runner cannot be used.
    pub async fn open(config: EngineConfig) -> Result<Self> {
        Ok(Self { config: Arc::new(config) })
    }

    /// Stops working: a run under way goes back into the queue, everything known is on disk when this returns.
    pub async fn shutdown(&self) {}

    /// The service at a glance.
    pub async fn status(&self) -> Result<Status> {
        Err(self.absent("status"))
    }

    /// Stock objects, then those that the viewer added, newest first.
    pub async fn objects(&self, viewer: Option<&str>) -> Result<Vec<ObjectInfo>> {
        Err(self.absent(viewer.unwrap_or("objects")))
    }

    /// One object by id (`stock:NAME@TRIANGLES`, `stock:bunny`, `stock:dragon` or a UUID).
    pub async fn object(&self, id: &str) -> Result<ObjectInfo> {
        Err(self.absent(id))
    }

    /// Reads an OBJ file and keeps its mesh; the same mesh of the same owner is kept once. Nothing is kept on error.
    pub async fn add_object(&self, name: &str, bytes: Vec<u8>, owner: Option<&str>) -> Result<ObjectInfo> {
        let _ = (bytes, owner);
        Err(self.absent(name))
    }

    /// The mesh of an object.
    pub async fn mesh(&self, id: &str) -> Result<Arc<Mesh>> {
        Err(self.absent(id))
    }

    /// Keeps a file of configurations (a Parquet set of ours, or raw little-endian f64 4x4 row-major matrices that place
    /// B in A's frame) and gives the method that names it in a [`RunSpec`].
    pub async fn add_configurations(&self, bytes: Vec<u8>) -> Result<Method> {
        let _ = bytes;
        Err(self.absent("configurations"))
    }

    /// All algorithms of all plugins that could be described, by id.
    pub fn algorithms(&self) -> Vec<AlgorithmInfo> {
        Vec::new()
    }

    /// Checks a plugin file: format, loading in the jail, ABI, descriptor, answers on smoke configurations.
    ///
    /// What is wrong with the plugin is in the report; an error means that the check itself could not be made.
    pub async fn check_plugin(&self, file: &Path) -> Result<PluginReport> {
        Err(self.absent(&file.display().to_string()))
    }

    /// Number of configurations, expected time and wait of a run that is not asked for yet; checks the spec as `submit`.
    pub async fn estimate(&self, spec: &RunSpec) -> Result<Estimate> {
        Err(self.absent(&spec.object_a))
    }

    /// Checks the spec and queues the run.
    pub async fn submit(&self, spec: RunSpec, owner: Option<&str>) -> Result<RunInfo> {
        let _ = owner;
        Err(self.absent(&spec.object_a))
    }

    /// One run.
    pub async fn run(&self, id: &str, viewer: Option<&str>) -> Result<RunInfo> {
        let _ = viewer;
        Err(self.absent(id))
    }

    /// The owner's runs, newest first (at most 200).
    pub async fn runs(&self, owner: &str) -> Result<Vec<RunInfo>> {
        Err(self.absent(owner))
    }

    /// Ends a run that is queued or under way. A run that has ended stays as it is.
    pub async fn cancel(&self, id: &str, caller: Option<&str>) -> Result<RunInfo> {
        let _ = caller;
        Err(self.absent(id))
    }

    /// The newest finished run for the start page, if there is one already.
    pub async fn featured(&self) -> Result<Option<RunInfo>> {
        Ok(None)
    }

    /// The run's events behind `after_seq` (0: all), oldest first.
    pub async fn events(&self, id: &str, after_seq: i64) -> Result<Vec<RunEvent>> {
        let _ = after_seq;
        Err(self.absent(id))
    }

    /// Replays the run's events behind `after_seq`, then follows; ends behind the event in which the run ends.
    pub async fn follow(
        &self,
        id: &str,
        after_seq: i64,
    ) -> Result<impl Stream<Item = Result<RunEvent>> + Send + 'static> {
        let _ = (id, after_seq);
        Ok(futures::stream::empty())
    }

    /// Values on the vertices of one object of the run.
    pub async fn heatmap(&self, run: &str, request: &HeatmapRequest) -> Result<Heatmap> {
        let _ = request;
        Err(self.absent(run))
    }

    /// Distribution of the time per query of one algorithm.
    pub async fn ecdf(&self, run: &str, algorithm: &str) -> Result<Ecdf> {
        let _ = algorithm;
        Err(self.absent(run))
    }

    /// The records of one algorithm as Parquet.
    pub async fn records_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let _ = algorithm;
        Err(self.absent(run))
    }

    /// The records of one algorithm as CSV with a header line.
    pub async fn records_csv(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let _ = algorithm;
        Err(self.absent(run))
    }

    /// The run's configuration set with its truth as Parquet.
    pub async fn configurations_parquet(&self, run: &str) -> Result<Vec<u8>> {
        Err(self.absent(run))
    }

    fn absent(&self, what: &str) -> EngineError {
        EngineError::NotFound(format!("There is no {what:?} in {}.", self.config.data.display()))
    }
}
