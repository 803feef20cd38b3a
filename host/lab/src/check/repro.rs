//! The smallest question that is still answered wrongly, for its author to take home.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ocb_core::configuration::{Configuration, Placed};
use ocb_core::instance::{Presentation, Presented};
use ocb_core::mesh::{Mesh, obj};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::reduce::reduce;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Killer, Launcher, Outcome, Trial};

use super::smoke::certified;
use super::term::Term;
use super::{Checking, query_name};
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckVerdict, Repro};
use crate::{LabError, Result};

/// Processes started at most to find fewer triangles.
const TRIES: usize = 150;
/// Time for that at most; an algorithm that is slow to build is left with a larger repro.
const LONGEST: Duration = Duration::from_secs(20);
/// And at least, though its own share of the check is over: a wrong answer without its question helps no author.
const LEAST: Duration = Duration::from_secs(2);

/// A question as the plugin saw it, and what it said.
pub struct Question {
    mesh_a: Mesh,
    mesh_b: Mesh,
    configuration: Configuration,
    answer: Answer,
}

impl Question {
    /// In the numbers of the process that asked it.
    pub fn of(shown: &Presentation, asked: Presented, answer: Answer) -> Self {
        let (first, second) = (shown.first().clone(), shown.second().unwrap_or(shown.first()).clone());
        let (mesh_a, mesh_b) = if asked.swapped { (second, first) } else { (first, second) };
        Self { mesh_a, mesh_b, configuration: asked.configuration, answer }
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
    let Question { mesh_a, mesh_b, configuration, answer } = question;
    let a = mesh_a.triangles().len();
    let mut fault = None;
    let mut last: Option<(Mesh, Mesh, Asked)> = None;
    let mut fails = |kept: &[usize]| {
        if over() {
            return false;
        }
        let (of_a, of_b) = kept.split_at(kept.partition_point(|i| *i < a));
        let parts = part(&mesh_a, of_a.iter().copied()).zip(part(&mesh_b, of_b.iter().map(|i| i - a)));
        let Some((part_a, part_b)) = parts else { return false };
        match ask_once(launcher, &term.killer(until), file, algorithm, query, [&part_a, &part_b], &configuration) {
            Ok(Some(asked)) if asked.verdict.is_wrong() => {
                last = Some((part_a, part_b, asked));
                true
            }
            Ok(_) => false,
            Err(e) => {
                fault.get_or_insert(e);
                false
            }
        }
    };
    let all: Vec<usize> = (0..a + mesh_b.triangles().len()).collect();
    if fails(&all) {
        reduce(all.len(), TRIES, &mut fails);
    }
    if let Some(fault) = fault {
        return Err(fault);
    }
    let alone = last.is_some();
    if !alone && over() {
        return Ok(None);
    }
    let (mesh_a, mesh_b, asked) = last.unwrap_or_else(|| {
        let placed = truth(&mesh_a, &mesh_b, configuration);
        (mesh_a, mesh_b, Asked { answer, verdict, placed })
    });
    Ok(Some(Repro {
        algorithm: algorithm.id.clone(),
        query,
        object_a: obj::write(&mesh_a),
        object_b: obj::write(&mesh_b),
        pose_a: configuration.pose_a.to_row_major(),
        pose_b: configuration.pose_b.to_row_major(),
        triangles: [mesh_a.triangles().len() as u32, mesh_b.triangles().len() as u32],
        expected: expected(&asked.placed),
        got: got(&asked.answer),
        verdict: asked.verdict,
        alone,
    }))
}

/// One answer with its truth.
struct Asked {
    answer: Answer,
    verdict: Verdict,
    placed: Placed,
}

fn truth(a: &Mesh, b: &Mesh, configuration: Configuration) -> Placed {
    let [a, b] = [a, b].map(|mesh| Shape::new(Arc::new(mesh.clone())));
    certified(&Pair::new(&a, &b), configuration)
}

/// Asks a fresh process one question; `None` when it was ended before it answered.
fn ask_once(
    launcher: &Launcher,
    killer: &Killer,
    file: &Path,
    algorithm: &AlgorithmInfo,
    query: Query,
    [a, b]: [&Mesh; 2],
    configuration: &Configuration,
) -> Result<Option<Asked>> {
    let trial = Trial::new(file, &algorithm.id, a, Some(b));
    let fault = |outcome: &Outcome| LabError::Fault(outcome.to_string());
    let placed = truth(a, b, *configuration);
    // A plugin that dies of this question answers nothing, and it is another failure than the one that is looked for.
    let nothing = Asked { answer: Answer::GaveUp, verdict: Verdict::GaveUp, placed };
    let mut session = match launcher.start_with(&trial, killer) {
        Ok(session) => session,
        Err(ending) if ending.outcome.ours() => return Err(fault(&ending.outcome)),
        Err(ending) if ending.outcome == Outcome::Cancelled => return Ok(None),
        Err(_) => return Ok(Some(nothing)),
    };
    let answer = session.query(query, configuration);
    let ending = session.finish();
    let Ok(sample) = answer else {
        return match &ending.outcome {
            Outcome::Cancelled => Ok(None),
            outcome if outcome.ours() => Err(fault(outcome)),
            _ => Ok(Some(nothing)),
        };
    };
    let [shape_a, shape_b] = [a, b].map(|mesh| Shape::new(Arc::new(mesh.clone())));
    let terms = Terms { query, semantics: Semantics::Surface, precision: precision(algorithm) };
    let verdict = judge(&Pair::new(&shape_a, &shape_b), &placed, terms, &sample.answer).verdict;
    Ok(Some(Asked { answer: sample.answer, verdict, placed }))
}

/// The mesh of these triangles and their vertices; none when nothing with area is left.
fn part(mesh: &Mesh, kept: impl Iterator<Item = usize>) -> Option<Mesh> {
    let triangles: Vec<[u32; 3]> = kept.map(|i| mesh.triangles()[i]).collect();
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let positions = used.iter().map(|v| mesh.positions()[*v as usize]).collect();
    let renamed = |v: u32| used.binary_search(&v).expect("a vertex of a triangle") as u32;
    Mesh::new(positions, triangles.into_iter().map(|t| t.map(renamed)).collect()).ok()
}

fn expected(placed: &Placed) -> String {
    let truth = &placed.truth;
    if truth.hit {
        return format!("The surfaces intersect; they still do if every vertex moves by {:e}.", truth.margin);
    }
    format!("The surfaces are disjoint; their distance is from {:e} to {:e}.", truth.distance_lo, truth.distance_hi)
}

fn got(answer: &Answer) -> String {
    let of = |pair: &Option<[u32; 2]>| pair.map_or_else(String::new, |[a, b]| format!(", triangles {a} and {b}"));
    match answer {
        Answer::Collision { hit: true, pair } => format!("A collision{}.", of(pair)),
        Answer::Collision { hit: false, .. } => "No collision.".into(),
        Answer::Contacts { total, .. } => format!("{total} intersecting pairs of triangles."),
        Answer::Distance { distance, triangles, .. } => format!("A distance of {distance:e}{}.", of(triangles)),
        Answer::GaveUp | Answer::Unsupported => "Nothing.".into(),
    }
}

impl Checking<'_> {
    /// The question of a repro, and nothing else.
    pub(super) fn ask_again(&mut self, launcher: &Launcher, file: &Path, repro: &Repro) -> Result<()> {
        let bad = |what: &str, e: &dyn std::fmt::Display| LabError::Invalid(format!("The repro's {what}: {e}."));
        let mesh = |text: &str| obj::read(text.as_bytes()).map(|read| read.mesh).map_err(|e| bad("object", &e));
        let pose = |numbers: &[f64; 16]| Pose::from_row_major(numbers).map_err(|e| bad("pose", &e));
        let (a, b) = (mesh(&repro.object_a)?, mesh(&repro.object_b)?);
        let configuration = Configuration { pose_a: pose(&repro.pose_a)?, pose_b: pose(&repro.pose_b)? };
        let known = self.report.algorithms.iter().find(|known| known.id == repro.algorithm).cloned();
        let algorithm = known.ok_or_else(|| bad("algorithm", &format!("{:?} is not in this file", repro.algorithm)))?;
        let killer = self.term.killer(self.term.ends());
        let asked = ask_once(launcher, &killer, file, &algorithm, repro.query, [&a, &b], &configuration)?;
        let check = format!("{}: {}, the query of the repro", algorithm.id, query_name(repro.query));
        let Some(asked) = asked else {
            self.not_reached(check, CheckVerdict::Fail, "the query was not");
            return Ok(());
        };
        let verdict =
            if asked.verdict.is_wrong() || asked.verdict.is_silent() { CheckVerdict::Fail } else { CheckVerdict::Pass };
        let evidence = format!("Expected: {} Got: {}", expected(&asked.placed), got(&asked.answer));
        self.line(check, verdict, evidence, None);
        Ok(())
    }
}
