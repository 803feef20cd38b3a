//! Machines of a Slurm cluster: the housekeeper sees to it that each free node has a job while runs wait. A job is `ocb work --once`,
//! which takes whatever run is next when the node has started it; so the order of the queue needs nothing of Slurm. The nodes of a
//! partition are of one hardware class, which they tell with their first request; until then they are taken for the usual one.

use std::time::Duration;

use ocb_slurm::Slurm;
use url::Url;

use crate::blocking::blocking;
use crate::config::SlurmJobs;
use crate::engine::Engine;
use crate::model::{MachineFacts, MachineInfo};
use crate::runs::share::OfClass;
use crate::{EngineError, Result, sha256_hex};

/// How often jobs and runs are compared.
const STEP: Duration = Duration::from_secs(2);

impl Engine {
    /// Keeps the cluster supplied with jobs, while this service keeps house.
    pub(crate) async fn supply(self, jobs: SlurmJobs) {
        let inner = &self.inner;
        // Two services may use one cluster, and each must know its own jobs. Everybody on the cluster sees the name.
        let database = inner.config.database_url.as_deref().and_then(without_password);
        let database = database.as_deref().unwrap_or(&inner.work.worker.machine);
        let name = format!("ocb-{}", &sha256_hex(database.as_bytes())[..12]);
        let mut partitions = Vec::new();
        for partition in jobs.partitions {
            match Slurm::new(&partition, &name, std::slice::from_ref(&jobs.program)) {
                Ok(slurm) => partitions.push((partition, slurm)),
                Err(e) => return tracing::error!("no jobs are submitted: {e}"),
            }
        }
        let mut failing = None;
        while inner.house.here().await {
            tokio::select! {
                () = tokio::time::sleep(STEP) => {}
                () = inner.house.gone() => continue,
            }
            let failed = self.supplied(&partitions).await.err().map(|e| e.to_string());
            match &failed {
                // It may go on for hours, and is said once.
                Some(why) if failed != failing => tracing::error!("measuring machines may be missing: {why}"),
                None if failing.is_some() => tracing::info!("jobs are submitted again"),
                _ => {}
            }
            failing = failed;
        }
    }

    /// One partition that cannot be had keeps no other from its jobs.
    async fn supplied(&self, partitions: &[(String, Slurm)]) -> Result<()> {
        let (machines, usual) = (self.inner.store.machines().await?, self.inner.classes.usual());
        let mut all = Ok(());
        for (partition, slurm) in partitions {
            let class = class_of(&machines, partition).unwrap_or_else(|| usual.clone());
            let waiting = self.inner.store.waiting_for_machines(&OfClass { class, usual: usual.clone() }).await?;
            let slurm = slurm.clone();
            let settled = blocking(move || {
                let settled = slurm.settle(waiting as usize).map_err(|e| EngineError::Fault(e.to_string()))?;
                if !settled.submitted.is_empty() || !settled.cancelled.is_empty() {
                    tracing::debug!(?settled, waiting, "jobs");
                }
                Ok(())
            });
            all = settled.await.and(all);
        }
        all
    }
}

/// The class of the nodes of a partition, once one of them has asked for a run.
fn class_of(machines: &[MachineInfo], partition: &str) -> Option<String> {
    let measuring = machines.iter().filter(|machine| machine.revoked_us.is_none());
    let of_partition = |facts: &&MachineFacts| facts.partition.as_deref() == Some(partition);
    let facts = measuring.filter_map(|machine| machine.facts.as_ref()).find(of_partition);
    facts.map(|facts| facts.hardware_class.clone())
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

#[test]
fn a_partition_has_the_class_that_its_nodes_tell() {
    let node = |name: &str, class: &str, partition: Option<&str>, revoked_us| MachineInfo {
        name: name.into(),
        facts: Some(MachineFacts {
            version: "1".into(),
            runner_sha256: String::new(),
            plugins: Vec::new(),
            hardware_class: class.into(),
            cpu: String::new(),
            kernel: String::new(),
            microcode: String::new(),
            governor: String::new(),
            profile: "production".into(),
            partition: partition.map(str::to_owned),
        }),
        created_us: 0,
        seen_us: Some(0),
        revoked_us,
        run: None,
        trouble: None,
        drift: None,
    };
    let nodes = [
        node("a", "old", Some("new-nodes"), Some(1)),
        node("b", "here", None, None),
        node("c", "usual", Some("nodes"), None),
        node("d", "new", Some("new-nodes"), None),
    ];
    let of = |partition| class_of(&nodes, partition);
    assert_eq!((of("nodes").as_deref(), of("new-nodes").as_deref()), (Some("usual"), Some("new")), "one is revoked");
    assert_eq!(of("others"), None, "no node has asked yet");
}
