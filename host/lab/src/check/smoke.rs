//! The first questions: a few dozen certified configurations of small objects.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use nalgebra::Vector3;
use ocb_core::configuration::{Configuration, Method, Placed, Sampling, Separation};
use ocb_core::instance::{Presentation, Presented};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::sampling::Plan;
use ocb_core::stock;
use ocb_core::validation::{Terms, judge};
use ocb_sandbox::{Launcher, Outcome, Trial};

use super::repro::{Question, reduced};
use super::term::share;
use super::{Checking, query_name};
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckLine, CheckVerdict};
use crate::{LabError, Result};

/// Placements per relative distance.
const RAYS: u32 = 12;
/// Triangles of the smoke object: small enough for the slowest algorithm.
pub(super) const TRIANGLES: u32 = 500;
/// Apart, close, and in the place of A, where everything touches everything.
const DISTANCES: [f64; 3] = [0.2, 0.01, 0.0];

impl Checking<'_> {
    /// The questions that the algorithm answers, each with its share of the time.
    pub(super) fn smoke_all(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        until: Instant,
    ) -> Result<()> {
        let mut parts = Vec::new();
        for query in [Query::CollisionFirst, Query::CollisionAll, Query::Proximity] {
            if algorithm.queries.contains(&query) {
                parts.push((query, Semantics::Surface));
                if algorithm.solid && query != Query::CollisionAll {
                    parts.push((query, Semantics::Solid));
                }
            }
        }
        for (i, (query, semantics)) in parts.iter().enumerate() {
            if self.is_stopped() {
                break;
            }
            self.smoke(launcher, file, algorithm, (*query, *semantics), share(until, parts.len() - i))?;
        }
        Ok(())
    }

    fn smoke(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        (query, semantics): (Query, Semantics),
        until: Instant,
    ) -> Result<()> {
        let of = if semantics == Semantics::Solid { ", solid bodies" } else { "" };
        let check = format!("{}: {}{of}", algorithm.id, query_name(query));
        let smoke = match semantics {
            Semantics::Surface => Smoke::surfaces()?,
            Semantics::Solid => Smoke::solids()?,
        };
        let trial = Trial { semantics, ..Trial::new(file, &algorithm.id, &smoke.mesh_a, smoke.mesh_b.as_deref()) };
        let all = smoke.placed.len();
        let mut session = match launcher.start_with(&trial, &self.term.killer(until)) {
            Ok(session) => session,
            Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
            Err(ending) if ending.outcome == Outcome::Cancelled => {
                self.not_reached(check, CheckVerdict::Fail, &format!("none of the {all} queries was"));
                return Ok(());
            }
            Err(ending) => {
                self.failed(check, &ending.outcome, &ending.stderr);
                return Ok(());
            }
        };
        let pair = Pair::new(&smoke.a, &smoke.b);
        let terms = Terms { query, semantics, precision: precision(algorithm) };
        let mut wrong: Vec<(usize, Verdict, Answer)> = Vec::new();
        let (mut answers, mut silent) = (0, 0);
        for (i, placed) in smoke.placed.iter().enumerate() {
            let Ok(sample) = session.query(query, &placed.configuration) else { break };
            answers += 1;
            match judge(&pair, placed, terms, &sample.answer).verdict {
                verdict if verdict.is_wrong() => wrong.push((i, verdict, sample.answer)),
                Verdict::Unsupported | Verdict::GaveUp => silent += 1,
                _ => {}
            }
        }
        let ending = session.finish();
        let in_time = ending.outcome != Outcome::Cancelled;
        if ending.outcome.ours() {
            return Err(LabError::Fault(ending.to_string()));
        }
        if in_time && ending.outcome != Outcome::Completed {
            self.failed(check, &ending.outcome, &ending.stderr);
        } else if !wrong.is_empty() && !self.is_stopped() {
            let many = wrong.len();
            let (first, verdict, answer) = wrong.swap_remove(0);
            let evidence =
                format!("{many} of {answers} answers are wrong; the first is on configuration {first} ({verdict:?}).");
            let hint = "Compare with brute-force; triangles are closed sets, so touching counts as a collision.";
            // Fewer triangles of a solid body are none.
            let repro = if self.quick || semantics == Semantics::Solid {
                None
            } else {
                let asked = smoke.placed[first].configuration;
                let shown = Presentation::original(&smoke.mesh_a, smoke.mesh_b.as_deref());
                let question = Question::of(&shown, Presented { configuration: asked, swapped: false }, answer);
                reduced(self.term, until, launcher, file, algorithm, query, question, verdict)?.map(Box::new)
            };
            let hint = Some(hint.to_owned());
            self.add(CheckLine { check, verdict: CheckVerdict::Fail, evidence, hint, repro });
        } else if !in_time {
            self.not_reached(check, CheckVerdict::Fail, &format!("{answers} of {all} queries were"));
        } else if silent > 0 {
            let evidence = format!("No answer on {silent} of {all} configurations; the others are correct.");
            let hint = "An algorithm should answer every query that it offers.";
            self.line(check, CheckVerdict::Note, evidence, Some(hint));
        } else {
            let evidence = format!("All {all} answers agree with the reference.");
            self.line(check, CheckVerdict::Pass, evidence, None);
        }
        Ok(())
    }
}

/// What a plugin is tried on.
struct Smoke {
    mesh_a: Arc<Mesh>,
    /// Absent when it is the same object.
    mesh_b: Option<Arc<Mesh>>,
    a: Shape,
    b: Shape,
    placed: Vec<Placed>,
}

impl Smoke {
    /// A concave object against itself: apart, close, and crossing.
    fn surfaces() -> Result<Self> {
        let mesh_a = smoke_object("torus-knot")?;
        let shape = Shape::new(mesh_a.clone());
        let pair = Pair::new(&shape, &shape);
        let mut placed = Vec::new();
        for distance in DISTANCES {
            let method = Method::Sphere { sampling: Sampling::Count { count: RAYS }, seed: 1 };
            let plan = Plan::new(&shape, &shape, &method, Separation::Relative { distance })
                .map_err(|e| LabError::fault("Placing the smoke configurations failed", e))?;
            for found in (0..plan.units()).flat_map(|unit| plan.place(unit).placed) {
                placed.push(found);
                // Half the way to A's centre: a certain collision, which the sphere method alone never gives.
                let mut configuration = found.configuration;
                configuration.pose_b.translation *= 0.5;
                placed.push(certified(&pair, configuration));
            }
        }
        Ok(Self { mesh_a, mesh_b: None, a: shape.clone(), b: shape, placed })
    }

    /// A ball that leaves a larger one: inside, crossing, and apart.
    fn solids() -> Result<Self> {
        let mesh_a = smoke_object("sphere")?;
        let positions = mesh_a.positions().iter().map(|p| (p.coords * 0.25).into()).collect();
        let mesh_b = Mesh::new(positions, mesh_a.triangles().to_vec())
            .map_err(|e| LabError::fault("Making the smoke object failed", e))?;
        let mesh_b = Arc::new(mesh_b);
        let (a, b) = (Shape::new(mesh_a.clone()), Shape::new(mesh_b.clone()));
        let centre = |mesh: &Mesh| (mesh.bounds().min.coords + mesh.bounds().max.coords) / 2.0;
        let between = centre(&mesh_a) - centre(&mesh_b);
        let step = Vector3::new(0.06, 0.04, 0.02) * mesh_a.longest_side();
        let pair = Pair::new(&a, &b);
        let place = |i: u32| {
            let pose_b = Pose { translation: between + step * f64::from(i), ..Pose::identity() };
            certified(&pair, Configuration { pose_a: Pose::identity(), pose_b })
        };
        let placed = (0..RAYS).map(place).collect();
        Ok(Self { placed, a, b, mesh_a, mesh_b: Some(mesh_b) })
    }
}

pub(super) fn smoke_object(name: &str) -> Result<Arc<Mesh>> {
    let mesh = stock::generate(name, TRIANGLES);
    mesh.map(Arc::new).ok_or_else(|| LabError::Fault("The smoke object cannot be made.".into()))
}

pub(super) fn certified(pair: &Pair, configuration: Configuration) -> Placed {
    Placed { configuration, truth: pair.truth(&configuration), rounded: None, root_index: 0, wanted: None }
}
