//! Jobs on the machines of a Slurm cluster. Each job runs one command, which takes the next waiting run from the service and
//! measures it. So Slurm decides on which node and when, and the database of the service decides which run is next: the jobs
//! are all alike, and a job that finds no run ends at once.
//!
//! Nothing is remembered between two calls. [`Slurm::settle`] looks at what Slurm has and mends the difference to what it
//! should have, so jobs that Slurm forgot (slurmctld writes its state every few seconds) are submitted again.
//!
//! The programs of Slurm (`squeue`, `sinfo`, `sbatch`, `scancel`) must be installed. They get no variables of the environment
//! but `PATH` and `SLURM_CONF`: others change what they print, and `sbatch` would copy all of them, secrets too, into the job.
//! So a job has no `HOME` either.
//!
//! After slurmctld was killed (SIGKILL, measured with 22.05.8): it forgets jobs of the last seconds, and gives their ids to other
//! jobs; when it is back, it kills forgotten jobs that run, and starts some a second time. A run that was measured there is lost
//! until the service notices that its lease has expired.
#![forbid(unsafe_code)]

mod call;
mod error;
mod list;
mod plan;
mod script;

use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

pub use error::Error;
pub use list::{Job, Nodes, State};
pub use plan::{Plan, plan};

/// The time limit of each call. Without slurmctld the programs of Slurm try again for 9 s by themselves, `scancel` for 18 s.
const LIMIT: Duration = Duration::from_secs(20);

/// The jobs of one service in one partition of a cluster.
#[derive(Clone, Debug)]
pub struct Slurm {
    partition: String,
    name: String,
    script: String,
    configuration: Option<PathBuf>,
}

/// What [`Slurm::settle`] found and did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settled {
    /// The jobs as they were before.
    pub jobs: Vec<Job>,
    /// The nodes.
    pub nodes: Nodes,
    /// Jobs that were submitted.
    pub submitted: Vec<u64>,
    /// Pending jobs that were superfluous and were cancelled.
    pub cancelled: Vec<u64>,
}

impl Slurm {
    /// Jobs of this name in this partition, each running `command` (a program and its arguments). All jobs of this user that
    /// have the name and the partition are taken for the service's own, so each service needs a name of its own.
    ///
    /// Other users of the cluster can see the command: secrets stand in files that it names.
    pub fn new(partition: &str, name: &str, command: &[String]) -> Result<Self, Error> {
        for name in [partition, name] {
            if !is_name(name) {
                return Err(Error::Name(name.to_owned()));
            }
        }
        let script = script::script(command)?;
        Ok(Self { partition: partition.to_owned(), name: name.to_owned(), script, configuration: None })
    }

    /// Uses this `slurm.conf` (an absolute path), not the one that `SLURM_CONF` names or Slurm finds by itself.
    pub fn configured_by(self, file: impl Into<PathBuf>) -> Self {
        Self { configuration: Some(file.into()), ..self }
    }

    /// Does one step: counts jobs and nodes, then submits the jobs that are missing or cancels pending ones that are
    /// superfluous. Fails at the first call that fails; the next step finds what this one has done.
    pub fn settle(&self, waiting_runs: usize) -> Result<Settled, Error> {
        let jobs = self.jobs()?;
        let nodes = self.nodes()?;
        let plan = plan(waiting_runs, &jobs, nodes.usable());
        let submitted = (0..plan.submit).map(|_| self.submit()).collect::<Result<_, _>>()?;
        self.cancel_pending(&plan.cancel)?;
        Ok(Settled { jobs, nodes, submitted, cancelled: plan.cancel })
    }

    /// The jobs of the service that have not ended.
    pub fn jobs(&self) -> Result<Vec<Job>, Error> {
        let (name, partition) = (format!("--name={}", self.name), self.in_partition());
        list::jobs(&self.call("squeue", &["--noheader", "--me", &name, &partition, "--format=%A %T"], "")?)
    }

    /// The nodes of the partition that work or could begin a job now.
    pub fn nodes(&self) -> Result<Nodes, Error> {
        let said = self.call("sinfo", &["--noheader", "--Node", &self.in_partition(), "--format=%N %a %T"], "")?;
        // sinfo does not fail on a partition that does not exist.
        let unknown = || Error::Partition(self.partition.clone());
        list::nodes(&said)?.ok_or_else(unknown)
    }

    /// Submits one job and returns its id. It takes a node for itself and is not repeated when the node fails: the service
    /// itself makes further attempts at a run.
    pub fn submit(&self) -> Result<u64, Error> {
        let (name, partition) = (format!("--job-name={}", self.name), self.in_partition());
        // Limits of processes (`ulimit`) are those of the node, not those of the service.
        let fixed =
            ["--parsable", "--no-requeue", "--exclusive", "--nodes=1", "--propagate=NONE", "--output=/dev/null"];
        list::submitted(&self.call("sbatch", &[&fixed[..], &[&name, &partition]].concat(), &self.script)?)
    }

    /// Cancels those of these jobs that are still pending. A job that has started meanwhile runs on, and it is no error when
    /// Slurm does not know a job any more.
    pub fn cancel_pending(&self, ids: &[u64]) -> Result<(), Error> {
        if ids.is_empty() {
            return Ok(());
        }
        let ids: Vec<String> = ids.iter().map(u64::to_string).collect();
        let words: Vec<&str> = ["--state=PENDING"].into_iter().chain(ids.iter().map(String::as_str)).collect();
        let unknown = |line: &String| line.contains("Invalid job id");
        match self.call("scancel", &words, "") {
            Err(Error::Failed { said, .. }) if !said.is_empty() && said.iter().all(unknown) => Ok(()),
            done => done.map(drop),
        }
    }

    fn in_partition(&self) -> String {
        format!("--partition={}", self.partition)
    }

    fn call(&self, program: &'static str, arguments: &[&str], input: &str) -> Result<String, Error> {
        #[expect(
            clippy::disallowed_methods,
            reason = "Slurm is spoken to by its own programs, which the operator installed"
        )]
        let mut command = Command::new(program);
        // A job works in the folder in which it was submitted, and `/` is there on each node.
        command.args(arguments).current_dir("/").env_clear();
        command.envs(["PATH", "SLURM_CONF"].into_iter().filter_map(|name| Some((name, std::env::var_os(name)?))));
        command.envs(self.configuration.iter().map(|file| ("SLURM_CONF", file)));
        call::call(program, command, input, LIMIT)
    }
}

/// Slurm separates names by commas and knows patterns in brackets.
fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_refused_that_slurm_would_take_apart() {
        let refused = |partition, name| Slurm::new(partition, name, &["ocb".to_owned()]).unwrap_err().to_string();
        let about =
            |name: &str| format!("{name:?} cannot name a partition or a job: only letters, digits, '-', '_', '.'.");
        assert_eq!(refused("a,b", "ocb-1"), about("a,b"));
        assert_eq!(refused("measuring", ""), about(""));
        assert_eq!(refused("measuring", "ocb 1"), about("ocb 1"));
        assert!(Slurm::new("measuring", "ocb-1.a_B", &["ocb".to_owned()]).is_ok());
    }
}
