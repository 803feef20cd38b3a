//! Replaying recordings on this machine.

use std::path::PathBuf;
use std::sync::Arc;

use ocb_lab::LabError;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::recording::Recording;
use ocb_lab::workload::{self, Progress, Replayed, Wanted};

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
}

impl Replays {
    /// On a thread of its own: a jail ends with the thread that started it.
    pub(super) async fn replay(
        &self,
        recording: Arc<Recording>,
        spec: WorkloadSpec,
        algorithms: Vec<Arc<Algorithm>>,
        stop: Stop,
        tell: impl Fn(Progress) + Send + 'static,
        waits: impl FnOnce() + Send + 'static,
    ) -> Result<Replayed> {
        let (registry, machine) = (self.registry.clone(), self.machine.clone());
        let (sender, replayed) = tokio::sync::oneshot::channel();
        let work = move || {
            let _right = stop.right_to_measure(waits)?.ok_or(LabError::Stopped)?;
            let wanted = Wanted {
                algorithms: &algorithms,
                tracks: &spec.tracks,
                passes: spec.passes,
                budget: std::time::Duration::from_secs_f64(spec.budget_seconds),
                seed: spec.seed.unwrap_or_else(|| uuid::Uuid::new_v4().as_u64_pair().0 >> 11),
            };
            workload::replay(&recording, &wanted, registry.runner(), &machine, &stop, &tell)
        };
        let thread = std::thread::Builder::new().name("workload".into()).spawn(move || drop(sender.send(work())));
        thread.map_err(|e| EngineError::fault("Starting the replay's thread failed", e))?;
        Ok(replayed.await.map_err(|_| EngineError::Fault("The replay failed; see the log.".into()))??)
    }
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
