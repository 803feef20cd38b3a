//! Replaying recordings on this machine.

use std::sync::Arc;

use ocb_lab::algorithm::Algorithm;
use ocb_lab::recording::Recording;
use ocb_lab::workload::{self, Progress, Replayed, Wanted};

use crate::boxed;
use crate::engine::Engine;
use crate::measure::Stop;
use crate::model::Track;
use crate::stability::work::right_to_measure;
use crate::{EngineError, Result};

/// How a recording is replayed.
#[derive(Clone, Debug)]
pub struct WorkloadSpec {
    /// Names of algorithms, with settings; empty: the usual ones. `all` stands for every algorithm.
    pub algorithms: Vec<String>,
    /// The orders.
    pub tracks: Vec<Track>,
    /// Processes per algorithm, order and pair of objects.
    pub passes: u32,
    /// Measuring time per algorithm and order, in seconds.
    pub budget_seconds: f64,
    /// Seed of the orders and of the equivalent instances; drawn when absent.
    pub seed: Option<u64>,
}

impl Engine {
    /// Replays a recording with algorithms that answer at least one of its kinds of query.
    #[boxed]
    pub async fn replay_workload(
        &self,
        recording: Arc<Recording>,
        spec: WorkloadSpec,
        stop: Stop,
        tell: impl Fn(Progress) + Send + 'static,
        waits: impl FnOnce() + Send + 'static,
    ) -> Result<Replayed> {
        let algorithms = self.algorithms_for(&recording, &spec.algorithms)?;
        let inner = Arc::clone(&self.inner);
        let (sender, replayed) = tokio::sync::oneshot::channel();
        let work = move || {
            let _right = right_to_measure(&stop, waits)?;
            let wanted = Wanted {
                algorithms: &algorithms,
                tracks: &spec.tracks,
                passes: spec.passes,
                budget: std::time::Duration::from_secs_f64(spec.budget_seconds),
                seed: spec.seed.unwrap_or_else(|| uuid::Uuid::new_v4().as_u64_pair().0 >> 11),
            };
            workload::replay(&recording, &wanted, inner.registry.runner(), &inner.machine, &stop, &tell)
        };
        let thread = std::thread::Builder::new().name("workload".into()).spawn(move || drop(sender.send(work())));
        thread.map_err(|e| EngineError::fault("Starting the replay's thread failed", e))?;
        Ok(replayed.await.map_err(|_| EngineError::Fault("The replay failed; see the log.".into()))??)
    }

    fn algorithms_for(&self, recording: &Recording, named: &[String]) -> Result<Vec<Arc<Algorithm>>> {
        let registry = &self.inner.registry;
        let every = named.iter().any(|name| name == "all");
        let names: Vec<String> = if every || named.is_empty() {
            registry.algorithms(None).into_iter().filter(|info| every || info.usual).map(|info| info.id).collect()
        } else {
            named.to_vec()
        };
        let asked = |algorithm: &Arc<Algorithm>| {
            recording.queries.iter().any(|query| algorithm.info.queries.contains(&query.kind.query()))
        };
        let mut algorithms = Vec::new();
        for name in names {
            let algorithm = self.inner.stability_algorithm(&name, None)?;
            if asked(&algorithm) {
                algorithms.push(algorithm);
            } else if !named.is_empty() && !every {
                return Err(EngineError::Invalid(format!("{name} answers no kind of query of this recording.")));
            }
        }
        Ok(algorithms)
    }
}
