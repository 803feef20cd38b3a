//! A replay with all that was asked for: its answers as a file, and the simplest scene that keeps them with what that saves.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use ocb_advice::Watch;

use super::{Progress, Replayed, Wanted, replay, workload_parquet};
use crate::advisor::Advisor;
use crate::algorithm::{Algorithm, Runner};
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::{ReduceTerms, ReducedScene, ReducedSpeed, WorkloadResult, WorkloadSpec, frontier};
use crate::recording::Recording;
use crate::reduce::{self, Reduced};
use crate::{LabError, Result};

/// A replay that was asked for.
pub struct Asked<'a> {
    /// What the program asked.
    pub recording: &'a Recording,
    /// How it is replayed.
    pub spec: &'a WorkloadSpec,
    /// The algorithms.
    pub algorithms: &'a [Arc<Algorithm>],
    /// Seed of the orders and of the equivalent instances.
    pub seed: u64,
}

/// Where a recording is replayed.
pub struct Site<'a> {
    /// What loads plugins.
    pub runner: &'a Runner,
    /// This machine.
    pub machine: &'a Machine,
    /// Ends it early.
    pub stop: &'a Stop,
    /// What makes simpler bodies of objects.
    pub advisor: &'a Advisor,
    /// For files that are needed for a moment.
    pub folder: &'a Path,
}

/// How far it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Far {
    /// Pairs are asked; so many queries are done.
    Pairs(u64),
    /// It does this, in a sentence.
    Doing(String),
}

/// Hears how far it is.
pub type Tell<'a> = &'a (dyn Fn(Far) + Sync);

/// All that was found.
pub struct Found {
    /// The result.
    pub result: WorkloadResult,
    /// The time and verdict of each query, as Parquet.
    pub queries: Vec<u8>,
    /// The same queries about the reduced scene, as a recording.
    pub reduced: Option<Vec<u8>>,
}

impl From<Progress> for Far {
    fn from(progress: Progress) -> Self {
        match progress {
            Progress::Scene { algorithm, process, of } => {
                Self::Doing(format!("Asking {algorithm} about the whole scene: process {process} of {of}."))
            }
            Progress::Pairs { done, .. } => Self::Pairs(done),
        }
    }
}

impl Asked<'_> {
    /// Replays the recording, and no more, while nothing else measures on this machine. Blocks.
    ///
    /// # Errors
    /// As for [`replay`].
    pub fn replay(&self, site: &Site<'_>, tell: &dyn Fn(Progress), waits: impl FnOnce()) -> Result<Replayed> {
        let _right = site.stop.right_to_measure(waits)?.ok_or(LabError::Stopped)?;
        let wanted = Wanted {
            algorithms: self.algorithms,
            tracks: &self.spec.tracks,
            passes: self.spec.passes,
            budget: Duration::from_secs_f64(self.spec.budget_seconds),
            seed: self.seed,
        };
        replay(self.recording, &wanted, site.runner, site.machine, site.stop, tell)
    }

    /// Replays the recording, and reduces its scene if that is wanted. Blocks.
    ///
    /// # Errors
    /// The same, `Invalid` when no scene can be reduced on these terms, and `Ended` when the advisor came to a bad end.
    pub fn carry_out(&self, site: &Site<'_>, tell: Tell<'_>) -> Result<Found> {
        let Replayed { mut result, rows } = self.replay(site, &|progress| tell(progress.into()), || {})?;
        let queries = workload_parquet(&rows, &self.recording.queries)?;
        drop(rows);
        let mut file = None;
        if let Some(terms) = self.spec.reduce {
            let (scene, recording) = self.reduced(site, terms, &result, tell)?;
            (result.reduced, file) = (Some(scene), Some(recording));
        }
        Ok(Found { result, queries, reduced: file })
    }

    /// Reduces the scene after its objects were replayed, and replays bodies, bodies and objects again. Also the recording about the
    /// bodies, as a file. For a frontier, the bodies of other tolerances are replayed as well.
    fn reduced(
        &self,
        site: &Site<'_>,
        terms: ReduceTerms,
        first: &WorkloadResult,
        tell: Tell<'_>,
    ) -> Result<(ReducedScene, Vec<u8>)> {
        let watch = Looking { stop: site.stop, tell };
        let make = |name: &str, object: &Arc<_>| site.advisor.simplify(name, object, &watch);
        let reduced = reduce::reduce::<LabError>(self.recording, terms, &make, &watch)?.ok_or(LabError::Stopped)?;
        let Reduced { reduction, recording: bodies, others, .. } = reduced;
        // The first order in which the objects were asked: no algorithm may know the first one that was wanted.
        let track = first.tracks[0].track;
        let spec = WorkloadSpec { tracks: vec![track], reduce: None, ..self.spec.clone() };
        let mut seed = self.seed;
        let mut again = |recording: &Recording, what: &str| {
            tell(Far::Doing(what.to_owned()));
            seed = seed.wrapping_add(1);
            let asked = Asked { recording, spec: &spec, algorithms: self.algorithms, seed };
            Ok::<_, LabError>(asked.replay(site, &|_| {}, || {})?.result)
        };
        let second = again(&bodies, "Measuring the reduced scene.")?;
        let third = again(&bodies, "Measuring the reduced scene again.")?;
        let last = again(self.recording, "Measuring the objects again.")?;
        let speed = ReducedSpeed::of([first, &second, &third, &last]);
        let mut points = Vec::new();
        for (tolerance, recording) in others {
            let what = format!("Measuring the scene for a tolerance of {tolerance}.");
            points.push((tolerance, again(&recording, &what)?));
        }
        let frontier = terms.frontier.then(|| {
            let mut all: Vec<_> = points.iter().map(|(tolerance, result)| (*tolerance, result)).collect();
            all.push((terms.tolerance, &second));
            all.sort_by(|x, y| x.0.total_cmp(&y.0));
            frontier(first, &all)
        });
        let fault = |e: std::io::Error| LabError::fault("Writing the reduced recording failed", e);
        let file = tempfile::NamedTempFile::new_in(site.folder).map_err(fault)?;
        bodies.write(file.path())?;
        Ok((ReducedScene { reduction, speed, frontier }, std::fs::read(file.path()).map_err(fault)?))
    }
}

/// Tells how far the reducing is, and ends it.
struct Looking<'a> {
    stop: &'a Stop,
    tell: Tell<'a>,
}

impl Watch for Looking<'_> {
    fn step(&self, what: &str, done: u64, total: u64) {
        (self.tell)(Far::Doing(format!("Reducing the scene: {what}, {done} of {total}.")));
    }

    fn stopped(&self) -> bool {
        self.stop.asked()
    }
}
