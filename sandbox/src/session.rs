//! The supervisor's side of one jailed runner.

use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::query::{Answer, Counters, Query};

use crate::descriptor::Descriptor;
use crate::outcome::{Ending, Outcome};
use crate::policy::Policy;

/// Starts runners under one policy.
#[derive(Clone, Debug)]
pub struct Launcher {
    runner: PathBuf,
    policy: Policy,
}

/// What one runner is started for.
#[derive(Clone, Copy, Debug)]
pub struct Trial<'a> {
    /// The plugin file.
    pub plugin: &'a Path,
    /// Id of the algorithm in it.
    pub algorithm: &'a str,
    /// Object A.
    pub mesh_a: &'a Mesh,
    /// Object B; the same mesh as A when absent (it is still built a second time).
    pub mesh_b: Option<&'a Mesh>,
    /// Parameters by name; those not named keep their default.
    pub parameters: &'a [(String, f64)],
}

impl Launcher {
    /// `runner` is the path of the `ocb-runner` binary.
    pub fn new(runner: PathBuf, policy: Policy) -> Self {
        Self { runner, policy }
    }

    /// Lists the algorithms of a plugin, from inside the jail.
    pub fn describe(&self, plugin: &Path) -> Result<Vec<Descriptor>, Ending> {
        Err(self.not_yet(plugin))
    }

    /// Starts a fresh runner, loads the plugin and builds both objects.
    ///
    /// The jail lives no longer than the calling thread (Linux delivers the parent-death signal when the *thread* that
    /// started a process ends), so call this and everything on the [`Session`] from one thread that outlives it; the
    /// session cannot be sent elsewhere.
    pub fn start(&self, trial: &Trial<'_>) -> Result<Session, Ending> {
        Err(self.not_yet(trial.plugin))
    }

    fn not_yet(&self, plugin: &Path) -> Ending {
        Outcome::fault(
            "start",
            format!("{} cannot run {} yet ({:?})", self.runner.display(), plugin.display(), self.policy),
        )
        .into()
    }
}

/// One running jail with a loaded plugin and two built objects. Dropping it kills the jail.
pub struct Session {
    build_ns: f64,
    clock: ClockFacts,
    layers: Vec<String>,
    pid: i32,
    killer: Killer,
    ended: Ending,
    _thread: PhantomData<*const ()>,
}

/// One timed answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// From the question's release to the seen answer, by the supervisor's clock.
    pub raw_ns: f64,
    /// `raw_ns` minus the session's median null round trip; the clock's resolution when below it, never 0.
    pub time_ns: f64,
    /// `time_ns` is only an upper bound.
    pub below_resolution: bool,
    /// How often the question was repeated because the supervisor missed the moment of the answer.
    pub disturbed: u32,
    /// What the plugin answered.
    pub answer: Answer,
}

/// How the clock of one session behaved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockFacts {
    /// Which hand-off.
    pub kind: ClockKind,
    /// Median round trip of a question that the runner answers without the plugin, nanoseconds.
    pub null_median_ns: f64,
    /// Its 5th percentile.
    pub null_p05_ns: f64,
    /// Its 95th percentile.
    pub null_p95_ns: f64,
}

/// Which hand-off a session uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClockKind {
    /// Two CPUs, each side watching shared memory.
    Spin,
    /// One CPU, each side sleeping in turn.
    Futex,
}

impl ClockKind {
    /// `spin` or `futex`.
    pub fn as_str(self) -> &'static str {
        match self {
            ClockKind::Spin => "spin",
            ClockKind::Futex => "futex",
        }
    }
}

/// Ends a session from another thread.
#[derive(Clone, Debug)]
pub struct Killer {
    asked: Arc<std::sync::atomic::AtomicBool>,
}

impl Killer {
    /// Kills the jail; the session's outcome becomes [`Outcome::Cancelled`]. Harmless when it has ended already.
    pub fn kill(&self) {
        self.asked.store(true, std::sync::atomic::Ordering::SeqCst);
    }
}

impl Session {
    /// Time to build both objects, nanoseconds, by the supervisor's clock.
    pub fn build_ns(&self) -> f64 {
        self.build_ns
    }

    /// How the clock behaved.
    pub fn clock(&self) -> &ClockFacts {
        &self.clock
    }

    /// The layers of the jail in force, one short phrase each.
    pub fn layers(&self) -> &[String] {
        &self.layers
    }

    /// Process id of the runner, as this process sees it.
    pub fn pid(&self) -> i32 {
        self.pid
    }

    /// Asks one question and times the answer. After an error the session has ended; [`Session::finish`] tells the rest.
    pub fn query(&mut self, _query: Query, _configuration: &Configuration) -> Result<Sample, Outcome> {
        Err(self.ended.outcome.clone())
    }

    /// Asks one question untimed, with counters where the plugin has them.
    pub fn count(
        &mut self,
        _query: Query,
        _configuration: &Configuration,
    ) -> Result<(Answer, Option<Counters>), Outcome> {
        Err(self.ended.outcome.clone())
    }

    /// A handle that ends this session from another thread.
    pub fn killer(&self) -> Killer {
        self.killer.clone()
    }

    /// Asks the runner to leave, reaps it and says how it went.
    pub fn finish(self) -> Ending {
        self.ended
    }
}
