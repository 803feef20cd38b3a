//! One jailed runner, as its supervisor uses it: ask, time, end.

use std::marker::PhantomData;

use ocb_core::configuration::Configuration;
use ocb_core::query::{Answer, Counters, Query};

use crate::clock::ClockFacts;
use crate::confine::pin;
use crate::exchange::{Exchange, Timed};
use crate::launch::Killer;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Command, parse_answer, parse_counters};

/// A disturbed question is asked again at most so often.
const REPEATS: u32 = 3;

/// One running jail with a loaded plugin and built objects. Dropping it kills the jail.
pub struct Session {
    policy: Policy,
    exchange: Exchange,
    build_ns: f64,
    clock: ClockFacts,
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
    /// How often the question was repeated because the supervisor missed the moment of the answer.
    pub disturbed: u32,
    /// What the plugin answered.
    pub answer: Answer,
}

impl Session {
    pub(crate) fn new(policy: Policy, exchange: Exchange, build_ns: f64, clock: ClockFacts, pinned: Pinned) -> Self {
        Self { policy, exchange, build_ns, clock, ended: None, pinned, _thread: PhantomData }
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
        let mut disturbed = 0;
        loop {
            let (timed, answer, _) = self.ask(query, configuration, false)?;
            if self.exchange.disturbed(&timed) && disturbed < REPEATS {
                disturbed += 1;
                continue;
            }
            let (time_ns, below_resolution) = self.clock.subtract(timed.raw_ns);
            return Ok(Sample { raw_ns: timed.raw_ns, time_ns, below_resolution, disturbed, answer });
        }
    }

    /// Asks one question untimed, with counters where the plugin has them.
    pub fn count(
        &mut self,
        query: Query,
        configuration: &Configuration,
    ) -> Result<(Answer, Option<Counters>), Outcome> {
        self.ask(query, configuration, true).map(|(_, answer, counters)| (answer, counters))
    }

    fn ask(
        &mut self,
        query: Query,
        configuration: &Configuration,
        counted: bool,
    ) -> Result<(Timed, Answer, Option<Counters>), Outcome> {
        if let Some(outcome) = &self.ended {
            return Err(outcome.clone());
        }
        let mut ask = || -> Result<_, Outcome> {
            if self.exchange.jail.killer.asked() {
                return Err(Outcome::Cancelled);
            }
            self.exchange.place(configuration);
            let command = Command::ask(query, counted);
            self.exchange.wake(self.policy.query_seconds)?;
            let timed = self.exchange.obeyed(command, Phase::Query, self.policy.query_seconds)?;
            let contacts = if query == Query::CollisionAll { self.exchange.contacts() } else { Vec::new() };
            let slot = self.exchange.slot();
            let answer = parse_answer(query, slot, &contacts)
                .map_err(|rule| Outcome::ProtocolViolation { phase: Phase::Query, rule })?;
            Ok((timed, answer, parse_counters(slot).filter(|_| counted)))
        };
        let result = ask();
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
