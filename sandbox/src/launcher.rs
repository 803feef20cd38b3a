//! From a plugin file to a session that can be asked, or to what the file says of itself.

use std::path::{Path, PathBuf};

use ocb_core::mesh::Mesh;
use ocb_core::query::{Query, Semantics};

use crate::brought;
use crate::clock::{Clock, ClockFacts};
use crate::cpus::Places;
use crate::descriptor::Descriptor;
use crate::evidence::status_field;
use crate::exchange::{Exchange, Resting};
use crate::gate::{Build, Inspection};
use crate::launch::{Jail, Killer};
use crate::layers::Profile;
use crate::null;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Answers, Command, parse_answers, parse_descriptors, parse_inspection};
use crate::seccomp;
use crate::session::{Pinned, Session, SetUp};
use crate::trial::Sheet;

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
    /// What it loads.
    pub objects: Objects<'a>,
    /// Parameters by name; those not named keep their default.
    pub parameters: &'a [(String, f64)],
    /// What counts as an object; an algorithm that does not know solid bodies answers "unsupported" for them.
    pub semantics: Semantics,
}

/// What a process loads.
#[derive(Clone, Copy, Debug)]
pub enum Objects<'a> {
    /// Object A and object B; the same object as A when absent, which is then built once.
    Pair(&'a Mesh, Option<&'a Mesh>),
    /// A scene of many objects, each built once; for algorithms that offer `ocb.scene/1`.
    Scene(&'a [&'a Mesh]),
}

impl<'a> Objects<'a> {
    /// In the order of building.
    pub(crate) fn meshes(&self) -> impl Iterator<Item = &'a Mesh> {
        let (pair, scene) = match *self {
            Objects::Pair(a, b) => (Some((a, b)), &[][..]),
            Objects::Scene(meshes) => (None, meshes),
        };
        pair.into_iter().flat_map(|(a, b)| std::iter::once(a).chain(b)).chain(scene.iter().copied())
    }

    /// How many a question may name.
    fn count(&self) -> u32 {
        match self {
            Objects::Pair(..) => 2,
            Objects::Scene(meshes) => meshes.len() as u32,
        }
    }
}

impl<'a> Trial<'a> {
    /// A pair: surfaces, and every parameter at its default.
    pub fn new(plugin: &'a Path, algorithm: &'a str, mesh_a: &'a Mesh, mesh_b: Option<&'a Mesh>) -> Self {
        Self::of(plugin, algorithm, Objects::Pair(mesh_a, mesh_b))
    }

    /// Surfaces, and every parameter at its default.
    pub fn of(plugin: &'a Path, algorithm: &'a str, objects: Objects<'a>) -> Self {
        Self { plugin, algorithm, objects, parameters: &[], semantics: Semantics::Surface }
    }
}

impl Launcher {
    /// `runner` is the path of the `ocb-runner` binary.
    pub fn new(runner: PathBuf, policy: Policy) -> Self {
        Self { runner, policy }
    }

    /// Lists the algorithms of a plugin, from inside the jail.
    pub fn describe(&self, plugin: &Path) -> Result<Vec<Descriptor>, Ending> {
        self.describe_with(plugin, &Killer::default())
    }

    /// As [`Launcher::describe`], with a handle that ends it.
    pub fn describe_with(&self, plugin: &Path, killer: &Killer) -> Result<Vec<Descriptor>, Ending> {
        self.aside(plugin, killer, |exchange| self.load(exchange).map(|(_, descriptors)| descriptors))
    }

    /// Reads a plugin file as ELF, in a jail, without loading it.
    pub fn inspect(&self, plugin: &Path) -> Result<Inspection, Ending> {
        self.inspect_with(plugin, &Killer::default())
    }

    /// As [`Launcher::inspect`], with a handle that ends it.
    pub fn inspect_with(&self, plugin: &Path, killer: &Killer) -> Result<Inspection, Ending> {
        self.aside(plugin, killer, |exchange| {
            exchange.obeyed(Command::Inspect, Phase::Load, self.policy.load_seconds)?;
            // No foreign code has run yet: what is wrong here is ours.
            parse_inspection(&exchange.text(Phase::Load)?).map_err(|reason| Outcome::fault("Gate", reason))
        })
    }

    /// The libraries that the plugin brings beside the system's own.
    pub fn brought(&self, plugin: &Path) -> Result<Vec<PathBuf>, Ending> {
        let brought = if self.policy.trusted { brought::beside(plugin)? } else { Vec::new() };
        Ok(brought.into_iter().map(PathBuf::from).collect())
    }

    /// How the plugin file and the libraries that it brings were compiled, with their file names; all are read in jails.
    pub fn builds(&self, plugin: &Path) -> Result<Vec<(String, Build)>, Ending> {
        let files = std::iter::once(plugin.to_owned()).chain(self.brought(plugin)?);
        let build = |file: PathBuf| {
            let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
            Ok((name, self.inspect(&file)?.facts.map(|facts| facts.build).unwrap_or_default()))
        };
        files.map(build).collect()
    }

    /// The layers that a jail around this file has, without loading it.
    pub fn layers(&self, plugin: &Path) -> Result<Vec<String>, Ending> {
        self.aside(plugin, &Killer::default(), |exchange| Ok(exchange.jail.layers.phrases()))
    }

    /// The kinds of query that an algorithm of the plugin answers with these parameters.
    pub fn queries(&self, plugin: &Path, algorithm: &str, parameters: &[(String, f64)]) -> Result<Vec<Query>, Ending> {
        let sheet = Sheet::empty(algorithm, parameters);
        self.aside_for(&sheet, plugin, &Killer::default(), |exchange| {
            self.load(exchange)?;
            self.tighten(exchange)?;
            exchange.obeyed(Command::Prepare, Phase::Load, self.policy.load_seconds)?;
            Ok(answers(exchange)?.queries)
        })
    }

    /// Does something in a jail of its own, for no algorithm and without objects.
    fn aside<T>(
        &self,
        plugin: &Path,
        killer: &Killer,
        work: impl FnOnce(&mut Exchange) -> Result<T, Outcome>,
    ) -> Result<T, Ending> {
        self.aside_for(&Sheet::empty("", &[]), plugin, killer, work)
    }

    fn aside_for<T>(
        &self,
        sheet: &Sheet,
        plugin: &Path,
        killer: &Killer,
        work: impl FnOnce(&mut Exchange) -> Result<T, Outcome>,
    ) -> Result<T, Ending> {
        let places = Places::here(&self.policy)?;
        let mut exchange = self.jail(Some(plugin), sheet, killer, &places)?;
        match work(&mut exchange) {
            Ok(found) => {
                exchange.jail.end(Outcome::Completed);
                Ok(found)
            }
            Err(outcome) => Err(exchange.jail.end(outcome)),
        }
    }

    /// Starts a fresh runner, loads the plugin and builds the objects.
    ///
    /// The jail lives no longer than the calling thread (Linux delivers the parent-death signal when the *thread* that
    /// started a process ends), so call this and everything on the [`Session`] from one thread that outlives it; the
    /// session cannot be sent elsewhere.
    pub fn start(&self, trial: &Trial<'_>) -> Result<Session, Ending> {
        self.start_with(trial, &Killer::default())
    }

    /// As [`Launcher::start`], with a handle that another thread may hold already while the plugin loads and builds.
    pub fn start_with(&self, trial: &Trial<'_>, killer: &Killer) -> Result<Session, Ending> {
        let sheet = Sheet::new(trial.algorithm, trial.parameters, trial.semantics, &trial.objects);
        let places = Places::here(&self.policy)?;
        let mut exchange = self.jail(Some(trial.plugin), &sheet, killer, &places)?;
        // Not before the jail has started: it would inherit the choice.
        let pinned = match Pinned::to(places.supervisor) {
            Ok(pinned) => pinned,
            Err(outcome) => return Err(exchange.jail.end(outcome)),
        };
        let mut prepare = || -> Result<(SetUp, ClockFacts, Resting), Outcome> {
            let policy = &self.policy;
            let clock = null::measure(&mut exchange, policy, places.runner.first().copied())?;
            let (mut load_ns, _) = self.load(&mut exchange)?;
            self.tighten(&mut exchange)?;
            load_ns += exchange.obeyed(Command::Prepare, Phase::Load, policy.load_seconds)?.raw_ns;
            if matches!(trial.objects, Objects::Scene(_)) && !answers(&exchange)?.scene {
                let reason = "it does not offer ocb.scene/1 with these parameters".into();
                return Err(Outcome::Failed { phase: Phase::Load, reason });
            }
            // Between its structures and the first question it is to do nothing, and what it does all the same is building.
            let rest = exchange.rest(policy.query_seconds)?;
            let resumed = exchange.resumed(Some(&rest));
            let mut wall_ns = 0.0;
            for mesh in &sheet.meshes {
                wall_ns += exchange.built(mesh, policy.build_seconds)?.raw_ns;
            }
            let built = exchange.rest(policy.query_seconds)?;
            let (mut build_ns, single) = (wall_ns, policy.threads == 1);
            if let (Some((then, now)), true) = (resumed.usage.zip(built.usage), single) {
                let waited_ns = resumed.waited_ns(now.since(then));
                build_ns += exchange.beside_ns(&resumed, &built, wall_ns, sheet.meshes.len()) - waited_ns;
            }
            let null = clock.null_median_ns * sheet.meshes.len() as f64;
            let set_up = SetUp { load_ns, build_ns: (build_ns - null).max(clock.resolution_ns()) };
            Ok((set_up, clock, built))
        };
        match prepare() {
            Ok((set_up, clock, resting)) => {
                let objects = trial.objects.count();
                Ok(Session::new(self.policy.clone(), exchange, objects, set_up, clock, pinned, resting))
            }
            Err(outcome) => Err(exchange.jail.end(outcome)),
        }
    }

    /// Loads the file: how long that took, and what it says of itself.
    fn load(&self, exchange: &mut Exchange) -> Result<(f64, Vec<Descriptor>), Outcome> {
        let timed = exchange.obeyed(Command::Open, Phase::Load, self.policy.load_seconds)?;
        let described = parse_descriptors(&exchange.text(Phase::Load)?);
        Ok((timed.raw_ns, described.map_err(|reason| Outcome::LoadError { reason })?))
    }

    /// Has the runner put its tighter filters in force? By then the plugin may have taken it over, so that the kernel is asked.
    pub(crate) fn tighten(&self, exchange: &mut Exchange) -> Result<(), Outcome> {
        exchange.obeyed(Command::Tighten, Phase::Load, self.policy.load_seconds)?;
        match status_field(exchange.jail.pid, "Seccomp_filters").and_then(|n| n.parse::<usize>().ok()) {
            // Kernels before 5.9 do not count.
            None => Ok(()),
            Some(filters) if filters > seccomp::TIGHTER => Ok(()),
            Some(_) => Err(Outcome::ProtocolViolation {
                phase: Phase::Load,
                rule: "the tighter system call filters are not in force".into(),
            }),
        }
    }

    /// A jail that has been looked at. Where this machine forbids namespaces, a trusted plugin runs without, and a foreign
    /// one where the profile lets it.
    pub(crate) fn jail(
        &self,
        plugin: Option<&Path>,
        trial: &Sheet,
        killer: &Killer,
        places: &Places,
    ) -> Result<Exchange, Ending> {
        match self.jail_in(plugin, trial, killer, places, true) {
            Err(Ending { outcome: Outcome::SandboxFault { step, .. }, .. })
                if (self.policy.trusted || self.policy.profile == Profile::Dev)
                    && NAMESPACE_STEPS.contains(&step.as_str()) =>
            {
                self.jail_in(plugin, trial, killer, places, false)
            }
            result => result,
        }
    }

    fn jail_in(
        &self,
        plugin: Option<&Path>,
        trial: &Sheet,
        killer: &Killer,
        places: &Places,
        namespaces: bool,
    ) -> Result<Exchange, Ending> {
        let jail = Jail::start(&self.runner, &self.policy, killer, plugin, trial, places, namespaces)?;
        let mut exchange = Exchange::new(jail, places.kind, Clock::get(), &self.policy);
        let closed = exchange.obeyed(Command::CloseListener, Phase::Load, self.policy.load_seconds);
        match closed.and_then(|_| exchange.jail.verify(namespaces)) {
            Ok(()) => Ok(exchange),
            Err(outcome) => Err(exchange.jail.end(outcome)),
        }
    }
}

/// What an algorithm that has been prepared says that it answers.
fn answers(exchange: &Exchange) -> Result<Answers, Outcome> {
    parse_answers(&exchange.text(Phase::Load)?).map_err(|rule| Outcome::ProtocolViolation { phase: Phase::Load, rule })
}

/// Steps that fail where a machine forbids namespaces or what is done inside them.
const NAMESPACE_STEPS: [&str; 9] =
    ["Namespaces", "IdMaps", "Groups", "Ids", "PrivateMounts", "EmptyRoot", "Library", "EnterRoot", "ReadOnlyRoot"];
