//! Reference validation: hundreds of thousands of answers compared with the certified truth.
//!
//! Every scene is asked in fresh processes, each of which sees another equivalent instance: vertices and triangles
//! renumbered, everything scaled and turned, the objects swapped. One small scene is asked so often in one process that a
//! wrong answer in a hundred thousand is found. What is asked follows from the plugin's file alone, so that the report is the
//! same wherever it is made. An author cannot fit a plugin to the instances, because every change of the file draws others.

use std::path::Path;
use std::time::{Duration, Instant};

use ocb_core::instance::{Instance, Presentation, Presented};
use ocb_core::oracle::Pair;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Launcher, MAX_BATCH, Outcome, Session, Trial};

use super::conduct::PARTS as CONDUCT;
use super::repro::{Question, reduced};
use super::suite::{Scene, suite};
use super::term::share;
use super::{Checking, query_name};
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckLine, CheckVerdict, Repro};
use crate::{LabError, Result};

/// Processes per scene.
const PROCESSES: u32 = 2;
/// Questions to the small pair: enough to meet one wrong answer in a hundred thousand with a probability of 98 in 100.
const MANY: usize = 400_000;
/// A slow algorithm is asked for so long on each scene at most; the report says how far it came.
const LONGEST: Duration = Duration::from_secs(20);
/// Questions that are released together have one limit, so a slow algorithm is asked for no more of them than it answers in
/// this time.
const BATCH: Duration = Duration::from_millis(200);

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
        until: Instant,
    ) -> Result<()> {
        let suite = suite()?;
        let mut left = algorithm.queries.len() * (1 + suite.scenes.len()) + CONDUCT;
        for query in algorithm.queries.clone() {
            let check = format!("{}: {}, many times", algorithm.id, query_name(query));
            let small = (&suite.small, MANY / PROCESSES as usize, check);
            let scenes = suite.scenes.iter().map(|scene| {
                (scene, scene.placed.len(), format!("{}: {} on {}", algorithm.id, query_name(query), scene.name))
            });
            for (scene, questions, check) in std::iter::once(small).chain(scenes) {
                // One wrong answer is enough to look for.
                if self.has_failed() || self.is_stopped() {
                    return Ok(());
                }
                let until = share(until, left).min(Instant::now() + LONGEST);
                left -= 1;
                self.scene(launcher, file, algorithm, query, scene, questions, until, check)?;
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
        until: Instant,
        check: String,
    ) -> Result<()> {
        let mut asked = Asked::default();
        for process in 0..PROCESSES {
            if self.is_stopped() || asked.first.is_some() || asked.ending.is_some() {
                break;
            }
            // Half of the time for each process, so that a slow algorithm shows both instances.
            let until = share(until, (PROCESSES - process) as usize);
            let seed = seed_of(&algorithm.plugin_sha256) ^ u64::from(process);
            let shown = Presentation::drawn(
                &scene.mesh_a,
                scene.mesh_b.as_deref(),
                scene.placed.iter().map(|placed| &placed.configuration),
                algorithm.coherent,
                seed,
                process,
            );
            let trial = Trial::new(file, &algorithm.id, shown.first(), shown.second());
            let mut session = match launcher.start_with(&trial, &self.term.killer(until)) {
                Ok(session) => session,
                Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
                Err(ending) if ending.outcome == Outcome::Cancelled => continue,
                Err(ending) => {
                    asked.ending = Some((ending.outcome, ending.stderr));
                    break;
                }
            };
            ask(&mut session, &shown, scene, algorithm, query, questions, until, &mut asked);
            let ending = session.finish();
            if ending.outcome.ours() {
                return Err(LabError::Fault(ending.to_string()));
            }
            if !matches!(ending.outcome, Outcome::Completed | Outcome::Cancelled) {
                asked.ending = Some((ending.outcome, ending.stderr));
            }
        }
        self.said(launcher, file, algorithm, query, asked, until, check)
    }

    #[expect(clippy::too_many_arguments, reason = "who was asked what, what came of it, and until when")]
    fn said(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        query: Query,
        asked: Asked,
        until: Instant,
        check: String,
    ) -> Result<()> {
        let Asked { answers, silent, wrong, first, ending } = asked;
        if self.is_stopped() {
            return Ok(());
        }
        if let Some((question, verdict)) = first {
            let repro = reduced(self.term, until, launcher, file, algorithm, query, question, verdict)?;
            let size = match &repro {
                None => "The time limit was reached before a small repro was found.".to_owned(),
                Some(Repro { alone: true, triangles: [a, b], .. }) => {
                    format!("It still fails with {a} and {b} triangles.")
                }
                Some(_) => {
                    "Alone in a fresh process, the query is answered correctly: answers depend on earlier queries."
                        .to_owned()
                }
            };
            let name = verdict.name().replace('_', " ");
            let evidence = format!("{wrong} of {answers} answers are wrong; the first is a {name}. {size}");
            let hint = "Repeat the query from the repro: ocb plugin check FILE.so --repro REPRO.json";
            let (hint, repro) = (repro.is_some().then(|| hint.to_owned()), repro.map(Box::new));
            self.add(CheckLine { check, verdict: CheckVerdict::Fail, evidence, hint, repro });
        } else if let Some((outcome, stderr)) = ending {
            self.failed(check, &outcome, &stderr);
        } else if answers == 0 {
            self.not_reached(check, CheckVerdict::Fail, "no query was");
        } else if silent > 0 {
            let evidence = format!("No answer to {silent} of {answers} queries; the others are correct.");
            self.line(
                check,
                CheckVerdict::Note,
                evidence,
                Some("An algorithm should answer every query that it offers."),
            );
        } else {
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
    until: Instant,
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
    let (mut next, mut most) = (0, 1);
    while next < questions && asked.first.is_none() && Instant::now() < until {
        let size = most.min(questions - next);
        let begun = Instant::now();
        let batch: Vec<Presented> = (next..next + size).map(present).collect();
        let answers: Vec<Answer> = match session.batch(query, &batch) {
            Ok(batch) => batch.answers,
            Err(_) => break,
        };
        let took = begun.elapsed();
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
        // Lists of contacts cannot be asked for together.
        if query != Query::CollisionAll {
            let each = took.as_secs_f64().max(1e-9) / size as f64;
            most = ((BATCH.as_secs_f64() / each) as usize).clamp(1, MAX_BATCH);
        }
    }
}
