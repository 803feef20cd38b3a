//! The smallest question that is still answered wrongly, for its author to take home.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ocb_core::configuration::{Configuration, Truth};
use ocb_core::instance::{Presentation, Presented};
use ocb_core::mesh::obj;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Killer, Launcher, Outcome, Trial};
use ocb_stability::Posed;
use ocb_stability::minimise::minimise;

use super::smoke::certified;
use super::term::Term;
use super::{Checking, query_name};
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckVerdict, Repro};
use crate::repro::{answered, expected};
use crate::{LabError, Result};

/// Processes started at most to find fewer triangles.
const TRIES: u32 = 150;
/// Time for that at most; an algorithm that is slow to build is left with a larger repro.
const LONGEST: Duration = Duration::from_secs(20);
/// And at least, though its own share of the check is over: a wrong answer without its question helps no author.
const LEAST: Duration = Duration::from_secs(2);

/// A question as the plugin saw it, and what it said.
pub struct Question {
    posed: Posed,
    answer: Answer,
}

impl Question {
    /// In the numbers of the process that asked it.
    pub fn of(shown: &Presentation, asked: Presented, answer: Answer) -> Self {
        let (first, second) = (shown.first(), shown.second().unwrap_or(shown.first()));
        let (a, b) = if asked.swapped { (second, first) } else { (first, second) };
        let (a, b) = (Arc::new(a.clone()), Arc::new(b.clone()));
        Self { posed: Posed { a, b, configuration: asked.configuration }, answer }
    }
}

/// Asks with ever fewer triangles as long as the answer stays wrong and there is time; `None` when there was none even to
/// ask once.
#[expect(clippy::too_many_arguments, reason = "who is asked what, and until when")]
pub fn reduced(
    term: &Term<'_>,
    until: Instant,
    launcher: &Launcher,
    file: &Path,
    algorithm: &AlgorithmInfo,
    query: Query,
    question: Question,
    verdict: Verdict,
) -> Result<Option<Repro>> {
    let until = until.max(Instant::now() + LEAST).min(Instant::now() + LONGEST);
    let over = || term.is_stopped() || Instant::now() >= until.min(term.ends());
    let Question { posed: whole, answer } = question;
    let mut last = None;
    let small = minimise(&whole, TRIES, |posed| {
        if over() {
            return Ok(false);
        }
        let asked = ask_once(launcher, &term.killer(until), file, algorithm, query, posed)?;
        let wrong = asked.filter(|asked| asked.verdict.is_wrong());
        let fails = wrong.is_some();
        last = wrong.or(last.take());
        Ok(fails)
    })?;
    if small.is_none() && over() {
        return Ok(None);
    }
    let alone = small.is_some();
    let Posed { a, b, configuration } = small.unwrap_or(whole);
    let asked = last.unwrap_or_else(|| {
        let [shape_a, shape_b] = [&a, &b].map(|mesh| Shape::new(mesh.clone()));
        Asked { answer, verdict, truth: Pair::new(&shape_a, &shape_b).truth(&configuration) }
    });
    Ok(Some(Repro {
        algorithm: algorithm.id.clone(),
        query,
        object_a: obj::write(&a),
        object_b: obj::write(&b),
        pose_a: configuration.pose_a.to_row_major(),
        pose_b: configuration.pose_b.to_row_major(),
        triangles: [&a, &b].map(|mesh| mesh.triangles().len() as u32),
        expected: expected(&asked.truth),
        got: answered(&asked.answer),
        verdict: asked.verdict,
        alone,
    }))
}

/// One answer with its truth.
struct Asked {
    answer: Answer,
    verdict: Verdict,
    truth: Truth,
}

/// Asks a fresh process one question; `None` when it was ended before it answered.
fn ask_once(
    launcher: &Launcher,
    killer: &Killer,
    file: &Path,
    algorithm: &AlgorithmInfo,
    query: Query,
    posed: &Posed,
) -> Result<Option<Asked>> {
    let trial = Trial::new(file, &algorithm.id, &posed.a, Some(&posed.b));
    let fault = |outcome: &Outcome| LabError::Fault(outcome.to_string());
    let [shape_a, shape_b] = [&posed.a, &posed.b].map(|mesh| Shape::new(mesh.clone()));
    let pair = Pair::new(&shape_a, &shape_b);
    let placed = certified(&pair, posed.configuration);
    let truth = placed.truth;
    // A plugin that dies of this question answers nothing, and it is another failure than the one that is looked for.
    let nothing = Asked { answer: Answer::GaveUp, verdict: Verdict::GaveUp, truth };
    let mut session = match launcher.start_with(&trial, killer) {
        Ok(session) => session,
        Err(ending) if ending.outcome.ours() => return Err(fault(&ending.outcome)),
        Err(ending) if ending.outcome == Outcome::Cancelled => return Ok(None),
        Err(_) => return Ok(Some(nothing)),
    };
    let answer = session.query(query, &posed.configuration);
    let ending = session.finish();
    let Ok(sample) = answer else {
        return match &ending.outcome {
            Outcome::Cancelled => Ok(None),
            outcome if outcome.ours() => Err(fault(outcome)),
            _ => Ok(Some(nothing)),
        };
    };
    let terms = Terms { query, semantics: Semantics::Surface, precision: precision(algorithm) };
    let verdict = judge(&pair, &placed, terms, &sample.answer).verdict;
    Ok(Some(Asked { answer: sample.answer, verdict, truth }))
}

impl Checking<'_> {
    /// The question of a repro, and nothing else.
    pub(super) fn ask_again(&mut self, launcher: &Launcher, file: &Path, repro: &Repro) -> Result<()> {
        let bad = |what: &str, e: &dyn std::fmt::Display| LabError::Invalid(format!("The repro's {what}: {e}."));
        let mesh = |text: &str| match obj::read(text.as_bytes()) {
            Ok(read) => Ok(Arc::new(read.mesh)),
            Err(e) => Err(bad("object", &e)),
        };
        let pose = |numbers: &[f64; 16]| Pose::from_row_major(numbers).map_err(|e| bad("pose", &e));
        let configuration = Configuration { pose_a: pose(&repro.pose_a)?, pose_b: pose(&repro.pose_b)? };
        let posed = Posed { a: mesh(&repro.object_a)?, b: mesh(&repro.object_b)?, configuration };
        let known = self.report.algorithms.iter().find(|known| known.id == repro.algorithm).cloned();
        let algorithm = known.ok_or_else(|| bad("algorithm", &format!("{:?} is not in this file", repro.algorithm)))?;
        let killer = self.term.killer(self.term.ends());
        let asked = ask_once(launcher, &killer, file, &algorithm, repro.query, &posed)?;
        let check = format!("{}: {}, the query of the repro", algorithm.id, query_name(repro.query));
        let Some(asked) = asked else {
            self.not_reached(check, CheckVerdict::Fail, "the query was not");
            return Ok(());
        };
        let verdict =
            if asked.verdict.is_wrong() || asked.verdict.is_silent() { CheckVerdict::Fail } else { CheckVerdict::Pass };
        let evidence = format!("Expected: {}. Answered: {}.", expected(&asked.truth), answered(&asked.answer));
        self.line(check, verdict, evidence, None);
        Ok(())
    }
}
