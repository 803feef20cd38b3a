//! Asking the questions of an archive again.

use std::collections::BTreeMap;

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presentation;
use ocb_core::query::Query;
use ocb_core::validation::Precision;
use ocb_sandbox::{Ending, MAX_BATCH, Objects, Outcome, Policy, Session};

use crate::algorithm::{Algorithm, Runner};
use crate::columns::{AnswerRow, Flat};
use crate::measure;
use crate::model::{Difference, Recipe, Replayed};
use crate::pairing::Pairing;

/// What all algorithms of an archive were asked.
pub struct Questions<'a> {
    /// The archive's own word.
    pub recipe: &'a Recipe,
    /// Where the jail is started from.
    pub runner: &'a Runner,
    /// The objects.
    pub pairing: &'a Pairing,
    /// Poses of the configurations.
    pub poses: &'a [Configuration],
}

impl Questions<'_> {
    /// Puts every question of this algorithm again, in fresh processes as then; it got the objects in the numbers of this
    /// precision. Blocks, on a thread that outlives it.
    pub fn ask(&self, algorithm: &Algorithm, precision: Precision, rows: &[AnswerRow]) -> Replayed {
        let answers = rows.len() as u32;
        let mut replayed =
            Replayed { algorithm: algorithm.info.id.clone(), answers, equal: 0, first: None, trouble: None };
        let mut processes: BTreeMap<Option<u32>, Vec<&AnswerRow>> = BTreeMap::new();
        for row in rows {
            processes.entry(row.asked.process).or_default().push(row);
        }
        for (process, rows) in processes {
            if let Err(ending) = self.process(algorithm, precision, process, &rows, &mut replayed) {
                replayed.trouble = Some(ending.to_string());
                break;
            }
        }
        replayed
    }

    fn process(
        &self,
        algorithm: &Algorithm,
        precision: Precision,
        process: Option<u32>,
        rows: &[&AnswerRow],
        replayed: &mut Replayed,
    ) -> Result<(), Ending> {
        let Recipe { spec, seed, .. } = self.recipe;
        let sides = self.pairing.seen_in(precision);
        let (mesh_a, mesh_b) = (&*sides.mesh_a, (!self.pairing.same).then_some(&*sides.mesh_b));
        let shown = match process {
            None => Presentation::original(mesh_a, mesh_b),
            Some(process) => {
                let coherent = measure::is_coherent(&spec.method);
                measure::shown(mesh_a, mesh_b, self.poses.iter(), coherent, *seed, process)
            }
        };
        let trial = algorithm.trial(Objects::Pair(shown.first(), shown.second()), spec.semantics);
        let policy = Policy { threads: algorithm.threads, rough_clock: true, ..Policy::default() };
        let mut session = self.runner.launcher(algorithm, policy).start(&trial)?;
        let whole = self.compare(&mut session, &shown, rows, replayed);
        let ending = session.finish();
        if whole.is_err() { Err(ending) } else { Ok(()) }
    }

    fn compare(
        &self,
        session: &mut Session,
        shown: &Presentation,
        rows: &[&AnswerRow],
        replayed: &mut Replayed,
    ) -> Result<(), Outcome> {
        let query = self.recipe.spec.query;
        // Lists of contacts cannot be asked for together, nor can what was counted.
        let together = if query == Query::CollisionAll { 1 } else { MAX_BATCH };
        for rows in rows.chunks(together) {
            let pose = |row: &AnswerRow| &self.poses[row.configuration as usize];
            let present = |row: &&AnswerRow| shown.present(pose(row), row.configuration, row.asked.instance);
            let answers = match rows[0].asked.process {
                Some(_) => session.batch(query, &rows.iter().map(present).collect::<Vec<_>>())?.answers,
                None => {
                    rows.iter().map(|row| Ok(session.count(query, pose(row))?.0)).collect::<Result<_, Outcome>>()?
                }
            };
            for (row, answer) in rows.iter().zip(answers) {
                let answer = shown.translate(answer, row.configuration, row.asked.instance);
                note(replayed, row, &Flat::from(&answer));
            }
        }
        Ok(())
    }
}

/// Counts an answer, and keeps the first that differs.
fn note(replayed: &mut Replayed, row: &AnswerRow, answer: &Flat) {
    if row.answer.is_same(answer) {
        replayed.equal += 1;
    } else if replayed.first.as_ref().is_none_or(|first| row.configuration < first.configuration) {
        let (recorded, replayed_as) = (row.answer.to_string(), answer.to_string());
        replayed.first = Some(Difference { configuration: row.configuration, recorded, replayed: replayed_as });
    }
}
