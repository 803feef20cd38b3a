//! The supervisor's side of the conversation: release a command, time its answer, watch the runner meanwhile.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use ocb_core::instance::Presented;

use crate::clock::{Clock, ClockKind};
use crate::doorbell::{futex_wait, futex_wake};
use crate::launch::Jail;
use crate::outcome::{Outcome, Phase};
use crate::protocol::{
    Command, MAX_BATCH, SLOT_WORDS, Status, answer, clean_text, contacts_to_copy, parse_status, parse_text_len, request,
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
    slots: Vec<[u64; SLOT_WORDS]>,
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
        Self { jail, kind, clock, number: 0, slots: vec![[0; SLOT_WORDS]], last: now, trial_seconds, trial_ends }
    }

    pub fn kind(&self) -> ClockKind {
        self.kind
    }

    /// The copies of the newest answers, one per question.
    pub fn slots(&self) -> &[[u64; SLOT_WORDS]] {
        &self.slots
    }

    /// Writes the poses of the next questions, at most [`MAX_BATCH`].
    pub fn place(&mut self, questions: &[Presented]) {
        self.ask_for(questions.len());
        let swapped = (0..).zip(questions).fold(0u64, |mask, (i, q)| mask | u64::from(q.swapped) << i);
        self.jail.request.u64(request::SWAPPED).store(swapped, Ordering::Relaxed);
        for (question, Presented { configuration, .. }) in questions.iter().enumerate() {
            let poses = [configuration.pose_a.to_row_major(), configuration.pose_b.to_row_major()];
            for (i, pose) in poses.iter().enumerate() {
                let at = request::POSES + request::POSES_STRIDE * question + 128 * i;
                self.jail.request.store(at, &pose.map(f64::to_bits));
            }
        }
    }

    /// The next command asks so many questions.
    pub fn ask_for(&mut self, questions: usize) {
        assert!((1..=MAX_BATCH).contains(&questions), "a command asks 1 to {MAX_BATCH} questions");
        self.jail.request.u64(request::QUESTIONS).store(questions as u64, Ordering::Relaxed);
        self.slots.resize(questions, [0; SLOT_WORDS]);
    }

    /// Makes sure that a watching runner watches, so that the next question finds it as the null questions did.
    pub fn wake(&mut self, limit_seconds: f64) -> Result<(), Outcome> {
        let asleep = self.jail.answer.u32(answer::RUNNER_SLEEPS).load(Ordering::Relaxed) != 0;
        if self.kind == ClockKind::Spin && (asleep || self.last.elapsed() > DROWSY) {
            self.ask_for(1);
            self.obeyed(Command::Null, Phase::Query, limit_seconds)?;
        }
        Ok(())
    }

    /// Was the moment of the answer missed by too much?
    pub fn disturbed(&self, timed: &Timed) -> bool {
        timed.missed_ns > MISSED_NS && timed.missed_ns > timed.raw_ns / 200.0
    }

    /// Gives a command, waits for its answers and copies each once. An error status becomes its outcome; "gave up" and
    /// "unsupported" are answers.
    pub fn obeyed(&mut self, command: Command, phase: Phase, limit_seconds: f64) -> Result<Timed, Outcome> {
        let before = self.jail.answer.u32(answer::NUMBER).load(Ordering::Acquire);
        if before != self.number {
            return Err(violation(phase, "it answered what had not been asked"));
        }
        self.jail.request.u64(request::COMMAND).store(command as u64, Ordering::Relaxed);
        let timed = self.round_trip(phase, limit_seconds)?;
        self.last = Instant::now();
        for (i, slot) in self.slots.iter_mut().enumerate() {
            self.jail.answer.load(answer::SLOT + answer::SLOT_STRIDE * i, slot);
        }
        for slot in &self.slots {
            match parse_status(slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })? {
                Status::Ok | Status::GaveUp | Status::Unsupported => {}
                Status::Error => return Err(Outcome::Failed { phase, reason: self.reason(slot, phase)? }),
                Status::NotLoaded if phase == Phase::Load => {
                    return Err(Outcome::LoadError { reason: self.reason(slot, phase)? });
                }
                Status::NotLoaded => return Err(violation(phase, "it said that it is no plugin after it was loaded")),
            }
        }
        Ok(timed)
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
        self.text_of(&self.slots[0], phase)
    }

    fn text_of(&self, slot: &[u64; SLOT_WORDS], phase: Phase) -> Result<Vec<u8>, Outcome> {
        let len = parse_text_len(slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })?;
        Ok(self.jail.answer.load_bytes(answer::TEXT, len))
    }

    /// The contacts beside the newest answer, as many as it announces and the buffer holds.
    pub fn contacts(&self) -> Vec<u64> {
        let mut words = vec![0; contacts_to_copy(&self.slots[0])];
        self.jail.answer.load(answer::CONTACTS, &mut words);
        words
    }

    /// The text as a reason for people: one line without its full stop.
    fn reason(&self, slot: &[u64; SLOT_WORDS], phase: Phase) -> Result<String, Outcome> {
        let text = clean_text(&self.text_of(slot, phase)?).replace(['\n', '\t'], " ");
        let short: String = text.chars().take(2000).collect();
        Ok(short.trim().trim_end_matches('.').to_string())
    }
}

fn violation(phase: Phase, rule: &str) -> Outcome {
    Outcome::ProtocolViolation { phase, rule: rule.into() }
}
