//! One jailed runner, as its supervisor uses it: ask, time, end. A whole pass of questions: `pass.rs`.

use std::marker::PhantomData;
use std::time::Duration;

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presented;
use ocb_core::query::{Answer, Counters, Query};

use crate::clock::ClockFacts;
use crate::confine::pin;
use crate::exchange::{Exchange, Timed};
use crate::launch::Killer;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Command, parse_answer, parse_counters};
use crate::usage::{Meter, Usage};

/// A runner that is not asked for so long has fallen asleep.
const ASLEEP: Duration = Duration::from_micros(2500);

/// One running jail with a loaded plugin and built objects. Dropping it kills the jail.
pub struct Session {
    pub(crate) policy: Policy,
    exchange: Exchange,
    build_ns: f64,
    clock: ClockFacts,
    meter: Meter,
    ended: Option<Outcome>,
    pinned: Pinned,
    /// The jail dies with the thread that started it, so the session stays there.
    _thread: PhantomData<*const ()>,
}

/// One timed answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// From the question's release to the seen answer, by the supervisor's clock.
    pub raw_ns: f64,
    /// `raw_ns` minus the session's median null round trip; the clock's resolution when below it, never 0.
    pub time_ns: f64,
    /// `time_ns` is only an upper bound.
    pub below_resolution: bool,
    /// The supervisor missed the moment of the answer.
    pub disturbed: bool,
    /// What the plugin answered.
    pub answer: Answer,
}

/// Answers to questions that were released together.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// All of them, the null round trip of as many questions subtracted; the clock's resolution when below it, never 0.
    pub time_ns: f64,
    /// The supervisor missed the moment of the last answer.
    pub disturbed: bool,
    /// In the order of the questions.
    pub answers: Vec<Answer>,
}

/// An answer, with counters where they were asked for and the plugin has them.
type Counted = (Answer, Option<Counters>);

impl Session {
    pub(crate) fn new(policy: Policy, exchange: Exchange, build_ns: f64, clock: ClockFacts, pinned: Pinned) -> Self {
        let meter = Meter::of(exchange.jail.pid, policy.threads > 1);
        Self { policy, exchange, build_ns, clock, meter, ended: None, pinned, _thread: PhantomData }
    }

    /// Time to build the objects, nanoseconds, by the supervisor's clock.
    pub fn build_ns(&self) -> f64 {
        self.build_ns
    }

    /// How the clock behaved.
    pub fn clock(&self) -> &ClockFacts {
        &self.clock
    }

    /// The layers of the jail in force, one short phrase each.
    pub fn layers(&self) -> Vec<String> {
        self.exchange.jail.layers.phrases()
    }

    /// Process id of the runner, as this process sees it.
    pub fn pid(&self) -> i32 {
        self.exchange.jail.pid
    }

    /// Asks one question and times the answer. After an error the session has ended; [`Session::finish`] tells the rest.
    pub fn query(&mut self, query: Query, configuration: &Configuration) -> Result<Sample, Outcome> {
        self.put(query, Presented { configuration: *configuration, swapped: false })
    }

    /// As [`Session::query`], with the objects in either order.
    pub fn put(&mut self, query: Query, question: Presented) -> Result<Sample, Outcome> {
        let (timed, mut answers) = self.ask(query, &[question], false)?;
        let (time_ns, below_resolution) = self.clock.subtract(timed.raw_ns, 1);
        let disturbed = self.exchange.disturbed(&timed);
        let answer = answers.remove(0).0;
        Ok(Sample { raw_ns: timed.raw_ns, time_ns, below_resolution, disturbed, answer })
    }

    /// Releases up to [`MAX_BATCH`](crate::MAX_BATCH) questions together and times them as one. Lists of all contacts
    /// share one buffer, so they cannot be asked for in batches.
    pub fn batch(&mut self, query: Query, questions: &[Presented]) -> Result<Batch, Outcome> {
        let (timed, answers) = self.ask(query, questions, false)?;
        let (time_ns, _) = self.clock.subtract(timed.raw_ns, questions.len());
        let answers = answers.into_iter().map(|(answer, _)| answer).collect();
        Ok(Batch { time_ns, disturbed: self.exchange.disturbed(&timed), answers })
    }

    /// Asks one question untimed, with counters where the plugin has them.
    pub fn count(
        &mut self,
        query: Query,
        configuration: &Configuration,
    ) -> Result<(Answer, Option<Counters>), Outcome> {
        let question = Presented { configuration: *configuration, swapped: false };
        self.ask(query, &[question], true).map(|(_, mut answers)| answers.remove(0))
    }

    /// How long the calibration loop takes on the runner's CPU now: the shortest of three.
    pub(crate) fn calibrate(&mut self) -> Result<f64, Outcome> {
        let mut shortest = f64::INFINITY;
        for _ in 0..3 {
            let trip = self.guarded(|session| {
                session.exchange.ask_for(1);
                session.exchange.obeyed(Command::Calibrate, Phase::Query, session.policy.query_seconds)
            })?;
            shortest = shortest.min(trip.raw_ns);
        }
        Ok(shortest)
    }

    /// Asks nothing for so long, until the runner sleeps and then on; what it computes meanwhile is nobody's question.
    /// Nothing where the kernel does not count.
    pub(crate) fn idle(&mut self, time: Duration) -> Option<Usage> {
        std::thread::sleep(ASLEEP);
        let before = self.usage()?;
        std::thread::sleep(time);
        Some(self.usage()?.since(before))
    }

    /// What the runner has computed so far.
    pub(crate) fn usage(&self) -> Option<Usage> {
        self.meter.read()
    }

    fn ask(&mut self, query: Query, questions: &[Presented], counted: bool) -> Result<(Timed, Vec<Counted>), Outcome> {
        self.guarded(|session| {
            let (exchange, limit) = (&mut session.exchange, session.policy.query_seconds);
            exchange.wake(limit)?;
            exchange.place(questions);
            let timed = exchange.obeyed(Command::ask(query, counted), Phase::Query, limit)?;
            let contacts = if query == Query::CollisionAll { exchange.contacts() } else { Vec::new() };
            let read = |slot| {
                let answer = parse_answer(query, slot, &contacts)
                    .map_err(|rule| Outcome::ProtocolViolation { phase: Phase::Query, rule })?;
                Ok((answer, parse_counters(slot).filter(|_| counted)))
            };
            Ok((timed, exchange.slots().iter().map(read).collect::<Result<_, _>>()?))
        })
    }

    /// Nothing is asked of a session that has ended or shall end; the first error ends it.
    fn guarded<T>(&mut self, work: impl FnOnce(&mut Self) -> Result<T, Outcome>) -> Result<T, Outcome> {
        if let Some(outcome) = &self.ended {
            return Err(outcome.clone());
        }
        let result = if self.exchange.jail.killer.asked() { Err(Outcome::Cancelled) } else { work(self) };
        if let Err(outcome) = &result {
            self.ended = Some(outcome.clone());
        }
        result
    }

    /// A handle that ends this session from another thread.
    pub fn killer(&self) -> Killer {
        self.exchange.jail.killer.clone()
    }

    /// Ends the runner, reaps it and says how it went. It is killed, not asked: everything that counts has been read by
    /// then, and a plugin's destructors have no business with us.
    pub fn finish(self) -> Ending {
        let Session { exchange, ended, pinned, .. } = self;
        let ending = exchange.jail.end(ended.unwrap_or(Outcome::Completed));
        drop(pinned);
        ending
    }
}

/// Keeps the calling thread on one CPU until dropped.
pub(crate) struct Pinned(Option<Vec<usize>>);

impl Pinned {
    pub(crate) fn to(cpu: Option<usize>) -> Result<Self, Outcome> {
        let Some(cpu) = cpu else { return Ok(Pinned(None)) };
        match pin(&[cpu]) {
            Ok(before) => Ok(Pinned(Some(before))),
            Err(error) => Err(Outcome::fault("Cpu", format!("the supervisor cannot run on CPU {cpu}: {error}"))),
        }
    }
}

impl Drop for Pinned {
    fn drop(&mut self) {
        if let Some(before) = self.0.take() {
            // Where it may not run any more it stays where it is: no harm to anybody.
            let _ = pin(&before);
        }
    }
}
