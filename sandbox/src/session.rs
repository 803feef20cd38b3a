//! One jailed runner, as its supervisor uses it: start, ask, time, end.

use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::query::{Answer, Counters, Query, Semantics};

use crate::clock::{Clock, ClockFacts, ClockKind};
use crate::confine::pin;
use crate::descriptor::Descriptor;
use crate::exchange::{Exchange, Timed};
use crate::launch::{Jail, Killer};
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::{ClockChoice, Policy};
use crate::protocol::{Command, parse_answer, parse_counters, parse_descriptors};
use crate::trial::write_trial;

/// Null round trips before the first one that counts, and those that count.
const NULL_WARM_UP: usize = 100;
const NULL_SAMPLES: usize = 1000;
/// Time for them, and how many there are in any case.
const NULL_TIME: Duration = Duration::from_millis(50);
const NULL_LEAST: usize = 20;
/// A disturbed question is asked again at most so often.
const REPEATS: u32 = 3;

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
    /// Object B; the same object as A when absent, which is then built once.
    pub mesh_b: Option<&'a Mesh>,
    /// Parameters by name; those not named keep their default.
    pub parameters: &'a [(String, f64)],
    /// What counts as an object; an algorithm that does not know solid bodies answers "unsupported" for them.
    pub semantics: Semantics,
}

impl Launcher {
    /// `runner` is the path of the `ocb-runner` binary.
    pub fn new(runner: PathBuf, policy: Policy) -> Self {
        Self { runner, policy }
    }

    /// Lists the algorithms of a plugin, from inside the jail.
    pub fn describe(&self, plugin: &Path) -> Result<Vec<Descriptor>, Ending> {
        let (exchange, descriptors) = self.open(plugin, &write_trial("", &[], Semantics::Surface, &[]))?;
        exchange.jail.end(Outcome::Completed);
        Ok(descriptors)
    }

    /// Starts a fresh runner, loads the plugin and builds both objects.
    ///
    /// The jail lives no longer than the calling thread (Linux delivers the parent-death signal when the *thread* that
    /// started a process ends), so call this and everything on the [`Session`] from one thread that outlives it; the
    /// session cannot be sent elsewhere.
    pub fn start(&self, trial: &Trial<'_>) -> Result<Session, Ending> {
        let meshes: Vec<&Mesh> = std::iter::once(trial.mesh_a).chain(trial.mesh_b).collect();
        let sheet = write_trial(trial.algorithm, trial.parameters, trial.semantics, &meshes);
        let (mut exchange, _) = self.open(trial.plugin, &sheet)?;
        // Not before the jail has started: it would inherit the choice.
        let pinned = match Pinned::to(self.policy.supervisor_cpu) {
            Ok(pinned) => pinned,
            Err(outcome) => return Err(exchange.jail.end(outcome)),
        };
        let mut prepare = || -> Result<(f64, ClockFacts), Outcome> {
            let policy = &self.policy;
            exchange.obeyed(Command::Prepare, Phase::Load, policy.load_seconds)?;
            let builds = &[Command::BuildA, Command::BuildB][..meshes.len()];
            let mut build_ns = 0.0;
            for build in builds {
                build_ns += exchange.obeyed(*build, Phase::Build, policy.build_seconds)?.raw_ns;
            }
            let clock = measure_null(&mut exchange, policy)?;
            Ok(((build_ns - clock.null_median_ns * builds.len() as f64).max(clock.resolution_ns()), clock))
        };
        match prepare() {
            Ok((build_ns, clock)) => Ok(Session {
                policy: self.policy.clone(),
                exchange,
                build_ns,
                clock,
                ended: None,
                pinned,
                _thread: PhantomData,
            }),
            Err(outcome) => Err(exchange.jail.end(outcome)),
        }
    }

    /// A jail with the plugin loaded. Where this machine forbids namespaces, a trusted plugin runs without.
    fn open(&self, plugin: &Path, trial: &[u8]) -> Result<(Exchange, Vec<Descriptor>), Ending> {
        match self.open_in(plugin, trial, true) {
            Err(Ending { outcome: Outcome::SandboxFault { step, .. }, .. })
                if self.policy.trusted && NAMESPACE_STEPS.contains(&step.as_str()) =>
            {
                self.open_in(plugin, trial, false)
            }
            result => result,
        }
    }

    fn open_in(&self, plugin: &Path, trial: &[u8], namespaces: bool) -> Result<(Exchange, Vec<Descriptor>), Ending> {
        let kind = self.clock_kind();
        let jail = Jail::start(&self.runner, &self.policy, plugin, trial, kind == ClockKind::Futex, namespaces)?;
        let mut exchange = Exchange::new(jail, kind, Clock::get(), self.policy.trial_seconds);
        let mut load = || -> Result<Vec<Descriptor>, Outcome> {
            // Our own part still: its failures are faults of the sandbox.
            exchange.obeyed(Command::CloseListener, Phase::Load, self.policy.load_seconds)?;
            exchange.jail.verify(namespaces)?;
            exchange.obeyed(Command::Open, Phase::Load, self.policy.load_seconds)?;
            let text = exchange.text(Phase::Load)?;
            parse_descriptors(&text).map_err(|reason| Outcome::LoadError { reason })
        };
        match load() {
            Ok(descriptors) => Ok((exchange, descriptors)),
            Err(outcome) => Err(exchange.jail.end(outcome)),
        }
    }

    fn clock_kind(&self) -> ClockKind {
        let cpus = std::thread::available_parallelism().map_or(1, usize::from);
        match (self.policy.clock, self.policy.runner_cpu, self.policy.supervisor_cpu) {
            (ClockChoice::Spin, ..) => ClockKind::Spin,
            (ClockChoice::Futex, ..) => ClockKind::Futex,
            (ClockChoice::Auto, Some(runner), Some(supervisor)) if runner != supervisor => ClockKind::Spin,
            (ClockChoice::Auto, Some(_), Some(_)) => ClockKind::Futex,
            (ClockChoice::Auto, ..) if cpus > 1 => ClockKind::Spin,
            (ClockChoice::Auto, ..) => ClockKind::Futex,
        }
    }
}

/// Steps that fail where a machine forbids namespaces or what is done inside them.
const NAMESPACE_STEPS: [&str; 9] =
    ["Namespaces", "IdMaps", "Groups", "Ids", "PrivateMounts", "EmptyRoot", "Library", "EnterRoot", "ReadOnlyRoot"];

/// Asks nothing so often that the round trip and its spread are known; on a machine too busy for that, as often as fits
/// into a twentieth of a second.
fn measure_null(exchange: &mut Exchange, policy: &Policy) -> Result<ClockFacts, Outcome> {
    let begun = Instant::now();
    let (mut good, mut all) = (Vec::with_capacity(NULL_SAMPLES), Vec::with_capacity(NULL_SAMPLES));
    for i in 0..NULL_WARM_UP + NULL_SAMPLES {
        let trip = exchange.obeyed(Command::Null, Phase::Query, policy.query_seconds)?;
        let late = begun.elapsed() > NULL_TIME;
        if i >= NULL_WARM_UP || late {
            all.push(trip.raw_ns);
            if !exchange.disturbed(&trip) {
                good.push(trip.raw_ns);
            }
        }
        if late && all.len() >= NULL_LEAST {
            break;
        }
    }
    Ok(ClockFacts::of(exchange.kind(), if good.is_empty() { all } else { good }))
}

/// One running jail with a loaded plugin and built objects. Dropping it kills the jail.
pub struct Session {
    policy: Policy,
    exchange: Exchange,
    build_ns: f64,
    clock: ClockFacts,
    ended: Option<Outcome>,
    pinned: Pinned,
    /// The jail dies with the thread that started it, so the session stays there.
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

impl Session {
    /// Time to build the objects, nanoseconds, by the supervisor's clock.
    pub fn build_ns(&self) -> f64 {
        self.build_ns
    }

    /// How the clock behaved.
    pub fn clock(&self) -> &ClockFacts {
        &self.clock
    }

    /// The layers of the jail in force, one short phrase each.
    pub fn layers(&self) -> &[String] {
        &self.exchange.jail.layers
    }

    /// Process id of the runner, as this process sees it.
    pub fn pid(&self) -> i32 {
        self.exchange.jail.pid
    }

    /// Asks one question and times the answer. After an error the session has ended; [`Session::finish`] tells the rest.
    pub fn query(&mut self, query: Query, configuration: &Configuration) -> Result<Sample, Outcome> {
        let mut disturbed = 0;
        loop {
            let (timed, answer, _) = self.ask(query, configuration, false)?;
            if self.exchange.disturbed(&timed) && disturbed < REPEATS {
                disturbed += 1;
                continue;
            }
            let (time_ns, below_resolution) = self.clock.subtract(timed.raw_ns);
            return Ok(Sample { raw_ns: timed.raw_ns, time_ns, below_resolution, disturbed, answer });
        }
    }

    /// Asks one question untimed, with counters where the plugin has them.
    pub fn count(
        &mut self,
        query: Query,
        configuration: &Configuration,
    ) -> Result<(Answer, Option<Counters>), Outcome> {
        self.ask(query, configuration, true).map(|(_, answer, counters)| (answer, counters))
    }

    fn ask(
        &mut self,
        query: Query,
        configuration: &Configuration,
        counted: bool,
    ) -> Result<(Timed, Answer, Option<Counters>), Outcome> {
        if let Some(outcome) = &self.ended {
            return Err(outcome.clone());
        }
        let mut ask = || -> Result<_, Outcome> {
            self.exchange.place(configuration);
            let command = Command::ask(query, counted);
            self.exchange.wake(self.policy.query_seconds)?;
            let timed = self.exchange.obeyed(command, Phase::Query, self.policy.query_seconds)?;
            let contacts = if query == Query::CollisionAll { self.exchange.contacts() } else { Vec::new() };
            let slot = self.exchange.slot();
            let answer = parse_answer(query, slot, &contacts)
                .map_err(|rule| Outcome::ProtocolViolation { phase: Phase::Query, rule })?;
            Ok((timed, answer, parse_counters(slot).filter(|_| counted)))
        };
        let result = ask();
        if let Err(outcome) = &result {
            self.ended = Some(outcome.clone());
        }
        result
    }

    /// A handle that ends this session from another thread.
    pub fn killer(&self) -> Killer {
        self.exchange.jail.killer()
    }

    /// Ends the runner, reaps it and says how it went. It is killed, not asked: everything that counts has been read by
    /// then, and a plugin's destructors have no business with us.
    pub fn finish(self) -> Ending {
        let Session { exchange, ended, pinned, .. } = self;
        let ending = exchange.jail.end(ended.unwrap_or(Outcome::Completed));
        drop(pinned);
        ending
    }
}

/// Keeps the calling thread on one CPU until dropped.
struct Pinned(Option<Vec<usize>>);

impl Pinned {
    fn to(cpu: Option<usize>) -> Result<Self, Outcome> {
        let Some(cpu) = cpu else { return Ok(Pinned(None)) };
        match pin(&[cpu]) {
            Ok(before) => Ok(Pinned(Some(before))),
            Err(error) => Err(Outcome::fault("Cpu", format!("the supervisor cannot run on CPU {cpu}: {error}"))),
        }
    }
}

impl Drop for Pinned {
    fn drop(&mut self) {
        if let Some(before) = self.0.take() {
            // Where it may not run any more it stays where it is: no harm to anybody.
            let _ = pin(&before);
        }
    }
}
