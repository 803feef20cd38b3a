//! Machines of a Slurm cluster: the housekeeper sees to it that each free node has a job while runs wait. A job is `ocb work --once`,
//! which takes whatever run is next when the node has started it; so the order of the queue needs nothing of Slurm.

use std::time::Duration;

use ocb_slurm::Slurm;

use crate::blocking::blocking;
use crate::engine::Engine;
use crate::{EngineError, Result, sha256_hex};

/// How often jobs and runs are compared.
const STEP: Duration = Duration::from_secs(2);

/// The partition whose nodes measure, and the program that each job runs there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlurmJobs {
    /// The partition; its nodes are of one hardware class.
    pub partition: String,
    /// A program on each node that runs `ocb work --once` with the node's token.
    pub program: String,
}

impl Engine {
    /// Keeps the cluster supplied with jobs, while this service keeps house.
    pub(crate) async fn supply(self, jobs: SlurmJobs) {
        let inner = &self.inner;
        // Two services may use one cluster, and each must know its own jobs.
        let database = inner.config.database_url.as_deref().unwrap_or(&inner.worker.machine);
        let name = format!("ocb-{}", &sha256_hex(database.as_bytes())[..12]);
        let slurm = match Slurm::new(&jobs.partition, &name, &[jobs.program]) {
            Ok(slurm) => slurm,
            Err(e) => return tracing::error!("no jobs are submitted: {e}"),
        };
        let mut failing = None;
        while inner.house.here().await {
            tokio::select! {
                () = tokio::time::sleep(STEP) => {}
                () = inner.house.gone() => continue,
            }
            let failed = self.supplied(&slurm).await.err().map(|e| e.to_string());
            match &failed {
                // It may go on for hours, and is said once.
                Some(why) if failed != failing => tracing::error!("measuring machines may be missing: {why}"),
                None if failing.is_some() => tracing::info!("jobs are submitted again"),
                _ => {}
            }
            failing = failed;
        }
    }

    async fn supplied(&self, slurm: &Slurm) -> Result<()> {
        let (waiting, slurm) = (self.inner.store.prepared_runs().await?, slurm.clone());
        blocking(move || {
            let settled = slurm.settle(waiting as usize).map_err(|e| EngineError::Fault(e.to_string()))?;
            if !settled.submitted.is_empty() || !settled.cancelled.is_empty() {
                tracing::debug!(?settled, waiting, "jobs");
            }
            Ok(())
        })
        .await
    }
}
