//! Replaying recordings on this machine.

use std::path::PathBuf;
use std::sync::Arc;

use ocb_lab::LabError;
use ocb_lab::advisor::{Advisor, SHELF};
use ocb_lab::algorithm::Algorithm;
use ocb_lab::recording::Recording;
use ocb_lab::workload::{Asked, Site};

use super::recordings::Recordings;
use crate::blobs::Blobs;
use crate::config::Ceilings;
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::WorkloadSpec;
use crate::plugins::registry::Registry;
use crate::runs::current::Work;
use crate::store::Store;
use crate::{EngineError, Result};

/// The replays that wait, and what carries them out.
pub struct Replays {
    pub store: Store,
    pub blobs: Blobs,
    pub registry: Arc<Registry>,
    pub recordings: Arc<Recordings>,
    pub work: Arc<Work>,
    pub machine: Machine,
    pub ceilings: Ceilings,
    /// The advisor's program.
    pub advisor: PathBuf,
    /// The data folder.
    pub data: PathBuf,
    /// Measuring machines do it.
    pub elsewhere: bool,
}

/// What is replayed, and how.
pub(super) struct Order {
    pub recording: Arc<Recording>,
    pub spec: WorkloadSpec,
    pub algorithms: Vec<Arc<Algorithm>>,
}

impl Replays {
    /// Does this with a replay on a thread of its own: a jail ends with the thread that started it.
    pub(super) async fn here<T: Send + 'static>(
        &self,
        order: Order,
        stop: Stop,
        work: impl FnOnce(&Asked<'_>, &Site<'_>) -> std::result::Result<T, LabError> + Send + 'static,
    ) -> Result<T> {
        let (registry, machine, data) = (self.registry.clone(), self.machine.clone(), self.data.clone());
        let advisor = Advisor::new(&self.advisor, &machine, &data.join(SHELF));
        let (sender, ended) = tokio::sync::oneshot::channel();
        let thread = move || {
            let Order { recording, spec, algorithms } = order;
            let asked = Asked { recording: &recording, algorithms: &algorithms, seed: seed_of(&spec), spec: &spec };
            let (runner, machine, stop) = (registry.runner(), &machine, &stop);
            let site = Site { runner, machine, stop, advisor: &advisor, folder: &data };
            drop(sender.send(work(&asked, &site)));
        };
        let thread = std::thread::Builder::new().name("workload".into()).spawn(thread);
        thread.map_err(|e| EngineError::fault("Starting the replay's thread failed", e))?;
        Ok(ended.await.map_err(|_| EngineError::Fault("The replay failed; see the log.".into()))??)
    }
}

/// The seed that was asked for, or one that is drawn.
pub(super) fn seed_of(spec: &WorkloadSpec) -> u64 {
    spec.seed.unwrap_or_else(|| uuid::Uuid::new_v4().as_u64_pair().0 >> 11)
}

/// The algorithms of these names, or the usual ones, that answer at least one kind of query of the recording.
pub(super) fn algorithms_for(
    registry: &Registry,
    recording: &Recording,
    named: &[String],
    viewer: Option<&str>,
) -> Result<Vec<Arc<Algorithm>>> {
    let every = named.iter().any(|name| name == "all");
    let names: Vec<String> = if every || named.is_empty() {
        registry.algorithms(viewer).into_iter().filter(|it| every || it.usual).map(|it| it.id).collect()
    } else {
        named.to_vec()
    };
    let asked = |algorithm: &Arc<Algorithm>| {
        recording.queries.iter().any(|query| algorithm.info.queries.contains(&query.kind.query()))
    };
    let mut algorithms = Vec::new();
    for name in names {
        let algorithm = registry.named(&name, viewer)?;
        if asked(&algorithm) {
            algorithms.push(algorithm);
        } else if !named.is_empty() && !every {
            return Err(EngineError::Invalid(format!("{name} answers no kind of query of this recording.")));
        }
    }
    if algorithms.is_empty() {
        let told = "No installed algorithm answers a kind of query of this recording.";
        return Err(EngineError::Invalid(told.into()));
    }
    Ok(algorithms)
}
