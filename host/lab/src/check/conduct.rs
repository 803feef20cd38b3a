//! How a plugin behaves beside its answers: determinism, counters, limits, timing.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use ocb_core::query::{Answer, Counters, Query};
use ocb_sandbox::{Ending, Killer, Launcher, Outcome, PassPlan, Question, Session, Trial, integrity};

use super::Checking;
use super::suite::{Scene, suite};
use super::term::share;
use crate::model::{AlgorithmInfo, CheckVerdict};
use crate::{LabError, Result};

/// Processes that are started here; each has a share of the time like a scene of the reference.
pub const PARTS: usize = 3;
/// Time for the timed pass.
const PASS: Duration = Duration::from_millis(1500);
/// So often each configuration is in the order of the timed pass.
const ROUNDS: u32 = 30;

/// All that one process said about a scene.
struct Heard {
    answers: Vec<(Answer, Option<Counters>)>,
    /// The tests per triangle add up to the primitive tests.
    per_triangle: bool,
    build_ns: f64,
    memory: Option<u64>,
}

impl Checking<'_> {
    /// The first scene in two fresh processes, then timed.
    pub(super) fn conduct(
        &mut self,
        [launcher, timed]: [&Launcher; 2],
        file: &Path,
        algorithm: &AlgorithmInfo,
        until: Instant,
    ) -> Result<()> {
        let Some(&query) = algorithm.queries.first().filter(|_| !self.is_stopped()) else { return Ok(()) };
        let scene = &suite()?.scenes[0];
        let id = &algorithm.id;
        let trial = Trial::new(file, id, &scene.mesh_a, None);
        let mut heard = Vec::new();
        for i in 0..2 {
            match hear(launcher, &trial, query, scene, &self.term.killer(share(until, PARTS - i))) {
                Ok(once) => heard.push(once),
                Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
                Err(ending) if ending.outcome == Outcome::Cancelled => {
                    let all = scene.placed.len();
                    self.not_reached(
                        format!("{id}: determinism"),
                        CheckVerdict::Fail,
                        &format!("{all} queries, each sent twice, were not"),
                    );
                    return Ok(());
                }
                Err(ending) => {
                    self.failed(format!("{id}: determinism"), &ending.outcome, &ending.stderr);
                    return Ok(());
                }
            }
        }
        self.determinism(id, &heard);
        self.counters(algorithm, &heard[0], scene);
        let memory = heard.iter().filter_map(|once| once.memory).max();
        let memory = memory.map_or_else(|| "an unknown amount".into(), |bytes| format!("{} KiB", bytes >> 10));
        let build = heard.iter().map(|once| once.build_ns).fold(0.0, f64::max) / 1e6;
        let evidence = format!("Builds an object in {build:.2} ms and uses at most {memory} of memory.");
        self.line(format!("{id}: limits"), CheckVerdict::Pass, evidence, None);
        self.timing(timed, &trial, query, scene, until)
    }

    fn determinism(&mut self, id: &str, heard: &[Heard]) {
        let check = format!("{id}: determinism");
        let same = heard[0].answers.iter().zip(&heard[1].answers).filter(|(x, y)| x.0 == y.0).count();
        let all = heard[0].answers.len();
        if same == all {
            let evidence = format!("Two fresh processes give the same {all} answers.");
            self.line(check, CheckVerdict::Pass, evidence, None);
        } else {
            let evidence = format!("Two fresh processes answer {} of {all} queries differently.", all - same);
            let hint = "Look for memory that is read before it is written, addresses as keys, and random numbers.";
            self.line(check, CheckVerdict::Fail, evidence, Some(hint));
        }
    }

    /// A hit is found by a test between primitives, and there are only so many pairs of them.
    fn counters(&mut self, algorithm: &AlgorithmInfo, heard: &Heard, scene: &Scene) {
        if !algorithm.counters {
            return;
        }
        let check = format!("{}: counters", algorithm.id);
        let pairs = scene.a.triangles().len() as u64 * scene.b.triangles().len() as u64;
        let hit = |answer: &Answer| match answer {
            Answer::Collision { hit, .. } => *hit,
            Answer::Contacts { total, .. } => *total > 0,
            Answer::Distance { distance, .. } => *distance == 0.0,
            Answer::GaveUp | Answer::Unsupported => false,
        };
        let odd = heard.answers.iter().filter(|(answer, counters)| match counters {
            Some(Counters { primitive_tests: Some(n), .. }) => *n > pairs || (hit(answer) && *n == 0),
            Some(Counters { bv_tests, .. }) => bv_tests.is_none(),
            None => true,
        });
        let odd = odd.count();
        if odd == 0 && heard.per_triangle {
            self.line(check, CheckVerdict::Pass, "The counters are plausible, per triangle too.".into(), None);
        } else if odd == 0 {
            let evidence = "The tests per triangle are missing or do not add up to the primitive tests: there is no \
                            heatmap of them.";
            let hint = "For each primitive test, add 1 to its triangle of A and to its triangle of B.";
            self.line(check, CheckVerdict::Note, evidence.into(), Some(hint));
        } else {
            let evidence = format!(
                "{odd} of {} counts are missing or impossible: a hit without a test, or more tests than pairs.",
                heard.answers.len()
            );
            self.line(check, CheckVerdict::Note, evidence, Some("Count each test between two triangles once."));
        }
    }

    /// What the clock shows from outside fits together.
    fn timing(
        &mut self,
        launcher: &Launcher,
        trial: &Trial,
        query: Query,
        scene: &Scene,
        until: Instant,
    ) -> Result<()> {
        let check = format!("{}: timing integrity", trial.algorithm);
        // Every run looks again, so no plugin fails for this.
        let late = "the timed queries were not";
        let mut session = match launcher.start_with(trial, &self.term.killer(until)) {
            Ok(session) => session,
            Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
            Err(ending) if ending.outcome == Outcome::Cancelled => {
                self.not_reached(check, CheckVerdict::Note, late);
                return Ok(());
            }
            Err(ending) => {
                self.failed(check, &ending.outcome, &ending.stderr);
                return Ok(());
            }
        };
        let n = scene.placed.len() as u32;
        let order: Vec<u32> = (0..n * ROUNDS).map(|i| i % n).collect();
        let plan = PassPlan { order: &order, coherent: false, seed: 1, allowance: PASS };
        let present = |number: u32, _| {
            let configuration = scene.placed[number as usize].configuration;
            Question { query, objects: [0, 1], configuration }
        };
        let (facts, _) = session.pass(&plan, &present, &mut |_| ControlFlow::Continue(()));
        let ending = session.finish();
        if ending.outcome == Outcome::Cancelled {
            self.not_reached(check, CheckVerdict::Note, late);
            return Ok(());
        }
        if ending.outcome != Outcome::Completed {
            self.failed(check, &ending.outcome, &ending.stderr);
            return Ok(());
        }
        let facts = [facts];
        match integrity::violated(&facts) {
            None if facts[0].reached == 0 => {
                let evidence = "The time limit was reached before the first answer.".to_owned();
                self.line(check, CheckVerdict::Note, evidence, Some("The machine is busy; every run repeats this."));
            }
            None => {
                let looked = integrity::measured(&facts).len();
                let evidence =
                    format!("{} timed answers, {looked} checks of the clock, no anomalies.", facts[0].reached);
                self.line(check, CheckVerdict::Pass, evidence, None);
            }
            Some(finding) => {
                let hint = "A busy machine can cause this; a curator will review it, and every run repeats this check.";
                self.line(check, CheckVerdict::Note, format!("{finding}."), Some(hint));
            }
        }
        Ok(())
    }
}

/// Asks one fresh process the whole scene, with counters.
fn hear(
    launcher: &Launcher,
    trial: &Trial,
    query: Query,
    scene: &Scene,
    killer: &Killer,
) -> std::result::Result<Heard, Ending> {
    let mut session: Session = launcher.start_with(trial, killer)?;
    let build_ns = session.set_up().build_ns;
    let mut answers = Vec::with_capacity(scene.placed.len());
    for placed in &scene.placed {
        match session.count(query, &placed.configuration) {
            Ok(answer) => answers.push(answer),
            Err(_) => break,
        }
    }
    let per_triangle = session.triangle_tests().is_some();
    let ending = session.finish();
    if ending.outcome != Outcome::Completed {
        return Err(ending);
    }
    Ok(Heard { answers, per_triangle, build_ns, memory: ending.memory_peak_bytes })
}
