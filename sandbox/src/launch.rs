//! Starts a jail and watches it: every piece of evidence about a runner's end is gathered here, from outside.

use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, FromRawFd, OwnedFd};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use nix::poll::{PollFd, PollFlags, PollTimeout, poll};

use crate::confine::process_descriptor;
use crate::control::{Control, Go, Order, Report};
use crate::doorbell::futex_wait;
use crate::memory::MemoryGroup;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Hardening, answer, clean_text, request};
use crate::seccomp;
use crate::shared::{Segment, memory_file, seal};
use crate::verify::{Expected, verify};

/// How long our own part of the start may take; more means that the machine is broken.
const START: Duration = Duration::from_secs(20);
/// How long the kernel may take to end a killed jail.
const END: Duration = Duration::from_secs(5);

/// A jail with a waiting runner.
pub(crate) struct Jail {
    /// Written by us alone.
    pub request: Segment,
    /// Written by the runner.
    pub answer: Segment,
    /// Host's process id of the runner.
    pub pid: i32,
    /// In force, one phrase each.
    pub layers: Vec<String>,
    launcher: Launched,
    control: Control,
    messages: Messages,
    init: Option<Arc<OwnedFd>>,
    runner: Option<OwnedFd>,
    listener: Option<OwnedFd>,
    group: Option<MemoryGroup>,
    baseline_bytes: u64,
    cancelled: Arc<AtomicBool>,
    limits: Policy,
}

/// The launcher's process, reaped exactly once.
struct Launched {
    pid: i32,
    handle: OwnedFd,
    usage: Option<f64>,
}

/// What the plugin writes, capped.
struct Messages {
    pipe: File,
    bytes: Vec<u8>,
    cap: u64,
}

/// Ends a session from another thread.
#[derive(Clone, Debug)]
pub struct Killer {
    asked: Arc<AtomicBool>,
    init: Option<Arc<OwnedFd>>,
}

impl Killer {
    /// Kills the jail; the session's outcome becomes [`Outcome::Cancelled`]. Harmless when it has ended already.
    pub fn kill(&self) {
        self.asked.store(true, Ordering::SeqCst);
        if let Some(init) = &self.init {
            kill(init.as_fd());
        }
    }
}

/// SIGKILL through a process descriptor, which cannot hit anybody else.
fn kill(process: BorrowedFd<'_>) {
    // SAFETY: a borrowed descriptor and integers; no signal information.
    unsafe {
        libc::syscall(
            libc::SYS_pidfd_send_signal,
            process.as_raw_fd(),
            libc::SIGKILL,
            std::ptr::null::<libc::siginfo_t>(),
            0,
        )
    };
}

impl Jail {
    /// Starts a runner for a plugin file and a sealed trial, up to the moment before the plugin is loaded.
    pub fn start(
        runner: &Path,
        policy: &Policy,
        plugin: &Path,
        trial: &[u8],
        futex: bool,
        namespaces: bool,
    ) -> Result<Jail, Ending> {
        let fault = |step: &'static str| move |error: io::Error| Ending::from(Outcome::fault(step, error));
        let unreadable = |error: io::Error| {
            Ending::from(Outcome::LoadError { reason: format!("{} cannot be read: {error}", plugin.display()) })
        };
        let plugin_path = plugin.canonicalize().map_err(unreadable)?;
        let plugin_file = File::open(&plugin_path).map_err(unreadable)?;
        let metadata = plugin_file.metadata().map_err(unreadable)?;
        if !metadata.is_file() {
            return Err(unreadable(io::Error::other("it is no regular file")));
        }
        let sheet = memory_file(c"ocb-trial", trial.len()).map_err(fault("SharedMemory"))?;
        {
            use std::os::unix::fs::FileExt;
            let file = File::from(sheet.try_clone().map_err(fault("SharedMemory"))?);
            file.write_all_at(trial, 0).map_err(fault("SharedMemory"))?;
        }
        let whole = libc::F_SEAL_SHRINK | libc::F_SEAL_GROW | libc::F_SEAL_SEAL;
        seal(sheet.as_fd(), whole | libc::F_SEAL_WRITE).map_err(fault("SharedMemory"))?;
        let request_file = memory_file(c"ocb-request", request::BYTES).map_err(fault("SharedMemory"))?;
        let request = Segment::map(request_file.as_fd(), request::BYTES, true).map_err(fault("SharedMemory"))?;
        // From here on nobody can make another writable mapping.
        seal(request_file.as_fd(), whole | libc::F_SEAL_FUTURE_WRITE).map_err(fault("SharedMemory"))?;
        let answer_file = memory_file(c"ocb-answer", answer::BYTES).map_err(fault("SharedMemory"))?;
        seal(answer_file.as_fd(), whole).map_err(fault("SharedMemory"))?;
        let answer = Segment::map(answer_file.as_fd(), answer::BYTES, false).map_err(fault("SharedMemory"))?;

        let (pipe, pipe_end) = io::pipe().map_err(fault("Start"))?;
        let pipe = File::from(OwnedFd::from(pipe));
        // SAFETY: a flag on our own descriptor.
        unsafe { libc::fcntl(pipe.as_raw_fd(), libc::F_SETFL, libc::O_NONBLOCK) };
        let (control, theirs) = Control::pair().map_err(fault("Start"))?;
        let child = Command::new(runner)
            .arg("launch")
            .env_clear()
            .stdin(Stdio::from(theirs.into_fd()))
            .stdout(Stdio::null())
            .stderr(Stdio::from(OwnedFd::from(pipe_end)))
            .spawn()
            .map_err(|e| {
                Ending::from(Outcome::fault("Start", format!("{} cannot be started: {e}", runner.display())))
            })?;
        let pid = child.id() as i32;
        let handle = process_descriptor(pid).map_err(fault("Start"))?;
        let group = MemoryGroup::new(policy.memory_bytes).ok();
        let mut jail = Jail {
            request,
            answer,
            pid,
            layers: Vec::new(),
            launcher: Launched { pid, handle, usage: None },
            control,
            messages: Messages { pipe, bytes: Vec::new(), cap: policy.output_bytes },
            init: None,
            runner: None,
            listener: None,
            group,
            baseline_bytes: 0,
            cancelled: Arc::default(),
            limits: policy.clone(),
        };
        // With a group the address space only has to stop absurd reservations; without one it is the memory limit.
        let meshes = trial.len() as u64;
        let address_space_bytes = match jail.group {
            Some(_) => 2 * policy.memory_bytes + meshes + (1 << 30),
            None => policy.memory_bytes + meshes + (64 << 20),
        };
        let order = Order {
            supervisor: std::process::id() as i32,
            namespaces,
            plugin_path: plugin_path.to_string_lossy().into_owned(),
            plugin_bytes: metadata.len(),
            cpu: policy.runner_cpu,
            address_space_bytes,
            cpu_seconds: jail.cpu_limit(),
            futex,
        };
        let files = [sheet.as_fd(), request_file.as_fd(), answer_file.as_fd(), plugin_file.as_fd()];
        let mut started = || -> Result<(), Outcome> {
            jail.control.send(&order, &files).map_err(|e| Outcome::fault("Start", e))?;
            jail.admit()?;
            jail.take_listener(namespaces)
        };
        match started() {
            Ok(()) => Ok(jail),
            Err(outcome) => Err(jail.end(outcome)),
        }
    }

    fn cpu_limit(&self) -> u64 {
        self.limits.trial_seconds.clamp(1.0, 1e9) as u64 + 30
    }

    /// Init into its memory group, then on; the runner's process.
    fn admit(&mut self) -> Result<(), Outcome> {
        let deadline = Instant::now() + START;
        loop {
            let (report, mut descriptors) = self.report_before(deadline)?;
            match report {
                Report::InitWaits => {
                    let init = descriptors.pop().ok_or_else(|| Outcome::fault("Start", "init came without itself"))?;
                    if let Some(group) = &self.group {
                        let added = pid_of(&init).and_then(|pid| group.add(pid));
                        added.map_err(|e| Outcome::fault("MemoryGroup", e))?;
                    }
                    self.init = Some(Arc::new(init));
                    self.control.send(&Go, &[]).map_err(|e| Outcome::fault("Start", e))?;
                }
                Report::RunnerStarted { own_ids } => {
                    let runner = descriptors.pop().ok_or_else(|| Outcome::fault("Start", "no runner came"))?;
                    self.pid = pid_of(&runner).map_err(|e| Outcome::fault("Start", e))?;
                    self.runner = Some(runner);
                    self.layers.push(if own_ids { "ids of its own" } else { "ids of this user" }.into());
                    return Ok(());
                }
                Report::RunnerEnded { status } => return Err(early(status)),
                Report::Fault { step, reason } => return Err(Outcome::SandboxFault { step, reason }),
            }
        }
    }

    fn report_before(&self, deadline: Instant) -> Result<(Report, Vec<OwnedFd>), Outcome> {
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
            Ok(None) => Err(Outcome::fault("Start", "the launcher ended without a word")),
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
            if let Some(outcome) = self.faults() {
                return Err(outcome);
            }
            if Instant::now() > deadline {
                return Err(Outcome::fault("Start", "the runner did not close itself off in time"));
            }
        };
        let runner = self.runner.as_ref().ok_or_else(|| Outcome::fault("Start", "no runner came"))?;
        // SAFETY: integers only; the result is checked.
        let fd = unsafe { libc::syscall(libc::SYS_pidfd_getfd, runner.as_raw_fd(), number, 0) } as i32;
        if fd < 0 {
            let error = io::Error::last_os_error();
            return Err(Outcome::fault("Listener", format!("the filter's listener cannot be taken: {error}")));
        }
        // SAFETY: just made, owned by nobody else.
        self.listener = Some(unsafe { OwnedFd::from_raw_fd(fd) });
        self.name_layers(namespaces)
    }

    /// After the runner has closed its own copy of the listener: is it as it must be?
    pub fn verify(&mut self, namespaces: bool) -> Result<(), Outcome> {
        let own_ids = self.layers.iter().any(|layer| layer == "ids of its own");
        verify(self.pid, Expected { namespaces, own_ids })
            .map_err(|reason| Outcome::fault("Verify", format!("the runner is not closed off: {reason}")))?;
        self.baseline_bytes = match &self.group {
            Some(group) => group.usage().unwrap_or(0),
            None => status_kib(self.pid, "VmRSS").unwrap_or(0),
        };
        Ok(())
    }

    fn name_layers(&mut self, namespaces: bool) -> Result<(), Outcome> {
        let fact = |i: usize| self.answer.u32(answer::HARDENING + 4 * i).load(Ordering::Relaxed);
        let hardening = Hardening { landlock_abi: fact(0), sealed_mappings: fact(1), no_new_code: fact(2) };
        let mut layers = Vec::new();
        if namespaces {
            layers.push("user, pid, net, mount, ipc, uts and cgroup namespaces".to_string());
            layers.push("empty read-only root".to_string());
        } else {
            layers.push("NO namespaces and NO own root (this machine refuses them)".to_string());
        }
        layers.append(&mut self.layers);
        layers.push(match &self.group {
            Some(group) => format!("memory group ({})", group.version()),
            None => "address space limit instead of a memory group".to_string(),
        });
        layers.push("resource limits".into());
        layers.push("no capabilities, no new privileges".into());
        layers.push(match hardening.landlock_abi {
            0 => "NO Landlock (this kernel has none)".to_string(),
            abi => format!("Landlock ABI {abi}"),
        });
        if hardening.sealed_mappings > 0 {
            layers.push("sealed code (mseal)".into());
        }
        if hardening.no_new_code != 0 {
            layers.push("no new executable memory (MDWE)".into());
        }
        layers.push("system call allow-list with notification".into());
        self.layers = layers;
        if hardening.landlock_abi == 0 && !self.limits.trusted {
            return Err(Outcome::fault(
                "Landlock",
                "this kernel has no Landlock, which foreign plugins need; use Linux 5.13 or newer with lsm=landlock",
            ));
        }
        Ok(())
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
            Ok(None) => Outcome::fault("Start", "the jail ended without a word"),
            Err(error) => Outcome::fault("Start", error),
        })
    }

    /// One look at everything that may have happened; `Some` when the runner's life is over.
    pub fn watch(&mut self, phase: Phase) -> Option<Outcome> {
        if self.cancelled.load(Ordering::SeqCst) {
            return Some(Outcome::Cancelled);
        }
        let (listener, runner) = (self.listener.as_ref()?, self.runner.as_ref()?);
        let mut wait = [
            PollFd::new(listener.as_fd(), PollFlags::POLLIN),
            PollFd::new(runner.as_fd(), PollFlags::POLLIN),
            PollFd::new(self.messages.pipe.as_fd(), PollFlags::POLLIN),
        ];
        if poll(&mut wait, PollTimeout::ZERO).unwrap_or(0) == 0 {
            return None;
        }
        let [denied, ended, spoke] = wait.map(|w| w.revents().is_some_and(|r| r.contains(PollFlags::POLLIN)));
        if spoke && self.messages.drain() {
            return Some(Outcome::OutputLimit { limit_bytes: self.messages.cap });
        }
        if denied && let Some(outcome) = self.denied_call(phase) {
            return Some(outcome);
        }
        ended.then(|| self.how_it_ended(phase))
    }

    /// Reads the notification of a forbidden call. It is never answered: the caller is killed instead.
    fn denied_call(&self, phase: Phase) -> Option<Outcome> {
        let listener = self.listener.as_ref()?;
        // SAFETY: all zeros is a valid value, and the one the kernel wants.
        let mut call: libc::seccomp_notif = unsafe { std::mem::zeroed() };
        // SAFETY: a live struct of the request's type.
        let result = unsafe { libc::ioctl(listener.as_raw_fd(), libc::SECCOMP_IOCTL_NOTIF_RECV as _, &raw mut call) };
        if result < 0 {
            return None;
        }
        let maps = std::fs::read_to_string(format!("/proc/{}/maps", call.pid)).unwrap_or_default();
        Some(Outcome::SyscallDenied {
            phase,
            nr: call.data.nr.into(),
            name: seccomp::name_of(call.data.nr.into()),
            args: call.data.args,
            mapping: mapping_of(&maps, call.data.instruction_pointer),
        })
    }

    /// The runner is dead: by whose hand?
    fn how_it_ended(&mut self, phase: Phase) -> Outcome {
        if self.cancelled.load(Ordering::SeqCst) {
            return Outcome::Cancelled;
        }
        let status = match self.report_before(Instant::now() + END) {
            Ok((Report::RunnerEnded { status }, _)) => Some(status),
            Ok((Report::Fault { step, reason }, _)) => return Outcome::SandboxFault { step, reason },
            _ => None,
        };
        if self.group.as_ref().is_some_and(|group| group.kills() > 0) {
            return Outcome::OutOfMemory { phase, limit_bytes: self.limits.memory_bytes };
        }
        match status {
            None => Outcome::fault("Watch", "the jail's first process was killed from outside"),
            Some(status) if libc::WIFSIGNALED(status) => {
                let signal = libc::WTERMSIG(status);
                let limit = self.cpu_limit() as f64;
                let spent = signal == libc::SIGXCPU || (signal == libc::SIGKILL && self.cpu_seconds() >= limit);
                match spent {
                    true => Outcome::TimedOut { phase, limit_seconds: limit, cpu: true },
                    false => Outcome::Signaled { phase, signal },
                }
            }
            Some(status) => Outcome::Failed {
                phase,
                reason: format!("it ended its process with exit status {}", libc::WEXITSTATUS(status)),
            },
        }
    }

    fn cpu_seconds(&mut self) -> f64 {
        self.reap();
        self.launcher.usage.unwrap_or(0.0)
    }

    /// A handle that ends the jail from another thread.
    pub fn killer(&self) -> Killer {
        Killer { asked: self.cancelled.clone(), init: self.init.clone() }
    }

    /// Kills what is left, reaps it, and gathers what is known.
    pub fn end(mut self, outcome: Outcome) -> Ending {
        let resident_peak = self.runner.is_some().then(|| status_kib(self.pid, "VmHWM")).flatten();
        self.reap();
        self.messages.drain();
        let peak = self.group.as_ref().and_then(MemoryGroup::peak).or(resident_peak);
        Ending {
            outcome,
            stderr: clean_text(&self.messages.bytes),
            memory_peak_bytes: peak.map(|peak| peak.saturating_sub(self.baseline_bytes)),
            cpu_seconds: self.launcher.usage,
        }
    }

    fn reap(&mut self) {
        for process in [self.runner.as_ref(), self.init.as_deref()].into_iter().flatten() {
            kill(process.as_fd());
        }
        self.launcher.reap(self.init.is_none());
    }
}

impl Drop for Jail {
    fn drop(&mut self) {
        // Before the memory group goes.
        self.reap();
    }
}

impl Launched {
    /// Waits for the launcher, which waits for init, which the kernel empties the jail with.
    fn reap(&mut self, at_once: bool) {
        if self.usage.is_some() {
            return;
        }
        let mut wait = [PollFd::new(self.handle.as_fd(), PollFlags::POLLIN)];
        let patience = if at_once { PollTimeout::ZERO } else { PollTimeout::from(END.as_millis() as u16) };
        if poll(&mut wait, patience) != Ok(1) {
            kill(self.handle.as_fd());
        }
        // SAFETY: all zeros is a valid rusage.
        let mut usage: libc::rusage = unsafe { std::mem::zeroed() };
        // SAFETY: our own child, reaped here and nowhere else; a live struct.
        while unsafe { libc::wait4(self.pid, std::ptr::null_mut(), 0, &raw mut usage) } < 0 {
            if io::Error::last_os_error().kind() != io::ErrorKind::Interrupted {
                break;
            }
        }
        let seconds = |time: libc::timeval| time.tv_sec as f64 + time.tv_usec as f64 * 1e-6;
        self.usage = Some(seconds(usage.ru_utime) + seconds(usage.ru_stime));
    }
}

impl Messages {
    /// Reads what is there; true when it is more than allowed.
    fn drain(&mut self) -> bool {
        let mut chunk = [0; 4096];
        while let Ok(n @ 1..) = self.pipe.read(&mut chunk) {
            let room = (self.cap as usize).saturating_sub(self.bytes.len());
            self.bytes.extend_from_slice(&chunk[..n.min(room)]);
            if n > room {
                return true;
            }
        }
        false
    }
}

/// The runner ended before the plugin was loaded: ours.
fn early(status: i32) -> Outcome {
    Outcome::fault("Start", format!("the runner ended before it was closed off (wait status {status:#x})"))
}

/// The process behind a descriptor, in our own numbering.
fn pid_of(process: &OwnedFd) -> io::Result<i32> {
    let text = std::fs::read_to_string(format!("/proc/self/fdinfo/{}", process.as_raw_fd()))?;
    let pid = text.lines().find_map(|line| line.strip_prefix("Pid:")?.trim().parse().ok());
    pid.filter(|pid| *pid > 0).ok_or_else(|| io::Error::other("the process has ended"))
}

/// A size from /proc/PID/status, bytes.
fn status_kib(pid: i32, name: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kib| kib << 10)
}

/// The file whose mapping holds an address; `?` when there is none.
fn mapping_of(maps: &str, address: u64) -> String {
    let holds = |line: &&str| {
        let mut ends = line.split([' ', '-']).map(|end| u64::from_str_radix(end, 16).unwrap_or(0));
        let (start, end) = (ends.next().unwrap_or(0), ends.next().unwrap_or(0));
        (start..end).contains(&address)
    };
    let name = maps.lines().find(holds).and_then(|line| line.split_whitespace().nth(5));
    name.unwrap_or("?").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mapping_of_a_call_is_named() {
        let maps = "7f00-7f10 r-xp 00000000 00:01 5                          /lib/libc.so.6\n\
                    7f20-7f30 rw-p 00000000 00:00 0\n";
        assert_eq!(mapping_of(maps, 0x7f08), "/lib/libc.so.6");
        assert_eq!(mapping_of(maps, 0x7f10), "?");
        assert_eq!(mapping_of(maps, 0x7f28), "?");
    }
}
