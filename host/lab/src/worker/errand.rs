//! What a measuring machine does besides runs: checks of plugins, parts of stability runs, replays, and advice.

use std::time::Duration;

use super::{Fetch, Handed, Report, Tell, Worker, temporary_folder, write_plugin};
use crate::check::{Extent, Step, Term, check_plugin};
use crate::machine::MeasuringRight;
use crate::measure::Stop;
use crate::model::{Ended, Errand, Manifest, OrderedAlgorithm, Stability, StabilitySpec, Told, Wanted};
use crate::stability::{self, Selection};
use crate::{LabError, Result};

impl Worker {
    /// Does an errand; `None` when it was stopped. Blocks.
    ///
    /// # Errors
    /// `Fault` when a file cannot be had or is not the ordered one, or this machine cannot do it.
    pub fn run_errand(
        &self,
        errand: &Errand,
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: Tell<'_>,
    ) -> Result<Option<Handed>> {
        let ended = match &errand.wanted {
            Wanted::Check { plugin_sha256, manifest, quick, limit_seconds } => {
                let extent = Extent { manifest: Some(Manifest::clone(manifest)), quick: *quick, ..Extent::default() };
                let limit = Duration::from_secs_f64(*limit_seconds);
                self.check(plugin_sha256, (&extent, limit), stop, fetch, tell)?
            }
            Wanted::Stability { algorithm, spec, part, found } => {
                self.part((algorithm, spec, part), Stability::clone(found), stop, fetch, tell)?
            }
            Wanted::Replay { recording, spec, algorithms } => {
                return self.replay((recording, spec, algorithms), stop, fetch, tell);
            }
            Wanted::Advise { question, names, meshes: [a, b], counts } => {
                return self.advise((*question, names, *counts), [a, b], stop, fetch, tell);
            }
        };
        Ok(ended.map(|ended| Handed { ended, files: Vec::new() }))
    }

    fn check(
        &self,
        plugin_sha256: &str,
        (extent, limit): (&Extent, Duration),
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: Tell<'_>,
    ) -> Result<Option<Ended>> {
        let folder = temporary_folder()?;
        let file = write_plugin(folder.path(), plugin_sha256, fetch)?;
        let Some(_right) = right_to_measure(stop, tell)? else { return Ok(None) };
        let mut number = 0;
        let mut tell = |step: Step<'_>| {
            let told = match step {
                Step::Line(line) => {
                    number += 1;
                    Told::Line { number, line: Box::new(line.clone()) }
                }
                Step::Loads => Told::Loads,
            };
            tell(Report::Told(told));
            !stop.asked()
        };
        let report = check_plugin(&self.runner, &file, extent, &Term::new(stop, limit), &mut tell)?;
        Ok((!stop.asked()).then(|| Ended::Checked { report: Box::new(report) }))
    }

    fn part(
        &self,
        (ordered, spec, part): (&OrderedAlgorithm, &StabilitySpec, &str),
        mut found: Stability,
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: Tell<'_>,
    ) -> Result<Option<Ended>> {
        let folder = temporary_folder()?;
        let algorithm = self.algorithm(ordered, &folder, fetch)?;
        let Some(_right) = right_to_measure(stop, tell)? else { return Ok(None) };
        let selection = Selection::of(spec);
        match stability::part(&self.runner, &self.machine, &algorithm, &selection, part, &mut found, stop) {
            Err(LabError::Stopped) => Ok(None),
            tried => {
                tried.map(|()| Some(Ended::Tried { found: Box::new(found), seconds: stop.worked().as_secs_f64() }))
            }
        }
    }
}

/// Waits until no other process measures on this machine, and tells if it has to.
fn right_to_measure(stop: &Stop, tell: Tell<'_>) -> Result<Option<MeasuringRight>> {
    stop.right_to_measure(|| tell(Report::Told(Told::Waiting { waiting: true })))
}
