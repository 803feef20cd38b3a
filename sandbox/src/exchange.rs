//! The supervisor's side of the conversation: release a command, time its answer, watch the runner meanwhile.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use ocb_core::configuration::Configuration;

use crate::clock::{Clock, ClockKind};
use crate::doorbell::{futex_wait, futex_wake};
use crate::launch::Jail;
use crate::outcome::{Outcome, Phase};
use crate::protocol::{
    Command, SLOT_WORDS, Status, answer, clean_text, contacts_to_copy, parse_status, parse_text_len, request,
};

/// The jail is looked at so often while an answer is awaited.
const LOOK_NS: f64 = 1e6;
/// After so long the supervisor sleeps between looks: what the wake-up adds is then less than a thousandth.
const WATCH_NS: f64 = 50e6;
/// A missed moment longer than this, and longer than a two-hundredth of the time, disturbs a sample.
const MISSED_NS: f64 = 1000.0;
/// A runner that was not asked for so long may have begun to sleep.
const DROWSY: Duration = Duration::from_millis(1);

/// A jail with its clock.
pub(crate) struct Exchange {
    pub jail: Jail,
    kind: ClockKind,
    clock: Clock,
    number: u32,
    slot: [u64; SLOT_WORDS],
    last: Instant,
    trial_seconds: f64,
    trial_ends: Instant,
}

/// How long one command took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timed {
    /// From release to seen answer.
    pub raw_ns: f64,
    /// The answer came at most so long before it was seen.
    pub missed_ns: f64,
}

impl Exchange {
    pub fn new(jail: Jail, kind: ClockKind, clock: Clock, trial_seconds: f64) -> Self {
        let now = Instant::now();
        let trial_ends = now + Duration::from_secs_f64(trial_seconds.clamp(0.0, 1e9));
        Self { jail, kind, clock, number: 0, slot: [0; SLOT_WORDS], last: now, trial_seconds, trial_ends }
    }

    pub fn kind(&self) -> ClockKind {
        self.kind
    }

    /// The copy of the newest answer.
    pub fn slot(&self) -> &[u64; SLOT_WORDS] {
        &self.slot
    }

    /// Writes the poses of the next question.
    pub fn place(&mut self, configuration: &Configuration) {
        let poses = [configuration.pose_a.to_row_major(), configuration.pose_b.to_row_major()];
        for (i, pose) in poses.iter().enumerate() {
            self.jail.request.store(request::POSES + 128 * i, &pose.map(f64::to_bits));
        }
    }

    /// Makes sure that a watching runner watches, so that the next question finds it as the null questions did.
    pub fn wake(&mut self, limit_seconds: f64) -> Result<(), Outcome> {
        let asleep = self.jail.answer.u32(answer::RUNNER_SLEEPS).load(Ordering::Relaxed) != 0;
        if self.kind == ClockKind::Spin && (asleep || self.last.elapsed() > DROWSY) {
            self.obeyed(Command::Null, Phase::Query, limit_seconds)?;
        }
        Ok(())
    }

    /// Was the moment of the answer missed by too much?
    pub fn disturbed(&self, timed: &Timed) -> bool {
        timed.missed_ns > MISSED_NS && timed.missed_ns > timed.raw_ns / 200.0
    }

    /// Gives a command, waits for its answer and copies it once. An error status becomes its outcome; "gave up" and
    /// "unsupported" are answers.
    pub fn obeyed(&mut self, command: Command, phase: Phase, limit_seconds: f64) -> Result<Timed, Outcome> {
        let before = self.jail.answer.u32(answer::NUMBER).load(Ordering::Acquire);
        if before != self.number {
            return Err(violation(phase, "it answered what had not been asked"));
        }
        self.jail.request.u64(request::COMMAND).store(command as u64, Ordering::Relaxed);
        let timed = self.round_trip(phase, limit_seconds)?;
        self.last = Instant::now();
        self.jail.answer.load(answer::SLOT, &mut self.slot);
        match parse_status(&self.slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })? {
            Status::Ok | Status::GaveUp | Status::Unsupported => Ok(timed),
            Status::Error => Err(Outcome::Failed { phase, reason: self.reason(phase)? }),
            Status::NotLoaded => Err(Outcome::LoadError { reason: self.reason(phase)? }),
        }
    }

    fn round_trip(&mut self, phase: Phase, limit_seconds: f64) -> Result<Timed, Outcome> {
        let clock = self.clock;
        let (asked, answered) = (self.number, self.number.wrapping_add(1));
        let look = clock.in_ticks(LOOK_NS);
        let released = clock.ticks();
        self.jail.request.u32(request::NUMBER).store(answered, Ordering::SeqCst);
        // While it is loaded nothing is timed, and the CPU that a watcher takes may be the runner's.
        if self.kind == ClockKind::Futex || phase == Phase::Load {
            self.jail.request.u32(request::SUPERVISOR_SLEEPS).store(1, Ordering::SeqCst);
            futex_wake(self.jail.request.u32(request::NUMBER));
        }
        let (mut polled, mut looked) = (released, released);
        let seen = loop {
            let word = self.jail.answer.u32(answer::NUMBER);
            let number = word.load(Ordering::Acquire);
            let now = clock.ticks();
            if number == answered {
                break now;
            }
            if number != asked {
                return Err(violation(phase, "it answered out of order"));
            }
            if now.saturating_sub(looked) > look {
                looked = now;
                let waited_ns = clock.nanoseconds(released, now);
                self.look(phase, limit_seconds, waited_ns)?;
                if self.kind == ClockKind::Spin && waited_ns > WATCH_NS {
                    self.jail.request.u32(request::SUPERVISOR_SLEEPS).store(1, Ordering::SeqCst);
                }
            }
            polled = now;
            if self.jail.request.u32(request::SUPERVISOR_SLEEPS).load(Ordering::Relaxed) == 0 {
                std::hint::spin_loop();
            } else {
                futex_wait(self.jail.answer.u32(answer::NUMBER), asked, Some(Duration::from_nanos(LOOK_NS as u64)));
            }
        };
        self.number = answered;
        let slept = self.jail.request.u32(request::SUPERVISOR_SLEEPS).swap(0, Ordering::SeqCst) != 0;
        // A sleeper is woken by the answer; only a watcher can miss the moment.
        let missed_ns = if slept { 0.0 } else { clock.nanoseconds(polled, seen) };
        Ok(Timed { raw_ns: clock.nanoseconds(released, seen), missed_ns })
    }

    /// Evidence, limits, and a wake-up in case the runner had just gone to sleep.
    #[cold]
    fn look(&mut self, phase: Phase, limit_seconds: f64, waited_ns: f64) -> Result<(), Outcome> {
        if let Some(outcome) = self.jail.watch(phase) {
            return Err(outcome);
        }
        if waited_ns > limit_seconds * 1e9 {
            return Err(Outcome::TimedOut { phase, limit_seconds, cpu: false });
        }
        if Instant::now() > self.trial_ends {
            return Err(Outcome::TimedOut { phase, limit_seconds: self.trial_seconds, cpu: false });
        }
        futex_wake(self.jail.request.u32(request::NUMBER));
        Ok(())
    }

    /// The text beside the newest answer.
    pub fn text(&self, phase: Phase) -> Result<Vec<u8>, Outcome> {
        let len = parse_text_len(&self.slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })?;
        Ok(self.jail.answer.load_bytes(answer::TEXT, len))
    }

    /// The contacts beside the newest answer, as many as it announces and the buffer holds.
    pub fn contacts(&self) -> Vec<u64> {
        let mut words = vec![0; contacts_to_copy(&self.slot)];
        self.jail.answer.load(answer::CONTACTS, &mut words);
        words
    }

    /// The text as a reason for people: one line without its full stop.
    fn reason(&self, phase: Phase) -> Result<String, Outcome> {
        let text = clean_text(&self.text(phase)?).replace(['\n', '\t'], " ");
        let short: String = text.chars().take(2000).collect();
        Ok(short.trim().trim_end_matches('.').to_string())
    }
}

fn violation(phase: Phase, rule: &str) -> Outcome {
    Outcome::ProtocolViolation { phase, rule: rule.into() }
}
