//! Work of a program of ours that calls libraries of others, done in a jail and watched from here. The program's side:
//! `inside/task.rs`.
//!
//! The program is built with the service, so it counts as trusted: it runs under the layers that the machine has. What it sends
//! is hostile input all the same, because its libraries may have been overrun by what they were given.

use std::marker::PhantomData;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::clock::ClockKind;
use crate::confine::{own_cpus, pin_process};
use crate::cpus::Places;
use crate::doorbell::futex_wake;
use crate::exchange::Exchange;
use crate::launch::Killer;
use crate::launcher::Launcher;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::work;
use crate::trial::Sheet;

/// A jailed program at work. It dies with the thread that started it, or when this is dropped.
pub struct Work {
    exchange: Exchange,
    room: usize,
    limit: Duration,
    begun: Instant,
    /// Since when it waits for leave to take times, and how long it did.
    asks: Option<Instant>,
    waited: Duration,
    granted: bool,
    /// How it ended, once that was noticed.
    ended: Option<Outcome>,
    /// Where it may run: where the watching thread may.
    cpus: Vec<usize>,
    _thread: PhantomData<*const ()>,
}

/// How far the work is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// At so much of a step, as the program numbers them.
    Working {
        /// The step.
        step: u8,
        /// Parts done.
        done: u32,
        /// Of so many.
        total: u32,
    },
    /// It waits for [`Work::grant`].
    AsksToMeasure,
    /// [`Work::finish`] gives the result.
    Done,
}

impl Work {
    /// Starts a program with these bytes; the result may have up to `room` bytes. On a machine without namespaces threads cannot
    /// be counted, so that the program gets none there.
    pub fn start(program: &Path, policy: &Policy, input: &[u8], room: usize) -> Result<Self, Ending> {
        match Self::start_with(program, policy.clone(), input, room) {
            Err(Ending { outcome: Outcome::SandboxFault { step, .. }, .. }) if step == "Threads" => {
                Self::start_with(program, Policy { threads: 1, ..policy.clone() }, input, room)
            }
            result => result,
        }
    }

    fn start_with(program: &Path, policy: Policy, input: &[u8], room: usize) -> Result<Self, Ending> {
        let policy = Policy { trusted: true, ..policy };
        let limit = Duration::from_secs_f64(policy.trial_seconds.clamp(0.0, 1e9));
        let launcher = Launcher::new(program.to_owned(), policy);
        let places = Places { runner: Vec::new(), supervisor: None, kind: ClockKind::Futex };
        let sheet = Sheet::of_bytes(input, work::RESULT + room.next_multiple_of(8));
        let mut exchange = launcher.jail(None, &sheet, &Killer::default(), &places)?;
        if let Err(outcome) = launcher.tighten(&mut exchange) {
            return Err(exchange.jail.end(outcome));
        }
        Ok(Self {
            exchange,
            room,
            limit,
            begun: Instant::now(),
            asks: None,
            waited: Duration::ZERO,
            granted: false,
            ended: None,
            cpus: own_cpus().unwrap_or_default(),
            _thread: PhantomData,
        })
    }

    /// Process id of the program, as this process sees it.
    pub fn pid(&self) -> i32 {
        self.exchange.jail.pid
    }

    /// How far it is, or how it ended. To be called often: this also keeps the program on the CPUs of the calling thread, and
    /// notices its end.
    pub fn look(&mut self) -> Result<Seen, Outcome> {
        if let Some(outcome) = &self.ended {
            return Err(outcome.clone());
        }
        let seen = self.seen();
        self.ended = seen.as_ref().err().cloned();
        seen
    }

    fn seen(&mut self) -> Result<Seen, Outcome> {
        self.follow();
        let answer = &self.exchange.jail.answer;
        if answer.u64(work::DONE).load(Ordering::Acquire) != 0 {
            return Ok(Seen::Done);
        }
        let progress = answer.u64(work::PROGRESS).load(Ordering::Relaxed);
        let asks = !self.granted && answer.u32(work::ASKS).load(Ordering::Acquire) != 0;
        if let Some(outcome) = self.exchange.jail.watch(Phase::Query) {
            return Err(outcome);
        }
        if asks {
            self.asks.get_or_insert_with(Instant::now);
            return Ok(Seen::AsksToMeasure);
        }
        if self.begun.elapsed() > self.limit + self.waited {
            let limit_seconds = self.limit.as_secs_f64();
            return Err(Outcome::TimedOut { phase: Phase::Query, limit_seconds, cpu: false });
        }
        let (step, done, total) = work::progress_of(progress);
        Ok(Seen::Working { step, done, total })
    }

    /// It may take times now. While it waited, its time limit did not run.
    pub fn grant(&mut self) {
        self.waited += self.asks.take().map_or(Duration::ZERO, |asked| asked.elapsed());
        self.granted = true;
        let word = self.exchange.jail.request.u32(work::GRANTED);
        word.store(1, Ordering::Release);
        futex_wake(word);
    }

    /// Ends it, and copies its result: nothing that it writes later counts.
    pub fn finish(self) -> Result<Vec<u8>, Ending> {
        let jail = self.exchange.jail;
        let len = (jail.answer.u64(work::DONE).load(Ordering::Acquire) as usize).wrapping_sub(1);
        if len > self.room {
            let rule = "it announced more bytes than there is room for".to_owned();
            return Err(jail.end(Outcome::ProtocolViolation { phase: Phase::Query, rule }));
        }
        let result = jail.answer.load_bytes(work::RESULT, len);
        jail.end(Outcome::Completed);
        Ok(result)
    }

    /// Ends it after an outcome that [`Work::look`] gave.
    pub fn fail(self, outcome: Outcome) -> Ending {
        self.exchange.jail.end(outcome)
    }

    /// A host that takes its threads off the measuring CPU means this program, too.
    fn follow(&mut self) {
        let Ok(cpus) = own_cpus() else { return };
        if cpus != self.cpus {
            pin_process(self.exchange.jail.pid, &cpus);
            self.cpus = cpus;
        }
    }
}
