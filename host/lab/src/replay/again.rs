//! Asking the questions of an archive again.

use std::collections::BTreeMap;

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presentation;
use ocb_core::mesh::Mesh;
use ocb_core::query::Query;
use ocb_sandbox::{Ending, MAX_BATCH, Outcome, Policy, Session};

use crate::columns::{AnswerRow, Flat};
use crate::contestant::{Contestant, Runner};
use crate::measure;
use crate::model::{Difference, Recipe, Replayed};

/// What all algorithms of an archive were asked.
pub struct Questions<'a> {
    /// The archive's own word.
    pub recipe: &'a Recipe,
    /// Where the jail is started from.
    pub runner: &'a Runner,
    /// Object A.
    pub mesh_a: &'a Mesh,
    /// Object B; absent when both are one.
    pub mesh_b: Option<&'a Mesh>,
    /// Poses of the configurations.
    pub poses: &'a [Configuration],
}

impl Questions<'_> {
    /// Puts every question of this algorithm again, in fresh processes as then. Blocks, on a thread that outlives it.
    pub fn ask(&self, contestant: &Contestant, rows: &[AnswerRow]) -> Replayed {
        let algorithm = contestant.info.id.clone();
        let answers = rows.len() as u32;
        let mut replayed = Replayed { algorithm, answers, equal: 0, first: None, trouble: None };
        let mut processes: BTreeMap<Option<u32>, Vec<&AnswerRow>> = BTreeMap::new();
        for row in rows {
            processes.entry(row.asked.process).or_default().push(row);
        }
        for (process, rows) in processes {
            if let Err(ending) = self.process(contestant, process, &rows, &mut replayed) {
                replayed.trouble = Some(ending.to_string());
                break;
            }
        }
        replayed
    }

    fn process(
        &self,
        contestant: &Contestant,
        process: Option<u32>,
        rows: &[&AnswerRow],
        replayed: &mut Replayed,
    ) -> Result<(), Ending> {
        let Recipe { spec, seed, .. } = self.recipe;
        let shown = match process {
            None => Presentation::original(self.mesh_a, self.mesh_b),
            Some(process) => {
                let coherent = measure::is_coherent(&spec.method);
                measure::shown(self.mesh_a, self.mesh_b, self.poses.iter(), coherent, *seed, process)
            }
        };
        let trial = contestant.trial(shown.first(), shown.second(), spec.semantics);
        let policy = Policy { threads: contestant.threads, rough_clock: true, ..Policy::default() };
        let mut session = self.runner.launcher(contestant, policy).start(&trial)?;
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
