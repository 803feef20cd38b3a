//! Checking one plugin file: the report that an author sees before anybody else runs the plugin.

mod conduct;
mod manifest;
mod reference;
mod repro;
mod suite;

use std::path::Path;
use std::sync::Arc;

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
use ocb_sandbox::{Launcher, Outcome, Policy, Profile, Trial};

pub use manifest::{check_manifest, is_free};
use repro::{Question, reduced};

use super::{built_here, info, read_plugin};
use crate::blobs::sha256_hex;
use crate::measure::precision;
use crate::model::{AlgorithmInfo, CheckLine, CheckVerdict, Manifest, PluginReport, Repro};
use crate::{EngineError, Result};

/// Placements per relative distance.
const RAYS: u32 = 12;
/// Triangles of the smoke object: small enough for the slowest algorithm.
const TRIANGLES: u32 = 500;
/// Apart, close, and in the place of A, where everything touches everything.
const DISTANCES: [f64; 3] = [0.2, 0.01, 0.0];

/// How much is checked.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    /// Only what takes a second: no comparison with the reference beyond the smoke configurations.
    pub quick: bool,
    /// What the author says of the plugin.
    pub manifest: Option<Manifest>,
    /// Nothing but this question.
    pub repro: Option<Repro>,
}

/// One check under way.
struct Checking<'c> {
    report: PluginReport,
    /// Hears every line as it is found; says whether to go on.
    tell: &'c mut dyn FnMut(&CheckLine) -> bool,
    stopped: bool,
    /// Nothing that takes longer than a second, such as looking for a small repro.
    quick: bool,
}

/// Makes the report. Blocks, so it wants a thread of its own. `tell` hears every line as it is found, and gives false when
/// nobody wants to know any more.
pub fn check_plugin(
    runner: &Path,
    file: &Path,
    profile: Profile,
    extent: &Extent,
    tell: &mut dyn FnMut(&CheckLine) -> bool,
) -> Result<PluginReport> {
    if !file.exists() {
        return Err(EngineError::Invalid(format!("There is no file {}.", file.display())));
    }
    let empty = PluginReport {
        file: file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        sha256: None,
        passed: false,
        lines: Vec::new(),
        algorithms: Vec::new(),
    };
    let mut checking = Checking { report: empty, tell, stopped: false, quick: extent.quick };
    let through = checking.all(runner, file, profile, extent)?;
    let mut report = checking.report;
    report.passed = through && report.lines.iter().all(|line| line.verdict != CheckVerdict::Fail);
    Ok(report)
}

impl Checking<'_> {
    /// Every check in order; false when one of them ended it.
    fn all(&mut self, runner: &Path, file: &Path, profile: Profile, extent: &Extent) -> Result<bool> {
        match read_plugin(file) {
            Ok(bytes) => {
                self.line("file format", CheckVerdict::Pass, format!("An ELF file of {} bytes.", bytes.len()), None);
                self.report.sha256 = Some(sha256_hex(&bytes));
            }
            Err(e) => {
                let hint = "Build a shared library, e.g. cc -shared -fPIC plugin.c -o plugin.so.";
                self.line("file format", CheckVerdict::Fail, e.to_string(), Some(hint));
                return Ok(false);
            }
        }
        // Our time limits for strangers' first try: a smoke query takes microseconds.
        let trusted = built_here(runner, file);
        let limits = Policy { build_seconds: 20.0, query_seconds: 5.0, trial_seconds: 60.0, ..Policy::default() };
        let policy = Policy { profile, trusted, ..limits };
        let launcher = Launcher::new(runner.to_owned(), policy);
        if !self.gate(&launcher, file)? || !self.load(&launcher, file)? {
            return Ok(false);
        }
        if let Some(repro) = &extent.repro {
            self.ask_again(&launcher, file, repro)?;
            return Ok(true);
        }
        if let Some(manifest) = &extent.manifest {
            self.manifest(manifest);
        }
        for algorithm in self.report.algorithms.clone() {
            self.descriptor(&algorithm);
            for query in [Query::CollisionFirst, Query::CollisionAll, Query::Proximity] {
                if algorithm.queries.contains(&query) {
                    self.smoke(&launcher, file, &algorithm, query, Semantics::Surface)?;
                    if algorithm.solid && query != Query::CollisionAll {
                        self.smoke(&launcher, file, &algorithm, query, Semantics::Solid)?;
                    }
                }
            }
        }
        // What fails already is not worth half a minute more.
        if self.quick || self.has_failed() {
            return Ok(true);
        }
        for algorithm in self.report.algorithms.clone() {
            self.against_the_reference(&launcher, file, &algorithm)?;
            if !self.has_failed() {
                self.conduct(&launcher, file, &algorithm)?;
            }
        }
        Ok(true)
    }

    /// What the file says of itself, from inside the jail. False when that ends the check.
    fn load(&mut self, launcher: &Launcher, file: &Path) -> Result<bool> {
        match launcher.describe(file) {
            Ok(descriptors) => {
                let hash = self.report.sha256.clone().unwrap_or_default();
                self.report.algorithms = descriptors.into_iter().map(|d| info(d, &hash)).collect();
                let names: Vec<&str> = self.report.algorithms.iter().map(|a| a.id.as_str()).collect();
                let evidence = format!("Loads in the jail and describes {}.", names.join(", "));
                self.line("load and describe", CheckVerdict::Pass, evidence, None);
                Ok(true)
            }
            Err(ending) if ending.outcome.ours() => Err(EngineError::Fault(ending.to_string())),
            Err(ending) => {
                let hint = hint_for(&ending.outcome);
                let evidence = with_output(&ending.to_string(), &ending.stderr);
                self.line("load and describe", CheckVerdict::Fail, evidence, hint);
                Ok(false)
            }
        }
    }

    fn line(&mut self, check: impl Into<String>, verdict: CheckVerdict, evidence: String, hint: Option<&str>) {
        self.add(CheckLine { check: check.into(), verdict, evidence, hint: hint.map(str::to_owned), repro: None });
    }

    fn has_failed(&self) -> bool {
        self.report.lines.iter().any(|line| line.verdict == CheckVerdict::Fail)
    }

    fn add(&mut self, line: CheckLine) {
        self.stopped |= !(self.tell)(&line);
        self.report.lines.push(line);
    }

    /// What the file is, read in the jail before anybody loads it. False when that ends the check.
    fn gate(&mut self, launcher: &Launcher, file: &Path) -> Result<bool> {
        let inspection = match launcher.inspect(file) {
            Ok(inspection) => inspection,
            Err(ending) if ending.outcome.ours() => return Err(EngineError::Fault(ending.to_string())),
            Err(ending) => {
                self.line("ELF gate", CheckVerdict::Fail, ending.to_string(), hint_for(&ending.outcome));
                return Ok(false);
            }
        };
        for rejection in &inspection.rejections {
            let check = format!("ELF gate: {}", rejection.rule);
            let evidence = sentence(&format!("{}; {}", rejection.what, rejection.why));
            self.line(check, CheckVerdict::Fail, evidence, Some(&sentence(&rejection.mend)));
        }
        if let (Some(facts), true) = (&inspection.facts, inspection.rejections.is_empty()) {
            self.line("ELF gate", CheckVerdict::Pass, facts.sentence(), None);
            let hint = "Nothing of it is forbidden; a curator looks at it.";
            facts
                .remarks()
                .into_iter()
                .for_each(|remark| self.line("ELF facts", CheckVerdict::Note, remark, Some(hint)));
        }
        Ok(inspection.rejections.is_empty())
    }

    /// What the descriptor owes the reader of a table.
    fn descriptor(&mut self, algorithm: &AlgorithmInfo) {
        let check = format!("{}: descriptor", algorithm.id);
        let empty: Vec<&str> = [
            ("authors", &algorithm.authors),
            ("licence", &algorithm.license),
            ("version", &algorithm.version),
            ("URL", &algorithm.url),
        ]
        .iter()
        .filter(|(_, text)| text.is_empty())
        .map(|(name, _)| *name)
        .collect();
        if algorithm.queries.is_empty() {
            let hint = "Offer at least the collision query.";
            self.line(check, CheckVerdict::Fail, "It answers no question.".into(), Some(hint));
        } else if empty.is_empty() {
            let evidence = format!("{} {}, {}.", algorithm.name, algorithm.version, algorithm.license);
            self.line(check, CheckVerdict::Pass, evidence, None);
        } else {
            let evidence = format!("Nothing is said about: {}.", empty.join(", "));
            self.line(check, CheckVerdict::Note, evidence, Some("Fill the descriptor before you publish the plugin."));
        }
    }

    /// A few certified configurations of a small object.
    fn smoke(
        &mut self,
        launcher: &Launcher,
        file: &Path,
        algorithm: &AlgorithmInfo,
        query: Query,
        semantics: Semantics,
    ) -> Result<()> {
        let of = if semantics == Semantics::Solid { ", solid bodies" } else { "" };
        let check = format!("{}: {}{of}", algorithm.id, query_name(query));
        let smoke = match semantics {
            Semantics::Surface => Smoke::surfaces()?,
            Semantics::Solid => Smoke::solids()?,
        };
        let trial = Trial {
            plugin: file,
            algorithm: &algorithm.id,
            mesh_a: &smoke.mesh_a,
            mesh_b: smoke.mesh_b.as_deref(),
            parameters: &[],
            semantics,
        };
        let mut session = match launcher.start(&trial) {
            Ok(session) => session,
            Err(ending) if ending.outcome.ours() => return Err(EngineError::Fault(ending.to_string())),
            Err(ending) => {
                let evidence = with_output(&ending.to_string(), &ending.stderr);
                self.line(check, CheckVerdict::Fail, evidence, hint_for(&ending.outcome));
                return Ok(());
            }
        };
        let pair = Pair::new(&smoke.a, &smoke.b);
        let terms = Terms { query, semantics, precision: precision(algorithm) };
        let mut wrong: Vec<(usize, Verdict, Answer)> = Vec::new();
        let mut silent = 0;
        for (i, placed) in smoke.placed.iter().enumerate() {
            let Ok(sample) = session.query(query, &placed.configuration) else { break };
            match judge(&pair, placed, terms, &sample.answer).verdict {
                verdict if verdict.is_wrong() => wrong.push((i, verdict, sample.answer)),
                Verdict::Unsupported | Verdict::GaveUp => silent += 1,
                _ => {}
            }
        }
        let ending = session.finish();
        if ending.outcome != Outcome::Completed {
            if ending.outcome.ours() {
                return Err(EngineError::Fault(ending.to_string()));
            }
            let evidence = with_output(&ending.to_string(), &ending.stderr);
            self.line(check, CheckVerdict::Fail, evidence, hint_for(&ending.outcome));
        } else if !wrong.is_empty() {
            let (all, many) = (smoke.placed.len(), wrong.len());
            let (first, verdict, answer) = wrong.swap_remove(0);
            let evidence =
                format!("{many} of {all} answers are wrong, the first ({verdict:?}) on configuration {first}.");
            let hint = "Compare with brute-force; triangles are closed sets, so touching counts as a collision.";
            // Fewer triangles of a solid body are none.
            let repro = if self.quick || semantics == Semantics::Solid {
                None
            } else {
                let asked = smoke.placed[first].configuration;
                let shown = Presentation::original(&smoke.mesh_a, smoke.mesh_b.as_deref());
                let question = Question::of(&shown, Presented { configuration: asked, swapped: false }, answer);
                Some(Box::new(reduced(launcher, file, algorithm, query, question, verdict)?))
            };
            let hint = Some(hint.to_owned());
            self.add(CheckLine { check, verdict: CheckVerdict::Fail, evidence, hint, repro });
        } else if silent > 0 {
            let evidence =
                format!("No answer on {silent} of {} configurations, the others are right.", smoke.placed.len());
            let hint = "An algorithm that offers a question should answer it.";
            self.line(check, CheckVerdict::Note, evidence, Some(hint));
        } else {
            let evidence = format!("All {} answers agree with the reference.", smoke.placed.len());
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
                .map_err(|e| EngineError::fault("Placing the smoke configurations failed", e))?;
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
            .map_err(|e| EngineError::fault("Making the smoke object failed", e))?;
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

fn smoke_object(name: &str) -> Result<Arc<Mesh>> {
    let mesh = stock::generate(name, TRIANGLES);
    mesh.map(Arc::new).ok_or_else(|| EngineError::Fault("The smoke object cannot be made.".into()))
}

fn certified(pair: &Pair, configuration: Configuration) -> Placed {
    Placed { configuration, truth: pair.truth(&configuration), root_index: 0, wanted: None }
}

/// First letter large, full stop.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

fn query_name(query: Query) -> &'static str {
    match query {
        Query::CollisionFirst => "first contact",
        Query::CollisionAll => "all contacts",
        Query::Proximity => "distance",
    }
}

/// The last lines that the plugin wrote are often the whole explanation.
fn with_output(sentence: &str, stderr: &str) -> String {
    let tail: Vec<&str> = stderr.lines().rev().filter(|line| !line.trim().is_empty()).take(3).collect();
    if tail.is_empty() {
        return sentence.to_owned();
    }
    format!("{sentence} It wrote: {}", tail.into_iter().rev().collect::<Vec<_>>().join(" / "))
}

fn hint_for(outcome: &Outcome) -> Option<&'static str> {
    match outcome {
        Outcome::LoadError { .. } => Some("Check the exported entry symbol, the version and the linked libraries."),
        Outcome::SyscallDenied { .. } => Some("A plugin computes; it opens no files, no sockets and no processes."),
        Outcome::TimedOut { .. } => Some("Look for an endless loop: the smoke objects have 500 triangles."),
        Outcome::OutOfMemory { .. } => Some("Look for a leak: the smoke objects have 500 triangles."),
        Outcome::Signaled { .. } => Some("Run the plugin under a debugger or a sanitizer with a small object."),
        _ => None,
    }
}
