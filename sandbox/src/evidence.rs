//! How a runner ended: every piece of evidence is gathered here, from outside.

use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, OwnedFd};
use std::time::{Duration, Instant};

use nix::poll::{PollFd, PollFlags, PollTimeout, poll};

use crate::control::Report;
use crate::launch::Jail;
use crate::memory::MemoryGroup;
use crate::outcome::{DeniedCall, Ending, Outcome, Phase};
use crate::protocol::clean_text;
use crate::seccomp;

/// How long the kernel may take to end a killed jail.
const END: Duration = Duration::from_secs(3);

/// How long a signal may take from the plugin's last store to the begin of its end.
const DYING: Duration = Duration::from_millis(50);

/// The launcher's process, reaped exactly once.
pub(crate) struct Launched {
    pub pid: i32,
    pub handle: OwnedFd,
    pub usage: Option<f64>,
}

/// What the plugin writes, capped.
pub(crate) struct Messages {
    pub pipe: File,
    pub bytes: Vec<u8>,
    pub cap: u64,
}

/// SIGKILL through a process descriptor, which cannot hit anybody else.
pub(crate) fn kill(process: BorrowedFd<'_>) {
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
    /// One look at everything that may have happened; `Some` when the runner's life is over.
    pub fn watch(&mut self, phase: Phase) -> Option<Outcome> {
        if self.killer.asked() {
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

    /// Has the runner's life ended?
    pub fn ended(&self) -> bool {
        let Some(runner) = &self.runner else { return true };
        let mut wait = [PollFd::new(runner.as_fd(), PollFlags::POLLIN)];
        poll(&mut wait, PollTimeout::ZERO) == Ok(1)
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
        let nr = i64::from(call.data.nr);
        let mapping = mapping_of(&maps, call.data.instruction_pointer);
        let call = DeniedCall { nr, name: seccomp::name_of(nr), args: call.data.args, mapping };
        Some(Outcome::SyscallDenied { phase, call: Box::new(call) })
    }

    /// The runner is dead: by whose hand?
    fn how_it_ended(&mut self, phase: Phase) -> Outcome {
        if self.killer.asked() {
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

    /// Kills what is left, reaps it, and gathers what is known.
    pub fn end(mut self, outcome: Outcome) -> Ending {
        let outcome = self.rather_its_death(outcome);
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

    /// What a dying process leaves in the shared memory proves nothing, since the kernel itself writes there for it (the locks
    /// of its robust list): how it died is the outcome then, not the word that was found.
    fn rather_its_death(&mut self, outcome: Outcome) -> Outcome {
        let Outcome::ProtocolViolation { phase, .. } = outcome else { return outcome };
        let begun = Instant::now();
        while let Some(runner) = &self.runner {
            let mut wait = [PollFd::new(runner.as_fd(), PollFlags::POLLIN)];
            if poll(&mut wait, 2u8) == Ok(1) {
                return self.how_it_ended(phase);
            }
            let longest = if is_exiting(self.pid) { END } else { DYING };
            if begun.elapsed() > longest {
                break;
            }
        }
        outcome
    }

    pub(crate) fn reap(&mut self) {
        if self.launcher.usage.is_some() {
            return;
        }
        // Runner first: then init reaps it and leaves by itself, and its processor time is handed up. What an init
        // killed at once leaves behind is emptied by the kernel, but counted nowhere.
        if let Some(runner) = &self.runner {
            kill(runner.as_fd());
            if self.launcher.ended_within(END) {
                return self.launcher.reap();
            }
        }
        if let Some(init) = &self.init {
            kill(init.as_fd());
            if self.launcher.ended_within(END) {
                return self.launcher.reap();
            }
        }
        kill(self.launcher.handle.as_fd());
        self.launcher.reap();
    }
}

impl Launched {
    /// Waits for the launcher, which waits for init, which waits for the runner.
    fn ended_within(&self, time: Duration) -> bool {
        let mut wait = [PollFd::new(self.handle.as_fd(), PollFlags::POLLIN)];
        poll(&mut wait, PollTimeout::from(time.as_millis() as u16)) == Ok(1)
    }

    fn reap(&mut self) {
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

/// A line of /proc/PID/status.
pub(crate) fn status_field(pid: i32, name: &str) -> Option<String> {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    // The first line is the name that the process gave itself, which cannot hold a line feed.
    status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':')).map(|value| value.trim().to_owned())
}

/// Has the kernel begun to take this process down? Its memory may be large, and goes first.
fn is_exiting(pid: i32) -> bool {
    const PF_EXITING: u64 = 4;
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let flags = stat.rsplit(") ").next().and_then(|rest| rest.split(' ').nth(6)?.parse::<u64>().ok());
    flags.is_some_and(|flags| flags & PF_EXITING != 0)
}

/// A size from /proc/PID/status, bytes.
pub(crate) fn status_kib(pid: i32, name: &str) -> Option<u64> {
    status_field(pid, name)?.strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kib| kib << 10)
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
