//! Starts a jail, up to the moment before the plugin is loaded. How it ends: `evidence.rs`.

use std::fs::File;
use std::io;
use std::os::fd::{AsFd, AsRawFd, FromRawFd, OwnedFd};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use nix::poll::{PollFd, PollFlags, PollTimeout, poll};

use crate::brought;
use crate::clock::ClockKind;
use crate::confine::process_descriptor;
use crate::control::{Control, Order, Report};
use crate::cpus::Places;
use crate::doorbell::futex_wait;
use crate::evidence::{Launched, Messages, status_kib};
use crate::layers::Layers;
use crate::memory::MemoryGroup;
use crate::opened::{self, Opened};
use crate::outcome::{Ending, Outcome};
use crate::policy::Policy;
use crate::protocol::{answer, request};
use crate::shared::{Segment, memory_file, seal};
use crate::trial::Sheet;
use crate::verify::{Expected, verify};

/// How long our own part of the start may take; more means that the machine is broken.
const START: Duration = Duration::from_secs(20);
/// Launcher, init and runner.
const TASKS: usize = 3;
/// Bytes of a page of memory.
const PAGE: usize = 4096;

/// A jail with a waiting runner.
pub(crate) struct Jail {
    /// Head and meshes, written by us alone.
    pub trial: Segment,
    /// Written by us alone.
    pub request: Segment,
    /// Written by the runner.
    pub answer: Segment,
    /// How many triangles A and B have.
    pub triangles: [u32; 2],
    /// Host's process id of the runner.
    pub pid: i32,
    /// In force.
    pub layers: Layers,
    pub(crate) launcher: Launched,
    pub(crate) control: Control,
    pub(crate) messages: Messages,
    pub(crate) init: Option<OwnedFd>,
    pub(crate) runner: Option<OwnedFd>,
    pub(crate) listener: Option<OwnedFd>,
    pub(crate) group: Option<MemoryGroup>,
    pub(crate) baseline_bytes: u64,
    pub(crate) killer: Killer,
    pub(crate) limits: Policy,
}

/// Ends a session from another thread, from before its start on: a plugin may take its time to load and to build. The
/// thread that waits for the runner looks at it every millisecond and does the killing.
#[derive(Clone, Debug, Default)]
pub struct Killer(Arc<AtomicBool>);

impl Killer {
    /// The session's outcome becomes [`Outcome::Cancelled`]. Harmless when it has ended already.
    pub fn kill(&self) {
        self.0.store(true, Ordering::SeqCst);
    }

    /// Was it asked for?
    pub(crate) fn asked(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

impl Jail {
    /// Starts a runner for a plugin file, or a program that loads none, and a trial, up to the moment before the plugin is loaded.
    pub fn start(
        runner: &Path,
        policy: &Policy,
        killer: &Killer,
        plugin: Option<&Path>,
        sheet: &Sheet,
        places: &Places,
        namespaces: bool,
    ) -> Result<Jail, Ending> {
        let fault = |step: &'static str| move |error: io::Error| Ending::from(Outcome::fault(step, error));
        if killer.asked() {
            return Err(Outcome::Cancelled.into());
        }
        let opened = match plugin {
            Some(plugin) => opened::open(plugin, policy.plugin_sha256.as_deref())?,
            None => opened::nothing(runner)?,
        };
        let Opened { path: plugin_path, file: plugin_file, bytes: plugin_bytes } = opened;
        let libraries = if policy.trusted { brought::beside(&plugin_path)? } else { Vec::new() };
        let whole = libc::F_SEAL_SHRINK | libc::F_SEAL_GROW | libc::F_SEAL_SEAL;
        // What is sealed so has no other writable mapping than the one that is there: ours.
        let ours = |name, len| -> io::Result<(OwnedFd, Segment)> {
            let file = memory_file(name, len)?;
            let segment = Segment::map(file.as_fd(), len, true)?;
            seal(file.as_fd(), whole | libc::F_SEAL_FUTURE_WRITE)?;
            Ok((file, segment))
        };
        let (trial_file, trial) = ours(c"ocb-trial", sheet.len).map_err(fault("SharedMemory"))?;
        // Every page is there before it is needed; making it is none of the plugin's time.
        (0..sheet.len / PAGE).for_each(|page| trial.u64(page * PAGE).store(0, Ordering::Relaxed));
        trial.store_bytes(0, &sheet.head);
        let (request_file, request) = ours(c"ocb-request", request::BYTES).map_err(fault("SharedMemory"))?;
        let answer_file = memory_file(c"ocb-answer", sheet.answer_bytes).map_err(fault("SharedMemory"))?;
        seal(answer_file.as_fd(), whole).map_err(fault("SharedMemory"))?;
        let answer = Segment::whole(answer_file.as_fd(), false).map_err(fault("SharedMemory"))?;

        let (pipe, pipe_end) = io::pipe().map_err(fault("Start"))?;
        let pipe = File::from(OwnedFd::from(pipe));
        // SAFETY: a flag on our own descriptor.
        unsafe { libc::fcntl(pipe.as_raw_fd(), libc::F_SETFL, libc::O_NONBLOCK) };
        let (control, theirs) = Control::pair().map_err(fault("Start"))?;
        #[expect(clippy::disallowed_methods, reason = "this is the one place that starts a process")]
        let mut launcher = Command::new(runner);
        let child = launcher
            .arg("launch")
            .env_clear()
            .stdin(Stdio::from(theirs.into_fd()))
            .stdout(Stdio::null())
            .stderr(Stdio::from(OwnedFd::from(pipe_end)))
            .spawn()
            .map_err(|e| {
                Ending::from(Outcome::fault("Start", format!("{} cannot be started: {e}", runner.display())))
            })?;
        // It holds our copies of the jail's ends, whose closing is how an end is noticed.
        drop(launcher);
        let pid = child.id() as i32;
        let handle = process_descriptor(pid).map_err(fault("Start"))?;
        let startable_threads = policy.startable_threads();
        let group = MemoryGroup::new(policy.memory_bytes, TASKS + startable_threads).ok();
        let mut jail = Jail {
            trial,
            request,
            answer,
            triangles: sheet.triangles,
            pid,
            layers: Layers::default(),
            launcher: Launched { pid, handle, usage: None },
            control,
            messages: Messages { pipe, bytes: Vec::new(), cap: policy.output_bytes },
            init: None,
            runner: None,
            listener: None,
            group,
            baseline_bytes: 0,
            killer: killer.clone(),
            limits: policy.clone(),
        };
        // With a group the address space only has to stop absurd reservations; without one it is the memory limit.
        let shared = (sheet.len + sheet.answer_bytes) as u64;
        let address_space_bytes = match jail.group {
            // glibc reserves a stack and a heap for each thread, of which little is ever touched.
            Some(_) => 2 * policy.memory_bytes + shared + (1 << 30) + startable_threads as u64 * (128 << 20),
            None => policy.memory_bytes + shared + (64 << 20),
        };
        let order = Order {
            supervisor: std::process::id() as i32,
            namespaces,
            plugin_path: plugin_path.to_string_lossy().into_owned(),
            plugin_bytes,
            libraries,
            cpus: places.runner.clone(),
            startable_threads,
            address_space_bytes,
            cpu_seconds: jail.cpu_limit(),
            futex: places.kind == ClockKind::Futex,
        };
        let mut started = || -> Result<(), Outcome> {
            let entrances = jail.group.as_ref().map(MemoryGroup::entrances).transpose();
            let entrances = entrances.map_err(|e| Outcome::fault("MemoryGroup", e))?.unwrap_or_default();
            let mut files = vec![trial_file.as_fd(), request_file.as_fd(), answer_file.as_fd(), plugin_file.as_fd()];
            files.extend(entrances.iter().map(OwnedFd::as_fd));
            jail.control.send(&order, &files).map_err(|e| Outcome::fault("Start", e))?;
            jail.admit()?;
            jail.take_listener(namespaces)
        };
        match started() {
            Ok(()) => Ok(jail),
            Err(outcome) => Err(jail.end(outcome)),
        }
    }

    /// What the plugin has added up for each triangle of A and of B.
    pub fn triangle_tests(&self) -> [Vec<u32>; 2] {
        let starts = [answer::TESTS, answer::tests_b(self.triangles)];
        let read = |start: usize, n: u32| {
            (0..n as usize).map(|i| self.answer.u32(start + 4 * i).load(Ordering::Relaxed)).collect()
        };
        [read(starts[0], self.triangles[0]), read(starts[1], self.triangles[1])]
    }

    pub(crate) fn cpu_limit(&self) -> u64 {
        self.limits.trial_seconds.clamp(1.0, 1e9) as u64 * self.limits.threads.max(1) as u64 + 30
    }

    /// Waits for init's process, then for the runner's.
    fn admit(&mut self) -> Result<(), Outcome> {
        let deadline = Instant::now() + START;
        loop {
            let (report, mut descriptors) = self.report_before(deadline)?;
            match report {
                Report::InitStarted => {
                    let init = descriptors.pop().ok_or_else(|| Outcome::fault("Start", "init is missing"))?;
                    self.init = Some(init);
                }
                Report::RunnerStarted { own_ids } => {
                    let runner = descriptors.pop().ok_or_else(|| Outcome::fault("Start", "the runner is missing"))?;
                    self.pid = pid_of(&runner).map_err(|e| Outcome::fault("Start", e))?;
                    self.runner = Some(runner);
                    self.layers.own_ids = own_ids;
                    return Ok(());
                }
                Report::RunnerEnded { status } => return Err(early(status)),
                Report::Fault { step, reason } => return Err(Outcome::SandboxFault { step, reason }),
            }
        }
    }

    pub(crate) fn report_before(&self, deadline: Instant) -> Result<(Report, Vec<OwnedFd>), Outcome> {
        let left = deadline.saturating_duration_since(Instant::now()).as_millis() as i32;
        let mut wait = [PollFd::new(self.control.as_fd(), PollFlags::POLLIN)];
        match poll(&mut wait, PollTimeout::try_from(left).unwrap_or(PollTimeout::MAX)) {
            Ok(0) => return Err(Outcome::fault("Start", "the jail did not start in time")),
            Ok(_) => {}
            Err(nix::errno::Errno::EINTR) => return self.report_before(deadline),
            Err(error) => return Err(Outcome::fault("Start", error)),
        }
        match self.control.receive() {
            Ok(Some(report)) => Ok(report),
            Ok(None) => Err(Outcome::fault("Start", "the launcher ended without a message")),
            Err(error) => Err(Outcome::fault("Start", error)),
        }
    }

    /// Waits for the filter, takes the listener, and looks at the runner from outside.
    fn take_listener(&mut self, namespaces: bool) -> Result<(), Outcome> {
        let deadline = Instant::now() + START;
        let number = loop {
            let word = self.answer.u32(answer::LISTENER);
            match word.load(Ordering::Acquire) {
                0 => futex_wait(word, 0, Some(Duration::from_millis(2))),
                number => break number as i32 - 1,
            }
            if self.killer.asked() {
                return Err(Outcome::Cancelled);
            }
            if let Some(outcome) = self.faults() {
                return Err(outcome);
            }
            if Instant::now() > deadline {
                return Err(Outcome::fault("Start", "the runner did not confine itself in time"));
            }
        };
        let runner = self.runner.as_ref().ok_or_else(|| Outcome::fault("Start", "the runner is missing"))?;
        // SAFETY: integers only; the result is checked.
        let fd = unsafe { libc::syscall(libc::SYS_pidfd_getfd, runner.as_raw_fd(), number, 0) } as i32;
        if fd < 0 {
            let error = io::Error::last_os_error();
            return Err(Outcome::fault("Listener", format!("the filter's listener cannot be taken: {error}")));
        }
        // SAFETY: just made, owned by nobody else.
        self.listener = Some(unsafe { OwnedFd::from_raw_fd(fd) });
        self.note_layers(namespaces)
    }

    /// After the runner has closed its own copy of the listener: is it as it must be?
    pub fn verify(&mut self, namespaces: bool) -> Result<(), Outcome> {
        let own_ids = self.layers.own_ids;
        let group = self.group.as_ref().and_then(MemoryGroup::name);
        verify(self.pid, Expected { namespaces, own_ids, group })
            .map_err(|reason| Outcome::fault("Verify", format!("the runner is not confined: {reason}")))?;
        self.baseline_bytes = match &self.group {
            Some(group) => group.usage().unwrap_or(0),
            None => status_kib(self.pid, "VmRSS").unwrap_or(0),
        };
        Ok(())
    }

    /// What the runner says of its own hardening, beside what we know. It has loaded nothing yet.
    fn note_layers(&mut self, namespaces: bool) -> Result<(), Outcome> {
        let fact = |i: usize| self.answer.u32(answer::HARDENING + 4 * i).load(Ordering::Relaxed);
        self.layers = Layers {
            namespaces,
            group: self.group.as_ref().map(MemoryGroup::version),
            counted: self.group.as_ref().is_some_and(MemoryGroup::counts_processes),
            landlock_abi: fact(0),
            sealed_mappings: fact(1),
            no_new_code: fact(2) != 0,
            startable_threads: self.limits.startable_threads(),
            ..self.layers
        };
        self.layers.enough(&self.limits)
    }

    /// A fault that the jail's own processes report, or their end, while the jail is being built.
    fn faults(&self) -> Option<Outcome> {
        let mut wait = [PollFd::new(self.control.as_fd(), PollFlags::POLLIN)];
        if poll(&mut wait, PollTimeout::ZERO) != Ok(1) {
            return None;
        }
        Some(match self.control.receive::<Report>() {
            Ok(Some((Report::Fault { step, reason }, _))) => Outcome::SandboxFault { step, reason },
            Ok(Some((Report::RunnerEnded { status }, _))) => early(status),
            Ok(Some(_)) => return None,
            Ok(None) => Outcome::fault("Start", "the jail ended without a message"),
            Err(error) => Outcome::fault("Start", error),
        })
    }
}

impl Drop for Jail {
    fn drop(&mut self) {
        // Before the memory group goes.
        self.reap();
    }
}

/// The runner ended before the plugin was loaded: ours.
fn early(status: i32) -> Outcome {
    Outcome::fault("Start", format!("the runner ended before it was confined (wait status {status:#x})"))
}

/// The process behind a descriptor, in our own numbering.
fn pid_of(process: &OwnedFd) -> io::Result<i32> {
    let text = std::fs::read_to_string(format!("/proc/self/fdinfo/{}", process.as_raw_fd()))?;
    let pid = text.lines().find_map(|line| line.strip_prefix("Pid:")?.trim().parse().ok());
    pid.filter(|pid| *pid > 0).ok_or_else(|| io::Error::other("the process has ended"))
}
