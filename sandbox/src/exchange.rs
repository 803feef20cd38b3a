//! The supervisor's side of the conversation: release a command, time its answer, watch the runner meanwhile.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::clock::{Clock, ClockKind};
use crate::doorbell::{futex_wait, futex_wake};
use crate::launch::Jail;
use crate::outcome::{Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{
    Command, MAX_BATCH, SLOT_WORDS, Status, answer, clean_text, contacts_to_copy, parse_status, parse_text_len, request,
};
use crate::question::Question;
use crate::trial::{MeshPlace, Part};
use crate::usage::{Meter, Usage};

/// The jail is looked at so often while an answer is awaited.
const LOOK_NS: f64 = 1e6;
/// After so long the supervisor sleeps between looks: what the wake-up adds is then less than a hundredth. Where times are rough,
/// it adds less than the whole.
const WATCH_NS: f64 = 5e6;
const WATCH_ROUGHLY_NS: f64 = 1e5;
/// Time of the supervisor's own that was lost, longer than this and than a hundredth of the whole, disturbs a sample.
const MISSED_NS: f64 = 5000.0;
/// Copying one contact takes no longer than this.
const COPY_NS: f64 = 20.0;
/// How long a runner may take to fall asleep when it is told to rest, and before it is asked by the sleeping clock.
const REST: Duration = Duration::from_millis(5);
const LEAVING: Duration = Duration::from_micros(20);
/// What a runner computes between its answer and its sleep, at most.
const FALLING_ASLEEP_NS: f64 = 20_000.0;
const SETTLE: Duration = Duration::from_secs(2);
/// A runner that was not asked for so long may have begun to sleep.
const DROWSY: Duration = Duration::from_millis(1);

/// A jail with its clock.
pub(crate) struct Exchange {
    pub jail: Jail,
    kind: ClockKind,
    clock: Clock,
    meter: Meter,
    threads: bool,
    /// How long a watching supervisor watches for an answer.
    watch_ns: f64,
    number: u32,
    slots: Vec<[u64; SLOT_WORDS]>,
    contacts: Vec<u64>,
    /// The runner was told to rest, or says that it sleeps: the next command has to wake it.
    resting: bool,
    last: Instant,
    trial_seconds: f64,
    trial_ends: Instant,
}

/// A moment at which the runner has been told to rest, or at which it is told to go on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Resting {
    /// When.
    pub told: Instant,
    /// What the runner had computed when it slept; absent where the kernel does not count.
    pub usage: Option<Usage>,
    /// A wait for its CPU that has begun and is counted when it ends: its part until now, at most so long, nanoseconds.
    pub waiting_ns: f64,
}

impl Resting {
    /// How long the runner has waited for its CPU since, of what the kernel has counted since.
    pub fn waited_ns(&self, counted: Usage) -> f64 {
        (counted.delay_ns - self.waiting_ns).max(0.0)
    }
}

/// How long one command took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timed {
    /// From before the first word of the command could be seen until its whole answer was in the supervisor's own memory.
    pub raw_ns: f64,
    /// The supervisor lost so much of that to something else on its own CPU, at most.
    pub missed_ns: f64,
}

/// What a command shows the runner beside its number.
#[derive(Clone, Copy)]
enum Shown<'a> {
    Nothing,
    Poses(&'a [Poses]),
    Mesh(&'a Part),
}

/// What of one question is written beside its kind.
#[derive(Clone)]
pub(crate) struct Poses {
    /// Numbers of the objects that stand first and second.
    pub objects: [u32; 2],
    /// 16 numbers for each pose.
    words: [u64; 32],
}

impl From<&Question> for Poses {
    fn from(Question { configuration, objects, .. }: &Question) -> Self {
        let mut words = [0; 32];
        let [a, b] = [configuration.pose_a, configuration.pose_b].map(|pose| pose.to_row_major().map(f64::to_bits));
        words[..16].copy_from_slice(&a);
        words[16..].copy_from_slice(&b);
        Poses { objects: *objects, words }
    }
}

impl Exchange {
    pub fn new(jail: Jail, kind: ClockKind, clock: Clock, policy: &Policy) -> Self {
        let (now, trial_seconds, threads) = (Instant::now(), policy.trial_seconds, policy.threads > 1);
        let trial_ends = now + Duration::from_secs_f64(trial_seconds.clamp(0.0, 1e9));
        let meter = Meter::of(jail.pid, threads);
        Self {
            jail,
            kind,
            clock,
            meter,
            threads,
            watch_ns: if policy.rough_clock { WATCH_ROUGHLY_NS } else { WATCH_NS },
            number: 0,
            slots: vec![[0; SLOT_WORDS]],
            contacts: Vec::new(),
            resting: false,
            last: now,
            trial_seconds,
            trial_ends,
        }
    }

    pub fn kind(&self) -> ClockKind {
        self.kind
    }

    pub fn meter(&self) -> &Meter {
        &self.meter
    }

    /// The copies of the newest answers, one per question.
    pub fn slots(&self) -> &[[u64; SLOT_WORDS]] {
        &self.slots
    }

    /// The copies of the contacts beside the newest answer, as many as it announced and the buffer holds.
    pub fn contacts(&self) -> &[u64] {
        &self.contacts
    }

    /// Makes sure that a watching runner watches, so that the next question finds it as the null questions did. True when it
    /// had to be woken.
    pub fn wake(&mut self, limit_seconds: f64) -> Result<bool, Outcome> {
        let asleep = self.resting || self.jail.answer.u32(answer::RUNNER_SLEEPS).load(Ordering::Relaxed) != 0;
        let drowsy = asleep || self.last.elapsed() > DROWSY;
        if drowsy && self.kind == ClockKind::Spin {
            self.resting = asleep;
            self.obeyed(Command::Null, Phase::Query, limit_seconds)?;
        }
        Ok(drowsy)
    }

    /// Lets the runner sleep until the next command, and waits until it does, for some milliseconds at most: a runner that
    /// goes on computing is told by the kernel's counters.
    pub fn rest(&mut self, limit_seconds: f64) -> Result<Resting, Outcome> {
        self.obeyed(Command::Rest, Phase::Query, limit_seconds)?;
        let told = Instant::now();
        self.resting = true;
        // A thread says that it sleeps a little before it leaves its CPU, and until then its counters lag by up to a tick.
        let said = self.settles(REST).then(Instant::now);
        while said.is_some_and(|said| said.elapsed() < LEAVING) {
            std::hint::spin_loop();
        }
        self.settles(REST);
        Ok(Resting { told, usage: self.meter.read(), waiting_ns: 0.0 })
    }

    /// The end of a rest, just before the runner is told to go on. On a busy machine it may not even have fallen asleep.
    pub fn resumed(&self, rest: Option<&Resting>) -> Resting {
        let (told, ready) = (Instant::now(), self.meter.is_ready());
        let usage = self.meter.read();
        let used = rest.and_then(|rest| Some(((told - rest.told).as_nanos() as f64, usage?.since(rest.usage?))));
        let waiting_ns = used.filter(|_| ready).map_or(0.0, |(rested_ns, used)| uncounted_ns(rested_ns, used));
        Resting { told, usage, waiting_ns }
    }

    /// How long the runner has computed since an earlier rest although nothing was open: more than the time between that rest's
    /// end and this one's beginning, without its waits for the CPU. `asked_ns` is the time in which something was open, by the
    /// sleeping clock; a watching runner computes all the while.
    pub fn beside_ns(&self, resumed: &Resting, now: &Resting, asked_ns: f64, questions: usize) -> f64 {
        let Some((then, now_used)) = resumed.usage.zip(now.usage) else { return 0.0 };
        let used = now_used.since(then);
        let open_ns = match self.kind {
            ClockKind::Spin => (now.told - resumed.told).as_nanos() as f64 - resumed.waited_ns(used),
            ClockKind::Futex => asked_ns + FALLING_ASLEEP_NS * questions as f64,
        };
        (used.run_ns - open_ns - FALLING_ASLEEP_NS).max(0.0)
    }

    /// Waits until the runner sleeps in the kernel, but no longer than this. Where the kernel does not say, it does.
    fn settles(&self, longest: Duration) -> bool {
        let begun = Instant::now();
        while self.meter.is_asleep() == Some(false) {
            if begun.elapsed() > longest {
                // It may have died meanwhile, which is told when it is asked.
                return self.jail.ended();
            }
            std::thread::yield_now();
        }
        true
    }

    /// Gives a command, waits for its answer and copies it. An error status becomes its outcome; "gave up" and
    /// "unsupported" are answers.
    pub fn obeyed(&mut self, command: Command, phase: Phase, limit_seconds: f64) -> Result<Timed, Outcome> {
        self.command(command, phase, limit_seconds, Shown::Nothing)
    }

    /// Asks up to [`MAX_BATCH`] questions at once.
    pub fn asked(&mut self, command: Command, questions: &[Poses], limit_seconds: f64) -> Result<Timed, Outcome> {
        assert!((1..=MAX_BATCH).contains(&questions.len()), "a command has 1 to {MAX_BATCH} queries");
        self.command(command, Phase::Query, limit_seconds, Shown::Poses(questions))
    }

    /// Shows a mesh and has its structure built.
    pub fn built(&mut self, mesh: &Part, limit_seconds: f64) -> Result<Timed, Outcome> {
        self.command(Command::Build, Phase::Build, limit_seconds, Shown::Mesh(mesh))
    }

    fn command(
        &mut self,
        command: Command,
        phase: Phase,
        limit_seconds: f64,
        shown: Shown<'_>,
    ) -> Result<Timed, Outcome> {
        let before = self.jail.answer.u32(answer::NUMBER).load(Ordering::Acquire);
        if before != self.number {
            return Err(violation(phase, "it wrote an answer without a query"));
        }
        let questions = if let Shown::Poses(poses) = shown { poses.len() } else { 1 };
        self.slots.resize(questions, [0; SLOT_WORDS]);
        // One that is awake need not be woken, and would be quicker by that.
        if self.kind == ClockKind::Futex && phase == Phase::Query && !self.settles(SETTLE) {
            return Err(violation(phase, "it keeps running between queries, on the only CPU"));
        }
        let timed = self.round_trip(command, phase, limit_seconds, shown)?;
        (self.last, self.resting) = (Instant::now(), false);
        for slot in &self.slots {
            match parse_status(slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })? {
                Status::Ok | Status::GaveUp | Status::Unsupported => {}
                Status::Error => return Err(Outcome::Failed { phase, reason: self.reason(slot, phase)? }),
                Status::NotLoaded if phase == Phase::Load => {
                    return Err(Outcome::LoadError { reason: self.reason(slot, phase)? });
                }
                Status::NotLoaded => return Err(violation(phase, "it reported a load error after it had been loaded")),
            }
        }
        Ok(timed)
    }

    /// The words of a command, the number last.
    #[inline]
    fn show(&self, command: Command, shown: Shown<'_>, number: u32) {
        let (request, mut questions) = (&self.jail.request, 1);
        match shown {
            Shown::Nothing => {}
            Shown::Mesh(mesh) => {
                let MeshPlace { vertices, triangles, positions_at, triangles_at } = mesh.place;
                let place = [vertices.into(), triangles.into(), positions_at as u64, triangles_at as u64];
                request.store(request::MESH, &place);
                self.jail.trial.store_bytes(positions_at, &mesh.bytes);
            }
            Shown::Poses(poses) => {
                questions = poses.len() as u64;
                for (i, Poses { objects: [first, second], words }) in poses.iter().enumerate() {
                    request.store(request::OBJECTS + 8 * i, &[u64::from(*first) | u64::from(*second) << 32]);
                    request.store(request::POSES + request::POSES_STRIDE * i, words);
                }
            }
        }
        request.u64(request::COMMAND).store(command as u64, Ordering::Relaxed);
        request.u64(request::QUESTIONS).store(questions, Ordering::Relaxed);
        request.u32(request::NUMBER).store(number, Ordering::SeqCst);
    }

    /// The time begins before anything of the command can be seen, and ends when its whole answer has been copied: a number
    /// that is written before the answer gains nothing.
    fn round_trip(
        &mut self,
        command: Command,
        phase: Phase,
        limit_seconds: f64,
        shown: Shown<'_>,
    ) -> Result<Timed, Outcome> {
        let clock = self.clock;
        let (asked, answered) = (self.number, self.number.wrapping_add(1));
        let [look, watch] = [LOOK_NS, self.watch_ns].map(|ns| clock.in_ticks(ns));
        // While it is loaded nothing is asked, and the CPU that a watcher takes may be the runner's.
        let sleeps = self.kind == ClockKind::Futex || phase == Phase::Load;
        let begun = clock.ticks();
        if sleeps {
            self.jail.request.u32(request::SUPERVISOR_SLEEPS).store(1, Ordering::SeqCst);
        }
        self.show(command, shown, answered);
        if sleeps || self.resting {
            futex_wake(self.jail.request.u32(request::NUMBER));
        }
        let released = clock.ticks();
        let (mut polled, mut looked, mut halfway) = (released, released, None);
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
                self.look(phase, limit_seconds, waited_ns, &mut halfway)?;
            }
            if !sleeps && now.saturating_sub(released) > watch {
                self.jail.request.u32(request::SUPERVISOR_SLEEPS).store(1, Ordering::SeqCst);
            }
            polled = now;
            if self.jail.request.u32(request::SUPERVISOR_SLEEPS).load(Ordering::Relaxed) == 0 {
                std::hint::spin_loop();
            } else {
                futex_wait(self.jail.answer.u32(answer::NUMBER), asked, Some(Duration::from_nanos(LOOK_NS as u64)));
            }
        };
        self.copy(command);
        let copied = clock.ticks();
        self.number = answered;
        let slept = self.jail.request.u32(request::SUPERVISOR_SLEEPS).swap(0, Ordering::SeqCst) != 0;
        // A sleeper is woken by the answer; only a watcher can miss the moment.
        let unseen = if slept { 0.0 } else { clock.nanoseconds(polled, seen) };
        let copying = clock.nanoseconds(seen, copied) - COPY_NS * self.contacts.len() as f64;
        // Waking a runner on a shared CPU may return only after its answer: that is its time, not lost time.
        let includes_work = sleeps || matches!(shown, Shown::Mesh(_));
        let releasing = if includes_work { 0.0 } else { clock.nanoseconds(begun, released) };
        Ok(Timed { raw_ns: clock.nanoseconds(begun, copied), missed_ns: unseen.max(copying).max(releasing) })
    }

    /// Copies the answers once; what is read afterwards is the copy.
    #[inline]
    fn copy(&mut self, command: Command) {
        for (i, slot) in self.slots.iter_mut().enumerate() {
            self.jail.answer.load(answer::SLOT + answer::SLOT_STRIDE * i, slot);
        }
        self.contacts.clear();
        if matches!(command, Command::CollisionAll | Command::CountCollisionAll) {
            self.contacts.resize(contacts_to_copy(&self.slots[0]), 0);
            self.jail.answer.load(answer::CONTACTS, &mut self.contacts);
        }
    }

    /// Was so much of the time lost to something else that it says little of the plugin?
    pub fn disturbed(&self, timed: &Timed) -> bool {
        timed.missed_ns > MISSED_NS && timed.missed_ns > timed.raw_ns / 100.0
    }

    /// Evidence, limits, and a wake-up in case the runner had just gone to sleep.
    #[cold]
    fn look(
        &mut self,
        phase: Phase,
        limit_seconds: f64,
        waited_ns: f64,
        halfway: &mut Option<(f64, Usage)>,
    ) -> Result<(), Outcome> {
        if let Some(outcome) = self.jail.watch(phase) {
            return Err(outcome);
        }
        let limit_ns = limit_seconds * 1e9;
        // On a busy machine the runner may get no CPU for long. From half of the limit on, that is not counted; the limit of the
        // trial counts it.
        if halfway.is_none() && waited_ns > limit_ns / 2.0 {
            *halfway = self.meter.read().map(|usage| (waited_ns, usage));
        }
        if waited_ns > limit_ns && waited_ns - self.starved_ns(*halfway, waited_ns) > limit_ns {
            return Err(Outcome::TimedOut { phase, limit_seconds, cpu: false });
        }
        if Instant::now() > self.trial_ends {
            return Err(Outcome::TimedOut { phase, limit_seconds: self.trial_seconds, cpu: false });
        }
        futex_wake(self.jail.request.u32(request::NUMBER));
        Ok(())
    }

    /// How long the runner got no CPU since then, although it was ready to compute, nanoseconds. Of several threads some may wait while
    /// others compute, so that nothing is said.
    fn starved_ns(&self, then: Option<(f64, Usage)>, now_ns: f64) -> f64 {
        let then = then.filter(|_| !self.threads);
        let Some(((then_ns, then), now)) = then.zip(self.meter.read()) else { return 0.0 };
        let used = now.since(then);
        // The kernel counts a wait when it has ended.
        if self.meter.is_ready() { now_ns - then_ns - used.run_ns } else { used.delay_ns }
    }

    /// The text beside the newest answer.
    pub fn text(&self, phase: Phase) -> Result<Vec<u8>, Outcome> {
        self.text_of(&self.slots[0], phase)
    }

    fn text_of(&self, slot: &[u64; SLOT_WORDS], phase: Phase) -> Result<Vec<u8>, Outcome> {
        let len = parse_text_len(slot).map_err(|rule| Outcome::ProtocolViolation { phase, rule })?;
        Ok(self.jail.answer.load_bytes(answer::TEXT, len))
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

/// Of so long a rest, what was neither computing nor a wait that has ended.
fn uncounted_ns(rested_ns: f64, used: Usage) -> f64 {
    (rested_ns - used.run_ns - used.delay_ns).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wait_that_began_in_the_rest_is_none_of_the_stretch() {
        let resumed = |waiting_ns| Resting { told: Instant::now(), usage: None, waiting_ns };
        // It computes in 1 ms of a rest of 15 ms, and then waits for its CPU until 3 ms of the stretch have passed: the kernel
        // counts 17 ms then.
        let waiting_ns = uncounted_ns(15e6, Usage { run_ns: 1e6, delay_ns: 0.0 });
        assert_eq!(resumed(waiting_ns).waited_ns(Usage { run_ns: 20e6, delay_ns: 17e6 }), 3e6);
        // A wait that ended in the rest is counted there already, and whoever slept in it has only waited since.
        assert_eq!(uncounted_ns(15e6, Usage { run_ns: 1e6, delay_ns: 14e6 }), 0.0);
        assert_eq!(resumed(0.0).waited_ns(Usage { run_ns: 15e6, delay_ns: 5e6 }), 5e6);
    }
}
