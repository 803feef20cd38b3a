//! Where an engine finds its folder, its runner and its plugins.

use std::path::{Path, PathBuf};
use std::time::Duration;

pub use ocb_sandbox::Profile;

use crate::mail::MailServer;
use ocb_lab::advisor::PROGRAM;
use ocb_lab::check::CHECK_LIMIT;

/// Limits of the measuring time that visitors may have queued and running: budget times algorithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceilings {
    /// One run of a guest, from its start to its end.
    pub guest_run: Duration,
    /// Queued and running runs of one guest.
    pub guest: Duration,
    /// Of one account.
    pub account: Duration,
    /// Of all visitors from one address.
    pub address: Duration,
}

impl Default for Ceilings {
    fn default() -> Self {
        let minutes = |n: u64| Duration::from_secs(60 * n);
        Self { guest_run: minutes(10), guest: minutes(30), account: minutes(12 * 60), address: minutes(24 * 60) }
    }
}

/// The partitions whose nodes measure, and the program that each job runs there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlurmJobs {
    /// The partitions; the nodes of each are of one hardware class.
    pub partitions: Vec<String>,
    /// A program on each node that runs `ocb work --once` with the node's token.
    pub program: String,
}

/// How to open an [`crate::Engine`].
#[derive(Clone, Debug)]
pub struct EngineConfig {
    /// The data folder: database, blobs and lock file, made when absent. One process at a time may open it.
    pub data: PathBuf,
    /// `postgres://...`; an SQLite file in the data folder when absent.
    pub database_url: Option<String>,
    /// `s3://bucket/prefix?endpoint=http://host:port` (credentials from `AWS_*`); a folder in the data folder when absent.
    pub blob_url: Option<String>,
    /// The `ocb-runner` binary, the only program that ever loads a plugin.
    pub runner: PathBuf,
    /// The `ocb-advisor` binary, which does the advisor's work in the jail.
    pub advisor: PathBuf,
    /// Plugin files, or folders whose `*.so` are plugins.
    pub plugins: Vec<PathBuf>,
    /// How much a foreign plugin needs of this machine; results of the development profile are not ranked.
    pub profile: Profile,
    /// Folder with `bunny.obj` and `dragon.obj`, each with its terms in `<name>.terms`.
    pub stock_dir: Option<PathBuf>,
    /// The file of the suite to measure public plugins on; the newest that ships when absent.
    pub suite: Option<PathBuf>,
    /// What distinguishes this machine though the kernel does not tell, such as a clock that was fixed: part of its hardware
    /// class.
    pub machine_note: Option<String>,
    /// Time of a whole check of a plugin, shared by its algorithms.
    pub check_limit: Duration,
    /// Checks ask only the short part of their questions, as `ocb plugin check --quick` does. For tests about other things.
    pub quick_checks: bool,
    /// Advice asks a few dozen configurations of each kind. For tests about other things.
    pub quick_advice: bool,
    /// Work on the queue. Off for commands that only read.
    pub dispatch: bool,
    /// Runs are only prepared here; measuring machines take them over HTTP.
    pub elsewhere: bool,
    /// A machine whose sentinel is off by more than this share gets no run.
    pub most_drift: f64,
    /// The measuring machines are nodes of a Slurm cluster.
    pub slurm: Option<SlurmJobs>,
    /// When nothing is asked for, measure what of the suite is missing, and try the installed algorithms for stability.
    pub idle: bool,
    /// Queue a quick run for the start page when there is none yet.
    pub featured: bool,
    /// At the start, queue what the suite misses of submitted plugins that are public.
    pub catch_up: bool,
    /// Days that what guests make stays after they last made something or asked to have it kept.
    pub guest_days: u32,
    /// How much measuring time visitors may have at once.
    pub ceilings: Ceilings,
    /// Who takes our mails; nothing is mailed when absent.
    pub mail: Option<MailServer>,
}

impl EngineConfig {
    /// With runner and plugins beside the running executable, SQLite and a local folder; dispatching, nothing measured unasked.
    pub fn beside_executable(data: impl Into<PathBuf>) -> Self {
        let folder = std::env::current_exe()
            .ok()
            .and_then(|exe| exe.parent().map(Path::to_path_buf))
            .unwrap_or_else(|| PathBuf::from("."));
        Self {
            data: data.into(),
            database_url: None,
            blob_url: None,
            runner: folder.join("ocb-runner"),
            advisor: folder.join(PROGRAM),
            plugins: vec![folder],
            profile: Profile::Production,
            stock_dir: None,
            suite: None,
            machine_note: None,
            check_limit: CHECK_LIMIT,
            quick_checks: false,
            quick_advice: false,
            dispatch: true,
            elsewhere: false,
            most_drift: 0.03,
            slurm: None,
            idle: false,
            featured: false,
            catch_up: false,
            guest_days: 30,
            ceilings: Ceilings::default(),
            mail: None,
        }
    }

    /// The database's address, if it is PostgreSQL.
    #[cfg(feature = "postgres")]
    pub(crate) fn postgres_url(&self) -> Option<&str> {
        self.database_url.as_deref().filter(|url| url.starts_with("postgres://") || url.starts_with("postgresql://"))
    }
}
