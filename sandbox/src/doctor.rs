//! What this machine has for a jail, what it lacks, what that means and how to get it: `ocb doctor`.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::confine::root::{OPENMP, find_libraries};
use crate::launcher::Launcher;
use crate::layers::{LANDLOCK_ABI, Profile};
use crate::memory::MemoryGroup;
use crate::policy::Policy;

/// One thing that a jail or its clock wants of the machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Facility {
    /// Its name.
    pub name: &'static str,
    /// Whether it is there.
    pub state: State,
    /// What was found.
    pub found: String,
    /// What it does for us, or what its absence means.
    pub effect: &'static str,
    /// How to get it; absent when it is there.
    pub get: Option<&'static str>,
    /// No foreign plugin runs without it in production.
    pub required: bool,
}

/// Whether a facility is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// There.
    Good,
    /// There in a weaker form, or not there and not needed.
    Weak,
    /// Not there.
    Missing,
}

/// What a machine may run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnosis {
    /// The facilities, most important first.
    pub facilities: Vec<Facility>,
    /// The layers of a jail that was really started; empty when none could be.
    pub layers: Vec<String>,
    /// Foreign plugins may run in production.
    pub production: bool,
    /// Foreign plugins may run in the development profile.
    pub dev: bool,
    /// The plugins built from our own sources may run.
    pub own_plugins: bool,
}

/// One answer of `ocb-runner probe`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Probe {
    name: String,
    answer: Result<i64, String>,
}

impl Probe {
    /// What the kernel said to one question.
    pub fn of(name: &str, answer: io::Result<i64>) -> Self {
        Self { name: name.into(), answer: answer.map_err(|e| e.to_string()) }
    }
}

/// Looks at this machine. `runner` is the path of the `ocb-runner` binary.
pub fn examine(runner: &Path) -> Diagnosis {
    let probes = ask(runner);
    let answer = |name: &str| match &probes {
        Ok(probes) => probes.iter().find(|p| p.name == name).map_or(Err("not asked".into()), |p| p.answer.clone()),
        Err(reason) => Err(reason.clone()),
    };
    let facilities = vec![
        program(runner, probes.as_ref().err()),
        of_kernel(
            answer("notify"),
            "seccomp with notification",
            true,
            "blocks and names every system call that is not allowed; nothing runs without it",
            "use Linux 5.14 or newer with CONFIG_SECCOMP_FILTER; in a container allow seccomp(2)",
        ),
        of_kernel(
            answer("namespaces"),
            "user namespaces",
            true,
            "an empty root, no network, no other processes",
            "sysctl user.max_user_namespaces=10000; on Ubuntu sysctl kernel.apparmor_restrict_unprivileged_userns=0; in a \
             container allow unshare and mount; or run as root",
        ),
        landlock(answer("landlock")),
        memory_group(),
        of_kernel(
            answer("process descriptors"),
            "process descriptors",
            true,
            "kills and inspects exactly the process that was started",
            "use Linux 5.6 or newer",
        ),
        of_kernel(
            answer("sealed memory"),
            "sealed memory files",
            true,
            "a plugin cannot change objects and queries",
            "use Linux 5.1 or newer with CONFIG_MEMFD_CREATE",
        ),
        libraries(),
        openmp(),
        of_kernel(
            answer("mseal"),
            "sealed code (mseal)",
            false,
            "defence in depth: the code of the runner cannot be replaced; the clock does not need it",
            "use Linux 6.10 or newer",
        ),
        of_kernel(
            answer("mdwe"),
            "no new executable memory (MDWE)",
            false,
            "defence in depth: the filter enforces the same rule",
            "use Linux 6.3 or newer",
        ),
        ids(),
        cpus(),
        clock(),
    ];
    let (layers, whole) = jail(runner);
    let has = |name: &str| facilities.iter().any(|f| f.name == name && f.state == State::Good);
    let enough = |names: &[&str]| names.iter().all(|name| has(name));
    let kernel =
        ["runner", "seccomp with notification", "process descriptors", "sealed memory files", "system libraries"];
    let starts = whole.state == State::Good;
    let own_plugins = starts && enough(&kernel);
    let landlocked = facilities.iter().any(|f| f.name == "Landlock" && f.state != State::Missing);
    let production = own_plugins && facilities.iter().filter(|f| f.required).all(|f| f.state == State::Good);
    let dev = own_plugins && (has("user namespaces") || landlocked);
    let mut facilities = facilities;
    facilities.push(whole);
    Diagnosis { facilities, layers, production, dev, own_plugins }
}

impl Diagnosis {
    /// Whether foreign plugins may run under this profile.
    pub fn allows(&self, profile: Profile) -> bool {
        match profile {
            Profile::Production => self.production,
            Profile::Dev => self.dev,
        }
    }
}

fn ask(runner: &Path) -> Result<Vec<Probe>, String> {
    #[expect(clippy::disallowed_methods, reason = "our own program, which probes the kernel and loads nothing")]
    let mut command = Command::new(runner);
    let output = command.arg("probe").env_clear().stdin(Stdio::null()).output();
    let output = output.map_err(|e| format!("{} cannot be started: {e}", runner.display()))?;
    serde_json::from_slice(&output.stdout).map_err(|_| format!("{} does not answer a probe", runner.display()))
}

fn facility(
    name: &'static str,
    required: bool,
    found: Result<String, String>,
    effect: &'static str,
    get: &'static str,
) -> Facility {
    let (state, found) = match found {
        Ok(found) => (State::Good, found),
        Err(reason) if required => (State::Missing, reason),
        Err(reason) => (State::Weak, reason),
    };
    Facility { name, state, found, effect, get: (state != State::Good).then_some(get), required }
}

fn of_kernel(
    answer: Result<i64, String>,
    name: &'static str,
    required: bool,
    effect: &'static str,
    get: &'static str,
) -> Facility {
    facility(name, required, answer.map(|_| "there".into()), effect, get)
}

fn program(runner: &Path, problem: Option<&String>) -> Facility {
    let found = problem.map_or_else(|| Ok(runner.display().to_string()), |p| Err(p.clone()));
    facility("runner", true, found, "the only program that ever loads a plugin", "build it, or name it with --runner")
}

fn landlock(answer: Result<i64, String>) -> Facility {
    let get = "use Linux 6.12 or newer with landlock in the list of lsm= at boot";
    let effect = "files, network and signals stay blocked even if a namespace has a gap";
    match answer {
        Ok(abi) if abi >= i64::from(LANDLOCK_ABI) => facility("Landlock", true, Ok(format!("ABI {abi}")), effect, get),
        Ok(abi) => Facility {
            state: State::Weak,
            ..facility("Landlock", true, Err(format!("ABI {abi}, wanted {LANDLOCK_ABI}")), effect, get)
        },
        Err(reason) => facility("Landlock", true, Err(reason), effect, get),
    }
}

fn memory_group() -> Facility {
    let found = MemoryGroup::new(64 << 20, 1).map(|group| group.version().to_string()).map_err(|e| e.to_string());
    let effect = "an exact limit and peak of memory; without it the address space is limited";
    let get = "run as root, or in a group that systemd hands over (a unit with Delegate=yes, or `systemd-run --user --scope -p Delegate=yes \
         ocb serve`), or mount a writable control group into the container";
    facility("memory group", true, found, effect, get)
}

fn libraries() -> Facility {
    let found = find_libraries(false).map(|all| all.iter().map(|l| l.name.as_str()).collect::<Vec<_>>().join(", "));
    let effect = "what plugins may link";
    let get = "install glibc's and gcc's run-time libraries (Debian: libc6, libgcc-s1, libstdc++6)";
    facility("system libraries", true, found.map_err(|e| e.to_string()), effect, get)
}

fn openmp() -> Facility {
    let here = find_libraries(true).is_ok_and(|all| all.iter().any(|library| library.name == OPENMP));
    let found = if here { Ok(OPENMP.into()) } else { Err(format!("{OPENMP} is not installed")) };
    let effect = "plugins of the multi-threaded track may use OpenMP";
    facility("OpenMP", false, found, effect, "install gcc's OpenMP library (Debian: libgomp1)")
}

fn ids() -> Facility {
    let root = nix::unistd::geteuid().is_root();
    let found = if root { Ok("two per jail".into()) } else { Err("the runner has this user's own id".into()) };
    let effect = "the runner has a user id that no other process has";
    facility("ids of its own", false, found, effect, "run as root")
}

fn cpus() -> Facility {
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let found = if count > 1 { Ok(format!("{count} available")) } else { Err("only one is available".into()) };
    let effect = "runner and clock each have their own CPU: 0.3 us per round trip; on one CPU 3 us";
    facility("CPUs", false, found, effect, "give the process (container, taskset, cpuset) two CPUs or more")
}

fn clock() -> Facility {
    let found = if Clock::get().is_counter() {
        Ok("time stamp counter".into())
    } else {
        Err("the kernel does not use the time stamp counter; CLOCK_MONOTONIC_RAW is used".into())
    };
    let effect = "reading the time costs 10 ns; otherwise up to some 100 ns, which the null measurement subtracts";
    facility("clock", false, found, effect, "choose clocksource=tsc where the hardware allows it")
}

/// Starts a jail around a file that is never loaded, with everything that there is.
fn jail(runner: &Path) -> (Vec<String>, Facility) {
    let launcher = Launcher::new(runner.to_path_buf(), Policy { trusted: true, ..Policy::default() });
    let (layers, found) = match launcher.layers(runner) {
        Ok(layers) => {
            let count = layers.len();
            (layers, Ok(format!("started and inspected from outside, {count} layers")))
        }
        Err(ending) => (Vec::new(), Err(ending.to_string())),
    };
    let get = "install what is missing above; the message names the step that failed";
    (layers, facility("a whole jail", true, found, "all of the above together", get))
}
