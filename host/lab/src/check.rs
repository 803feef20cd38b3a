//! Checking one plugin file: the report that an author sees before anybody else runs the plugin.

mod conduct;
mod manifest;
mod reference;
mod repro;
mod smoke;
mod suite;
mod term;

use std::path::Path;

use ocb_core::query::Query;
use ocb_sandbox::{Launcher, Outcome, Policy};

pub use manifest::{check_manifest, is_free};
use term::share;
pub use term::{CHECK_LIMIT, Term};

use crate::algorithm::{Runner, builds, info, read_plugin};
use crate::model::{AlgorithmInfo, CheckLine, CheckVerdict, Manifest, PluginReport, Repro};
use crate::{LabError, Result, sha256_hex};

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

/// What a check under way tells.
#[derive(Clone, Copy, Debug)]
pub enum Step<'a> {
    /// Another line of the report.
    Line(&'a CheckLine),
    /// The file loads in the jail and describes its algorithms; what follows is about their answers.
    Loads,
}

/// One check under way.
struct Checking<'c> {
    report: PluginReport,
    /// Hears every step as it is made; says whether to go on.
    tell: &'c mut dyn FnMut(Step<'_>) -> bool,
    stopped: bool,
    term: &'c Term<'c>,
    /// Nothing that takes longer than a second, such as looking for a small repro.
    quick: bool,
}

/// Makes the report within the term. Blocks, so it wants a thread of its own. `tell` hears every step, and returns
/// false to end the check.
pub fn check_plugin(
    runner: &Runner,
    file: &Path,
    extent: &Extent,
    term: &Term<'_>,
    tell: &mut dyn FnMut(Step<'_>) -> bool,
) -> Result<PluginReport> {
    if !file.exists() {
        return Err(LabError::Invalid(format!("The file {} does not exist.", file.display())));
    }
    let empty = PluginReport {
        file: file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        sha256: None,
        passed: false,
        lines: Vec::new(),
        algorithms: Vec::new(),
    };
    let mut checking = Checking { report: empty, tell, stopped: false, term, quick: extent.quick };
    let through = term.watch(|| checking.all(runner, file, extent))?;
    let mut report = checking.report;
    report.passed = through && report.lines.iter().all(|line| line.verdict != CheckVerdict::Fail);
    Ok(report)
}

impl Checking<'_> {
    /// Every check in order; false when one of them ended it.
    fn all(&mut self, runner: &Runner, file: &Path, extent: &Extent) -> Result<bool> {
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
        let trusted = runner.trusts(file);
        let limits = Policy { build_seconds: 20.0, query_seconds: 5.0, trial_seconds: 60.0, ..Policy::default() };
        let policy = Policy { profile: runner.profile, trusted, ..limits };
        let timed = Launcher::new(runner.program.clone(), policy.clone());
        let launcher = Launcher::new(runner.program.clone(), Policy { rough_clock: true, ..policy });
        if !self.gate(&launcher, file)? || !self.load(&launcher, file)? {
            return Ok(false);
        }
        if let Some(repro) = &extent.repro {
            self.ask_again(&launcher, file, repro)?;
            return Ok(!self.is_stopped());
        }
        if let Some(manifest) = &extent.manifest {
            self.manifest(manifest);
        }
        let algorithms = self.report.algorithms.clone();
        // The first questions may take half of the limit, so that something is left for the many.
        let ends = if self.quick { self.term.ends() } else { share(self.term.ends(), 2) };
        for (i, algorithm) in algorithms.iter().enumerate() {
            self.descriptor(algorithm);
            self.smoke_all(&launcher, file, algorithm, share(ends, algorithms.len() - i))?;
        }
        // What fails already is not worth half a minute more.
        if self.quick || self.has_failed() {
            return Ok(!self.is_stopped());
        }
        for (i, algorithm) in algorithms.iter().enumerate() {
            let until = share(self.term.ends(), algorithms.len() - i);
            self.against_the_reference(&launcher, file, algorithm, until)?;
            if !self.has_failed() {
                self.conduct([&launcher, &timed], file, algorithm, until)?;
            }
        }
        Ok(!self.is_stopped())
    }

    /// What the file says of itself, from inside the jail. False when that ends the check.
    fn load(&mut self, launcher: &Launcher, file: &Path) -> Result<bool> {
        match launcher.describe_with(file, &self.term.killer(self.term.ends())) {
            Ok(descriptors) => {
                let hash = self.report.sha256.clone().unwrap_or_default();
                let builds = builds(launcher, file)?;
                self.report.algorithms = descriptors.into_iter().map(|d| info(d, &hash, builds.clone())).collect();
                let names: Vec<&str> = self.report.algorithms.iter().map(|a| a.id.as_str()).collect();
                let evidence = format!("Loads in the jail and describes {}.", names.join(", "));
                self.line("load and describe", CheckVerdict::Pass, evidence, None);
                self.stopped |= !(self.tell)(Step::Loads);
                Ok(true)
            }
            Err(ending) if ending.outcome.ours() => Err(LabError::Fault(ending.to_string())),
            Err(_) if self.is_stopped() => Ok(false),
            Err(ending) => {
                self.failed("load and describe", &ending.outcome, &ending.stderr);
                Ok(false)
            }
        }
    }

    fn line(&mut self, check: impl Into<String>, verdict: CheckVerdict, evidence: String, hint: Option<&str>) {
        self.add(CheckLine { check: check.into(), verdict, evidence, hint: hint.map(str::to_owned), repro: None });
    }

    /// The line for a process that ended before its work was done. It names the phase as plugin.h does, and the last lines that
    /// the plugin wrote, which are often the whole explanation.
    fn failed(&mut self, check: impl Into<String>, outcome: &Outcome, stderr: &str) {
        let mut evidence = outcome.to_string();
        if let Some(phase) = outcome.phase() {
            evidence += &format!(" Phase of plugin.h: {}.", phase.mark());
        }
        let mut tail: Vec<&str> = stderr.lines().rev().filter(|line| !line.trim().is_empty()).take(3).collect();
        if !tail.is_empty() {
            tail.reverse();
            evidence += &format!(" Its output: {}", tail.join(" / "));
        }
        self.line(check, CheckVerdict::Fail, evidence, hint_for(outcome));
    }

    /// Nobody wants to know any more.
    fn is_stopped(&self) -> bool {
        self.stopped || self.term.is_stopped()
    }

    /// The line for what did not come to its end in its share of the limit; none when the check was stopped.
    fn not_reached(&mut self, check: String, verdict: CheckVerdict, what: &str) {
        if self.is_stopped() {
            return;
        }
        let limit = self.term.words();
        let evidence = format!("Not finished within the limit: {what} answered in this part's share of {limit}.");
        let hint = "All algorithms of a file share one time limit equally: offer fewer algorithms per file, or make them build and answer small objects faster.";
        self.line(check, verdict, evidence, Some(hint));
    }

    fn has_failed(&self) -> bool {
        self.report.lines.iter().any(|line| line.verdict == CheckVerdict::Fail)
    }

    fn add(&mut self, line: CheckLine) {
        self.stopped |= !(self.tell)(Step::Line(&line));
        self.report.lines.push(line);
    }

    /// What the file is, read in the jail before anybody loads it. False when that ends the check.
    fn gate(&mut self, launcher: &Launcher, file: &Path) -> Result<bool> {
        let inspection = match launcher.inspect_with(file, &self.term.killer(self.term.ends())) {
            Ok(inspection) => inspection,
            Err(ending) if ending.outcome.ours() => return Err(LabError::Fault(ending.to_string())),
            Err(_) if self.is_stopped() => return Ok(false),
            Err(ending) => {
                self.failed("ELF gate", &ending.outcome, &ending.stderr);
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
            let hint = "This is allowed; a curator will review it.";
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
            self.line(check, CheckVerdict::Fail, "It answers no query.".into(), Some(hint));
        } else if empty.is_empty() {
            let evidence = format!("{} {}, {}.", algorithm.name, algorithm.version, algorithm.license);
            self.line(check, CheckVerdict::Pass, evidence, None);
        } else {
            let evidence = format!("Missing: {}.", empty.join(", "));
            self.line(check, CheckVerdict::Note, evidence, Some("Fill the descriptor before you publish the plugin."));
        }
    }
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
