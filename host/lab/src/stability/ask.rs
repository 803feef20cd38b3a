//! Questions to one algorithm: a process per pair of objects, and a new one when it dies.

use std::time::Duration;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::validation::Precision;
use ocb_sandbox::{Ending, Launcher, Objects, Outcome};

use crate::algorithm::Algorithm;
use crate::measure::Stop;
use crate::{LabError, Result};

/// A process that dies is replaced so often; what is left then was not answered.
const REPLACED: u32 = 3;

/// What came of one question.
#[derive(Clone, Debug)]
pub enum Got {
    /// An answer, after so many nanoseconds.
    Answer(Answer, f64),
    /// The plugin declined: it cannot take such objects or such a question.
    Declined(String),
    /// The process ended, or had to be ended.
    Broken(String),
    /// It took longer than allowed.
    Hung(String),
}

/// What the end of a process is for its question.
fn came(outcome: &Outcome) -> Got {
    match outcome {
        Outcome::Failed { reason, .. } => Got::Declined(reason.clone()),
        Outcome::TimedOut { .. } => Got::Hung(outcome.to_string()),
        outcome => Got::Broken(outcome.to_string()),
    }
}

/// One algorithm that is asked.
pub struct Asker<'a> {
    launcher: &'a Launcher,
    pub algorithm: &'a Algorithm,
    pub precision: Precision,
    pub stop: &'a Stop,
}

impl<'a> Asker<'a> {
    pub fn new(launcher: &'a Launcher, algorithm: &'a Algorithm, precision: Precision, stop: &'a Stop) -> Self {
        Self { launcher, algorithm, precision, stop }
    }

    /// It offers this question.
    pub fn offers(&self, query: Query, semantics: Semantics) -> bool {
        let info = &self.algorithm.info;
        info.queries.contains(&query) && (semantics == Semantics::Surface || info.solid)
    }

    /// Asks in this order; everything is answered, by whatever.
    pub fn ask(
        &mut self,
        a: &Mesh,
        b: &Mesh,
        semantics: Semantics,
        questions: &[(Query, Configuration)],
    ) -> Result<Vec<Got>> {
        let mut all: Vec<Got> = Vec::with_capacity(questions.len());
        let mut deaths = 0;
        while all.len() < questions.len() {
            if self.stop.asked() {
                return Err(LabError::Stopped);
            }
            let ending = match self.process(a, b, semantics, &questions[all.len()..], &mut all) {
                Ok(()) => continue,
                Err(ending) => ending,
            };
            if ending.outcome.ours() {
                return Err(LabError::Fault(ending.to_string()));
            }
            let got = came(&ending.outcome);
            deaths += 1;
            // One that cannot even build its structure will not the next time.
            let rest = if deaths > REPLACED || all.is_empty() { questions.len() - all.len() } else { 1 };
            all.extend(std::iter::repeat_n(got, rest));
        }
        Ok(all)
    }

    /// One process, as far as it goes.
    fn process(
        &self,
        a: &Mesh,
        b: &Mesh,
        semantics: Semantics,
        questions: &[(Query, Configuration)],
        all: &mut Vec<Got>,
    ) -> std::result::Result<(), Ending> {
        let trial = self.algorithm.trial(Objects::Pair(a, Some(b)), semantics);
        let mut session = self.launcher.start(&trial)?;
        for (query, configuration) in questions {
            if self.stop.asked() {
                break;
            }
            match session.query(*query, configuration) {
                Ok(sample) => all.push(Got::Answer(sample.answer, sample.time_ns)),
                Err(_) => return Err(session.finish()),
            }
        }
        session.finish();
        Ok(())
    }

    /// One process that is asked as the answers come; after its end every answer is that end.
    pub fn converse(
        &mut self,
        a: &Mesh,
        b: &Mesh,
        talk: impl FnOnce(&mut dyn FnMut(Query, &Configuration) -> Got),
    ) -> Result<()> {
        let trial = self.algorithm.trial(Objects::Pair(a, Some(b)), Semantics::Surface);
        let mut session = match self.launcher.start(&trial) {
            Ok(session) => session,
            Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
            Err(ending) => {
                talk(&mut |_, _| came(&ending.outcome));
                return Ok(());
            }
        };
        talk(&mut |query, configuration| match session.query(query, configuration) {
            Ok(sample) => Got::Answer(sample.answer, sample.time_ns),
            Err(outcome) => came(&outcome),
        });
        session.finish();
        if self.stop.asked() { Err(LabError::Stopped) } else { Ok(()) }
    }

    /// The shortest time of some askings of one question, each in a new process; `None` when it does not answer.
    pub fn shortest(
        &mut self,
        a: &Mesh,
        b: &Mesh,
        question: (Query, Configuration),
        times: u32,
    ) -> Result<Option<Duration>> {
        let mut shortest = f64::INFINITY;
        for _ in 0..times {
            match self.ask(a, b, Semantics::Surface, &[question, question])?.pop() {
                Some(Got::Answer(_, ns)) => shortest = shortest.min(ns),
                _ => return Ok(None),
            }
        }
        Ok(Some(Duration::from_nanos(shortest as u64)))
    }
}
