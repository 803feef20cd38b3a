//! A recording asked as a scene: one process loads every object once and is asked all queries in the order of the recording.
//!
//! Only algorithms that offer `ocb.scene/1` are asked so. What they answer is kept until the truth about each pair of objects has
//! been certified, so that the truth about all queries is never in memory at once.
//!
//! Each process sees an equivalent instance of the whole scene: every object renumbered, and all of it turned alike.

mod answers;
mod asking;

use std::sync::Arc;
use std::time::{Duration, Instant};

use ocb_core::instance::{Instance, OTHER_UNITS, Presentation};
use ocb_core::mesh::Mesh;
use ocb_core::query::Semantics;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Killer, Outcome, PassPlan, Question};
use rayon::prelude::*;

use super::tally::{Answered, Tally};
use super::{Certified, LEAST, PairPart, Progress, Solid, Wanted};
use crate::Result;
use crate::algorithm::Runner;
use crate::machine::Machine;
use crate::measure::{self, STEAL, Stop};
use answers::{Answers, Round};
use asking::{Asking, Objects};

/// Who is asked, and what.
pub struct Scene<'a> {
    parts: &'a [PairPart],
    wanted: &'a Wanted<'a>,
    runner: &'a Runner,
    machine: &'a Machine,
    stop: &'a Stop,
    /// The place of the algorithm among those that are wanted, and what it did.
    asked: Vec<(usize, Asking, Answers)>,
}

impl<'a> Scene<'a> {
    /// Asks all algorithms that offer scenes, in turns. The caller has the right to measure on this machine.
    ///
    /// # Errors
    /// `Stopped` when it was stopped.
    pub fn measure(
        parts: &'a [PairPart],
        solids: &[Solid],
        wanted: &'a Wanted<'a>,
        runner: &'a Runner,
        machine: &'a Machine,
        stop: &'a Stop,
        tell: &dyn Fn(Progress),
    ) -> Result<Self> {
        let objects = Objects::new(solids);
        let offers = |i: &usize| wanted.algorithms[*i].info.scene;
        let asked = (0..wanted.algorithms.len()).filter(offers).map(|i| {
            let asking = Asking::of(&wanted.algorithms[i], parts, &objects);
            let answers = Answers::new(asking.order.len());
            (i, asking, answers)
        });
        let mut scene = Self { asked: asked.collect(), parts, wanted, runner, machine, stop };
        scene.rounds(tell)?;
        Ok(scene)
    }

    fn rounds(&mut self, tell: &dyn Fn(Progress)) -> Result<()> {
        let _quiet = self.machine.keep_off();
        let mut asked = std::mem::take(&mut self.asked);
        let mut steady = true;
        for round in 0..self.wanted.passes {
            for (_, asking, answers) in &mut asked {
                if answers.outcome.is_some() || answers.reach == 0 {
                    continue;
                }
                let (process, of) = (round + 1, self.wanted.passes);
                tell(Progress::Scene { algorithm: asking.algorithm.info.id.clone(), process, of });
                let spent = answers.spent;
                let (first, steal) = (round == 0, self.pass(asking, answers, round));
                // As in any other run: `measure.rs`.
                if steal > STEAL && steady && !(first && answers.cut) && !self.stop.asked() && answers.outcome.is_none()
                {
                    answers.rounds.pop();
                    answers.spent = spent;
                    steady = self.pass(asking, answers, round) <= STEAL;
                }
                if self.stop.asked() {
                    return Err(crate::LabError::Stopped);
                }
            }
        }
        for (_, _, answers) in &mut asked {
            answers.conclude();
        }
        self.asked = asked;
        Ok(())
    }

    /// One process: the share of the time that was taken from its CPU.
    fn pass(&self, asking: &Asking, answers: &mut Answers, round: u32) -> f64 {
        let killer = Killer::default();
        self.stop.watch(Some(killer.clone()));
        let budget = self.wanted.budget.max(LEAST);
        let seed = measure::process_seed(self.wanted.seed, OTHER_UNITS.len() as u32 + round);
        let shown = Presentation::of_scene(asking.meshes.iter().map(Arc::as_ref), seed);
        let meshes: Vec<&Mesh> = shown.meshes().iter().collect();
        let algorithm = &asking.algorithm;
        let policy = measure::allowed(self.machine, algorithm.threads, measure::limits(budget));
        let trial = algorithm.trial(ocb_sandbox::Objects::Scene(&meshes), Semantics::Surface);
        let mut session = match self.runner.launcher(algorithm, policy).start_with(&trial, &killer) {
            Ok(session) => session,
            Err(ending) => {
                answers.end(&ending.outcome);
                return 0.0;
            }
        };
        let order: Vec<u32> = (0..answers.reach as u32).collect();
        let plan = PassPlan {
            order: &order,
            coherent: true,
            seed: seed.rotate_left(1),
            allowance: self.allowance(answers, round, budget),
        };
        let present = |number: u32, instance: Instance| {
            let (part, configuration, [a, b]) = asking.question(self.parts, number);
            let presented = shown.present(configuration, number, instance);
            let objects = if presented.swapped { [b, a] } else { [a, b] };
            Question { query: part.query, objects, configuration: presented.configuration }
        };
        answers.rounds.push(Round::new(session.set_up(), order.len()));
        let begun = Instant::now();
        let (facts, _) = session.pass(&plan, &present, &mut |mut seen| {
            let objects = asking.question(self.parts, seen.configuration).2.map(|number| number as usize);
            seen.answer = shown.translate_of(objects, seen.answer, seen.configuration, seen.instance);
            answers.observe(seen, self.stop)
        });
        answers.spent += begun.elapsed();
        self.stop.watch(None);
        if round == 0 {
            answers.cut = facts.reached < answers.reach;
            answers.reach = facts.reached;
        }
        let steal = facts.steal.unwrap_or(0.0);
        answers.end_pass(facts);
        let ending = session.finish();
        if ending.outcome != Outcome::Completed {
            answers.end(&ending.outcome);
        }
        steal
    }

    /// The first process finds out how far the algorithm comes; later ones may use what it left.
    fn allowance(&self, answers: &Answers, round: u32, budget: Duration) -> Duration {
        let left = budget.saturating_sub(answers.spent);
        if round == 0 { left / self.wanted.passes } else { left.max(budget / self.wanted.passes) }
    }

    /// The places of those that were asked among the algorithms that are wanted.
    pub fn algorithms(&self) -> impl Iterator<Item = usize> {
        self.asked.iter().map(|(i, ..)| *i)
    }

    /// Judges what was answered about the pair of a part; the tallies are in the order of [`Scene::algorithms`].
    pub fn judge(&self, part: usize, certified: &Certified, recording: &super::Recording, tallies: &mut [Tally]) {
        let PairPart { objects, query, .. } = self.parts[part];
        for ((_, asking, answers), tally) in self.asked.iter().zip(tallies) {
            if !asking.algorithm.info.queries.contains(&query) {
                continue;
            }
            tally.is_asked(&certified.rows, &recording.queries);
            let precision = measure::precision(&asking.algorithm.info);
            let (terms, pair) = (
                Terms { query, semantics: Semantics::Surface, precision },
                certified.pairing.seen_in(precision).pair(),
            );
            let judged = |i: usize| {
                let row = certified.rows[i];
                let number = asking.number(row)?;
                let time_ns = answers.time_ns(number)?;
                let placed = certified.set.placed[i].seen_in(precision);
                let verdicts = answers.of(number).map(|answer| judge(&pair, &placed, terms, answer).verdict);
                let verdict = verdicts.max_by_key(|verdict| verdict.gravity())?;
                let times = answers.official(number);
                Some(Answered { row, time_ns, times, verdict, hit: certified.set.placed[i].truth.hit })
            };
            let all: Vec<Answered> = (0..certified.rows.len()).into_par_iter().filter_map(judged).collect();
            tally.add(objects, &all);
        }
    }

    /// What building took, and how a process ended; in the same order.
    pub fn conclude(self, tallies: &mut [Tally]) {
        for ((_, _, answers), tally) in self.asked.into_iter().zip(tallies) {
            tally.built(answers.rounds.iter().map(|round| round.set_up.build_ns).collect());
            if let Some(outcome) = answers.outcome {
                tally.ended(None, outcome);
            }
        }
    }
}
