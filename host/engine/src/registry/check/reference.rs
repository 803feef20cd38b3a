//! Reference validation: hundreds of thousands of answers compared with the certified truth.
//!
//! Every scene is asked in fresh processes, each of which sees another equivalent instance: vertices and triangles
//! renumbered, everything scaled and turned, the objects swapped. One small scene is asked so often in one process that a
//! wrong answer in a hundred thousand is found. What is asked follows from the plugin's file alone, so that the report is the
//! same wherever it is made.

use std::path::Path;
use std::time::{Duration, Instant};

use ocb_core::instance::{Instance, Presentation, Presented};
use ocb_core::oracle::Pair;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Launcher, MAX_BATCH, Outcome, Session, Trial};

use super::repro::{Question, reduced};
use super::suite::{Scene, suite};
use super::{Checking, hint_for, query_name, with_output};
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckLine, CheckVerdict};
use crate::{EngineError, Result};

/// Processes per scene.
const PROCESSES: u32 = 2;
/// Questions to the small pair: enough to meet one wrong answer in a hundred thousand with a probability of 98 in 100.
const MANY: usize = 400_000;
/// A slow algorithm is asked for so long on each scene; the report says how far it came.
const LONGEST: Duration = Duration::from_secs(20);

/// What asking one scene has shown.
#[derive(Default)]
struct Asked {
    answers: usize,
    silent: usize,
    wrong: usize,
    first: Option<(Question, Verdict)>,
    /// How the runner ended when it did not do all that was asked, with what it wrote.
    ending: Option<(Outcome, String)>,
}

impl Checking<'_> {
    /// All scenes, for each question that the algorithm answers.
    pub(super) fn against_the_reference(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
    ) -> Result<()> {
        let suite = suite()?;
        for query in algorithm.queries.clone() {
            let check = format!("{}: {}, many times", algorithm.id, query_name(query));
            let small = (&suite.small, MANY / PROCESSES as usize, check);
            let scenes = suite.scenes.iter().map(|scene| {
                (scene, scene.placed.len(), format!("{}: {} on {}", algorithm.id, query_name(query), scene.name))
            });
            for (scene, questions, check) in std::iter::once(small).chain(scenes) {
                // One wrong answer is enough to look for.
                if self.has_failed() {
                    break;
                }
                self.scene(launcher, file, algorithm, query, scene, questions, check)?;
            }
        }
        Ok(())
    }

    #[expect(clippy::too_many_arguments, reason = "who is asked what, where, how often and under which name")]
    fn scene(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        query: Query,
        scene: &Scene,
        questions: usize,
        check: String,
    ) -> Result<()> {
        let begun = Instant::now();
        let mut asked = Asked::default();
        for process in 0..PROCESSES {
            if self.stopped || asked.first.is_some() || asked.ending.is_some() {
                break;
            }
            let seed = seed_of(&algorithm.plugin_sha256) ^ u64::from(process);
            let shown = Presentation::drawn(
                &scene.mesh_a,
                scene.mesh_b.as_deref(),
                scene.placed.iter().map(|placed| &placed.configuration),
                algorithm.coherent,
                seed,
                process,
            );
            let trial = Trial {
                plugin: file,
                algorithm: &algorithm.id,
                mesh_a: shown.first(),
                mesh_b: shown.second(),
                parameters: &[],
                semantics: Semantics::Surface,
            };
            let mut session = match launcher.start(&trial) {
                Ok(session) => session,
                Err(ending) if ending.outcome.ours() => return Err(EngineError::Fault(ending.to_string())),
                Err(ending) => {
                    asked.ending = Some((ending.outcome, ending.stderr));
                    break;
                }
            };
            let going = || begun.elapsed() < LONGEST;
            ask(&mut session, &shown, scene, algorithm, query, questions, &going, &mut asked);
            let ending = session.finish();
            if ending.outcome.ours() {
                return Err(EngineError::Fault(ending.to_string()));
            }
            if ending.outcome != Outcome::Completed {
                asked.ending = Some((ending.outcome, ending.stderr));
            }
        }
        self.said(launcher, file, algorithm, query, asked, check)
    }

    fn said(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        query: Query,
        asked: Asked,
        check: String,
    ) -> Result<()> {
        let Asked { answers, silent, wrong, first, ending } = asked;
        if let Some((question, verdict)) = first {
            let repro = reduced(launcher, file, algorithm, query, question, verdict)?;
            let [a, b] = repro.triangles;
            let size = if repro.alone {
                format!("It fails still with {a} and {b} triangles.")
            } else {
                "Asked alone in a fresh process it is answered rightly: answers depend on what was asked before.".into()
            };
            let name = verdict.name().replace('_', " ");
            let evidence = format!("{wrong} of {answers} answers are wrong, the first is a {name}. {size}");
            let hint = "Take the repro and ask it again: ocb plugin check FILE.so --repro REPRO.json";
            let (hint, repro) = (Some(hint.to_owned()), Some(Box::new(repro)));
            self.add(CheckLine { check, verdict: CheckVerdict::Fail, evidence, hint, repro });
        } else if let Some((outcome, stderr)) = ending {
            let hint = hint_for(&outcome);
            self.line(check, CheckVerdict::Fail, with_output(&outcome.to_string(), &stderr), hint);
        } else if silent > 0 {
            let evidence = format!("No answer to {silent} of {answers} questions, the others are right.");
            self.line(
                check,
                CheckVerdict::Note,
                evidence,
                Some("An algorithm that offers a question should answer it."),
            );
        } else if !self.stopped {
            self.line(check, CheckVerdict::Pass, format!("All {answers} answers agree with the reference."), None);
        }
        Ok(())
    }
}

/// The seed that a plugin's file gives.
fn seed_of(sha256: &str) -> u64 {
    u64::from_str_radix(sha256.get(..16).unwrap_or("0"), 16).unwrap_or(0)
}

/// Asks so many questions of one process, or until something is wrong: every configuration as one instance, then all of
/// them as another.
#[expect(clippy::too_many_arguments, reason = "one loop with all that it looks at")]
fn ask(
    session: &mut Session,
    shown: &Presentation,
    scene: &Scene,
    algorithm: &AlgorithmInfo,
    query: Query,
    questions: usize,
    going: &dyn Fn() -> bool,
    asked: &mut Asked,
) {
    let pair = Pair::new(&scene.a, &scene.b);
    let terms = Terms { query, semantics: Semantics::Surface, precision: precision(algorithm) };
    let n = scene.placed.len();
    let which = |i: usize| ((i % n) as u32, Instance { number: (i / n) as u32, aside: true });
    let present = |i: usize| {
        let (number, instance) = which(i);
        shown.present(&scene.placed[number as usize].configuration, number, instance)
    };
    let mut next = 0;
    while next < questions && asked.first.is_none() && going() {
        // Lists of contacts cannot be asked for together.
        let size = if query == Query::CollisionAll { 1 } else { MAX_BATCH.min(questions - next) };
        let batch: Vec<Presented> = (next..next + size).map(present).collect();
        let answers: Vec<Answer> = match session.batch(query, &batch) {
            Ok(batch) => batch.answers,
            Err(_) => break,
        };
        for (i, answer) in (next..).zip(answers) {
            let (number, instance) = which(i);
            let placed = &scene.placed[number as usize];
            asked.answers += 1;
            let verdict = judge(&pair, placed, terms, &shown.translate(answer.clone(), number, instance)).verdict;
            asked.silent += usize::from(verdict.is_silent());
            if verdict.is_wrong() {
                asked.wrong += 1;
                asked.first.get_or_insert_with(|| (Question::of(shown, batch[i - next], answer), verdict));
            }
        }
        next += size;
    }
}
