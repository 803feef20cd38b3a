//! Machines of a Slurm cluster: the housekeeper sees to it that each free node has a job while runs wait. A job is `ocb work --once`,
//! which takes whatever run is next when the node has started it; so the order of the queue needs nothing of Slurm.

use std::time::Duration;

use ocb_slurm::Slurm;
use url::Url;

use crate::blocking::blocking;
use crate::config::SlurmJobs;
use crate::engine::Engine;
use crate::{EngineError, Result, sha256_hex};

/// How often jobs and runs are compared.
const STEP: Duration = Duration::from_secs(2);

impl Engine {
    /// Keeps the cluster supplied with jobs, while this service keeps house.
    pub(crate) async fn supply(self, jobs: SlurmJobs) {
        let inner = &self.inner;
        // Two services may use one cluster, and each must know its own jobs. Everybody on the cluster sees the name.
        let database = inner.config.database_url.as_deref().and_then(without_password);
        let database = database.as_deref().unwrap_or(&inner.worker.machine);
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

/// Host, port and name of a database.
fn without_password(url: &str) -> Option<String> {
    let url = Url::parse(url).ok()?;
    Some(format!("{}:{}{}", url.host_str()?, url.port().unwrap_or(5432), url.path()))
}

#[test]
fn the_name_of_jobs_does_not_depend_on_a_password() {
    let [plain, other] = ["postgres://a:secret@db/ocb", "postgres://a:other@db:5432/ocb"].map(without_password);
    assert_eq!((plain.as_deref(), other.as_deref()), (Some("db:5432/ocb"), Some("db:5432/ocb")));
}
