//! How a runner ended, and whose fault it was.

use std::fmt;

use crate::integrity::Finding;

/// How a runner ended. `Display` is one sentence for the person who asked for the run.
///
/// Every variant except [`Outcome::SandboxFault`], [`Outcome::FileReplaced`] and [`Outcome::Cancelled`] speaks about the plugin. All evidence is
/// taken outside the jail: exit statuses from the jail's init, the memory group's counters, the seccomp listener, the
/// supervisor's clock.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All that was asked was answered. Proves nothing about the answers.
    Completed,
    /// The plugin said that it cannot go on, or ended its process.
    Failed {
        /// During what.
        phase: Phase,
        /// What it said, or how it left.
        reason: String,
    },
    /// The file could not be loaded as a plugin of this interface.
    LoadError {
        /// The loader's or the runner's reason.
        reason: String,
    },
    /// The plugin file is not the one that was meant: it was replaced or removed after it had been read. Nobody's fault but of
    /// who changed it: such a run says nothing about the plugin, and nothing about us.
    FileReplaced {
        /// What is there instead.
        reason: String,
    },
    /// Killed by a signal of its own making.
    Signaled {
        /// During what.
        phase: Phase,
        /// Signal number.
        signal: i32,
    },
    /// Took longer than the policy allows.
    TimedOut {
        /// During what.
        phase: Phase,
        /// The limit that was reached, seconds.
        limit_seconds: f64,
        /// The limit counts processor time instead of wall time.
        cpu: bool,
    },
    /// Used more memory than the policy allows.
    OutOfMemory {
        /// During what.
        phase: Phase,
        /// The limit, bytes.
        limit_bytes: u64,
    },
    /// Wrote more to its standard error than the policy allows.
    OutputLimit {
        /// The limit, bytes.
        limit_bytes: u64,
    },
    /// Made a system call that the allow-list does not have.
    SyscallDenied {
        /// During what.
        phase: Phase,
        /// The call.
        call: Box<DeniedCall>,
    },
    /// What came out of the runner breaks the rules of the protocol.
    ProtocolViolation {
        /// During what.
        phase: Phase,
        /// Which rule.
        rule: String,
    },
    /// What was measured from outside does not fit together.
    TimingIntegrity {
        /// The check, and what it found.
        finding: Finding,
    },
    /// The host ended it on request; nobody's fault.
    Cancelled,
    /// The jail could not be built or kept: our fault or this machine's, never the plugin's.
    SandboxFault {
        /// The step of the recipe (see `sandbox/README.md`).
        step: String,
        /// What went wrong, and what would mend it when that is known.
        reason: String,
    },
}

/// A system call that the allow-list does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeniedCall {
    /// Its number.
    pub nr: i64,
    /// Its name, `?` when it has none.
    pub name: String,
    /// Its six arguments.
    pub args: [u64; 6],
    /// The file whose code made the call, `?` when there is none.
    pub mapping: String,
}

/// What the plugin was asked to do when it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Loading the file; its constructors run here.
    Load,
    /// Building the structure of an object.
    Build,
    /// Answering a query.
    Query,
}

impl Phase {
    /// As plugin.h names it.
    pub fn mark(self) -> &'static str {
        match self {
            Phase::Load => "[load]",
            Phase::Build => "[build]",
            Phase::Query => "[query]",
        }
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Phase::Load => "while loading",
            Phase::Build => "while building its structure",
            Phase::Query => "while answering a query",
        })
    }
}

impl Outcome {
    /// The variant's name as the glossary has it.
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Completed => "Completed",
            Outcome::Failed { .. } => "Failed",
            Outcome::LoadError { .. } => "LoadError",
            Outcome::FileReplaced { .. } => "FileReplaced",
            Outcome::Signaled { .. } => "Signaled",
            Outcome::TimedOut { .. } => "TimedOut",
            Outcome::OutOfMemory { .. } => "OutOfMemory",
            Outcome::OutputLimit { .. } => "OutputLimit",
            Outcome::SyscallDenied { .. } => "SyscallDenied",
            Outcome::ProtocolViolation { .. } => "ProtocolViolation",
            Outcome::TimingIntegrity { .. } => "TimingIntegrity",
            Outcome::Cancelled => "Cancelled",
            Outcome::SandboxFault { .. } => "SandboxFault",
        }
    }

    /// Our fault or this machine's: such a run says nothing about the plugin.
    pub fn ours(&self) -> bool {
        matches!(self, Outcome::SandboxFault { .. })
    }

    /// What the plugin was asked to do when it ended.
    pub fn phase(&self) -> Option<Phase> {
        match self {
            Outcome::Failed { phase, .. }
            | Outcome::Signaled { phase, .. }
            | Outcome::TimedOut { phase, .. }
            | Outcome::OutOfMemory { phase, .. }
            | Outcome::SyscallDenied { phase, .. }
            | Outcome::ProtocolViolation { phase, .. } => Some(*phase),
            _ => None,
        }
    }

    pub(crate) fn fault(step: impl Into<String>, reason: impl fmt::Display) -> Self {
        Outcome::SandboxFault { step: step.into(), reason: reason.to_string() }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outcome::Completed => write!(f, "The plugin answered every query."),
            Outcome::Failed { phase, reason } => write!(f, "The plugin reported an error {phase}: {reason}."),
            Outcome::LoadError { reason } => write!(f, "The file could not be loaded as a plugin: {reason}."),
            Outcome::FileReplaced { reason } => {
                write!(
                    f,
                    "The plugin file was replaced after it had been read: {reason}. Start the service or command again."
                )
            }
            Outcome::Signaled { phase, signal } => {
                write!(f, "The plugin crashed {phase} ({}).", signal_name(*signal))
            }
            Outcome::TimedOut { phase, limit_seconds, cpu } => {
                let of = if *cpu { "of processor time " } else { "" };
                write!(f, "The plugin was stopped {phase}: it took longer than the {limit_seconds} s {of}allowed.")
            }
            Outcome::OutOfMemory { phase, limit_bytes } => {
                write!(f, "The plugin ran out of memory {phase}: it may use {} MiB.", limit_bytes >> 20)
            }
            Outcome::OutputLimit { limit_bytes } => {
                write!(f, "The plugin wrote more than the {limit_bytes} bytes allowed to its standard error.")
            }
            Outcome::SyscallDenied { phase, call } => {
                let DeniedCall { nr, name, args, mapping } = &**call;
                write!(
                    f,
                    "The plugin made the forbidden system call {name} (number {nr}, arguments {:#x} {:#x} {:#x}) from \
                     {mapping} {phase}.",
                    args[0], args[1], args[2]
                )
            }
            Outcome::ProtocolViolation { phase, rule } => {
                write!(f, "The plugin tampered with its runner {phase}: {rule}.")
            }
            Outcome::TimingIntegrity { finding } => {
                write!(f, "The plugin's times cannot be trusted: {finding}.")
            }
            Outcome::Cancelled => write!(f, "The run was cancelled."),
            Outcome::SandboxFault { step, reason } => {
                write!(f, "The sandbox failed at step '{step}': {reason}. This is not the plugin's fault.")
            }
        }
    }
}

impl std::error::Error for Outcome {}

/// `SIGSEGV, signal 11`; only the number for signals that have no name.
fn signal_name(signal: i32) -> String {
    match nix::sys::signal::Signal::try_from(signal) {
        Ok(named) => format!("{named}, signal {signal}"),
        Err(_) => format!("signal {signal}"),
    }
}

/// The last word on a runner.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// How it ended.
    pub outcome: Outcome,
    /// What the plugin wrote to its standard output and error, control characters stripped, capped by the policy.
    pub stderr: String,
    /// Peak memory above what the empty runner held before the plugin was loaded.
    pub memory_peak_bytes: Option<u64>,
    /// Processor time of the whole jail.
    pub cpu_seconds: Option<f64>,
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.outcome.fmt(f)
    }
}

impl std::error::Error for Ending {}

impl From<Outcome> for Ending {
    fn from(outcome: Outcome) -> Self {
        Ending { outcome, stderr: String::new(), memory_peak_bytes: None, cpu_seconds: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_our_own_fault_is_ours() {
        assert!(Outcome::fault("clone", "no").ours());
        assert!(!Outcome::Signaled { phase: Phase::Query, signal: 11 }.ours());
        assert!(!Outcome::Cancelled.ours());
    }

    #[test]
    fn a_crash_is_named() {
        let text = Outcome::Signaled { phase: Phase::Query, signal: 11 }.to_string();
        assert_eq!(text, "The plugin crashed while answering a query (SIGSEGV, signal 11).");
    }
}
