//! What must come of an attack.

use ocb_core::record::Verdict;
use ocb_sandbox::integrity::Check;
use ocb_sandbox::{Outcome, Phase};

use crate::common::grouped;
use crate::pass::{FOUND, MEASUREMENTS, PROCESSES, found};
use crate::run::Ran;

/// What must come of an attack.
#[derive(Clone, Copy)]
pub enum Expected {
    /// `SyscallDenied` with this call.
    Denied(&'static str),
    /// It got nothing and says so: its words begin like this.
    Says(&'static str),
    /// `Signaled`.
    Signal(i32),
    /// It ended its process with this status.
    Left(i32),
    /// `TimedOut`, by the supervisor's clock.
    TimedOut,
    /// `OutOfMemory`; SIGABRT of its own where there is no memory group.
    OutOfMemory,
    /// `OutputLimit`.
    OutputLimit,
    /// `ProtocolViolation`.
    Violation,
    /// `LoadError`, whose reason has these words.
    Refused(&'static str),
    /// It did what it liked to itself, and the answers are those of an honest plugin.
    Harmless,
    /// It answered, and each answer is judged so.
    Judged(&'static [Verdict]),
    /// The same as harmless, and its work takes the time that it takes.
    WorkSeen,
    /// The same as harmless, and no time is below the clock's resolution.
    Bounded,
    /// Some of its answers are wrong in each process, and every one is judged.
    Wrong,
    /// The same, or `ProtocolViolation`: whether it still works when the next answer is due is a race.
    WrongOrViolation,
    /// One of these checks of the times is not met: `TimingIntegrity`. Found by statistics, so in enough measurements of many.
    Caught(&'static [Check]),
    /// It says the same in every trial; its words begin like this.
    SaysAlike(&'static str),
}

/// Work of the fixtures (`WORK`) takes no less on any machine.
const LEAST_WORK_NS: f64 = 500_000.0;

impl Expected {
    pub fn text(self) -> String {
        match self {
            Expected::Denied(call) => format!("`SyscallDenied` ({call})"),
            Expected::Says(words) => format!("gets nothing: {words}"),
            Expected::Signal(signal) => {
                let named = nix::sys::signal::Signal::try_from(signal).unwrap();
                format!("`Signaled` ({named})")
            }
            Expected::Left(status) => format!("`Failed` (ended its process with status {status})"),
            Expected::TimedOut => "`TimedOut`".into(),
            Expected::OutOfMemory => "`OutOfMemory`".into(),
            Expected::OutputLimit => "`OutputLimit`".into(),
            Expected::Violation => "`ProtocolViolation`".into(),
            Expected::Refused(words) => format!("`LoadError` ({words})"),
            Expected::Harmless => "harmless: answers as an honest plugin".into(),
            Expected::Judged(verdicts) => {
                let names: Vec<String> = verdicts.iter().map(|verdict| format!("`{verdict:?}`")).collect();
                format!("judged {}", names.join(", "))
            }
            Expected::WorkSeen => "harmless: the clock sees its work".into(),
            Expected::Bounded => "harmless: its time is the clock's resolution, never 0".into(),
            Expected::Wrong => "judged `FalseNegative`".into(),
            Expected::WrongOrViolation => "judged `FalseNegative`, or `ProtocolViolation`".into(),
            Expected::Caught(checks) => {
                let names: Vec<&str> = checks.iter().map(|check| check.name()).collect();
                let names = names.join(" or ");
                format!("`TimingIntegrity` ({names}) in at least {FOUND} of {MEASUREMENTS} measurements")
            }
            Expected::SaysAlike(_) => "sees the same in every trial".into(),
        }
    }

    pub fn met_by(self, ran: &Ran, phase: Phase) -> bool {
        match (self, &ran.ending.outcome) {
            (Expected::Denied(name), Outcome::SyscallDenied { phase: p, call }) => *p == phase && call.name == name,
            (Expected::Says(words), Outcome::Failed { reason, .. }) => {
                let call = if phase == Phase::Build { "load_mesh" } else { "collide" };
                reason.starts_with(&format!("{call} returned OCB_ERROR: {words}"))
            }
            (Expected::Signal(signal), Outcome::Signaled { phase: p, signal: s }) => (*p, *s) == (phase, signal),
            (Expected::Left(status), Outcome::Failed { phase: p, reason }) => {
                *p == phase && *reason == format!("it ended its process with exit status {status}")
            }
            (Expected::TimedOut, Outcome::TimedOut { phase: p, cpu, .. }) => *p == phase && !cpu,
            (Expected::OutOfMemory, Outcome::OutOfMemory { phase: p, .. }) => *p == phase,
            // Without a memory group the address space ends, malloc fails, and the attack gives up.
            (Expected::OutOfMemory, Outcome::Signaled { signal, .. }) => *signal == libc::SIGABRT && !grouped(),
            (Expected::OutputLimit, Outcome::OutputLimit { .. }) => true,
            (Expected::Violation, Outcome::ProtocolViolation { phase: p, .. }) => *p == phase,
            (Expected::Refused(words), Outcome::LoadError { reason }) => reason.contains(words),
            (Expected::Harmless, Outcome::Completed) => ran.caught.is_empty() && ran.wrong == 0,
            (Expected::Wrong | Expected::WrongOrViolation, Outcome::Completed) => ran.wrong_in == PROCESSES,
            (Expected::WrongOrViolation, Outcome::ProtocolViolation { phase: p, .. }) => *p == phase,
            (Expected::Caught(checks), Outcome::Completed) => {
                ran.wrong == 0 && found(&ran.caught, checks) >= (ran.measurements * FOUND).div_ceil(MEASUREMENTS)
            }
            (Expected::SaysAlike(words), Outcome::Failed { .. }) => Expected::Says(words).met_by(ran, phase),
            (Expected::Judged(verdicts), Outcome::Completed) => ran.verdicts == verdicts,
            (Expected::WorkSeen, Outcome::Completed) => ran.shortest_ns > LEAST_WORK_NS,
            (Expected::Bounded, Outcome::Completed) => ran.bounded,
            _ => false,
        }
    }
}
