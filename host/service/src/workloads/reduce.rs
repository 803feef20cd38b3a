//! The simplest scene that keeps the answers of a recording, and what it saves: a part of a replay.

use std::sync::{Arc, Mutex, PoisonError};

use ocb_advice::Watch;
use ocb_lab::LabError;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::recording::Recording;
use ocb_lab::reduce::{self, Reduced};

use super::replay::Replays;
use crate::advice::jailed::{Advisor, SHELF};
use crate::blocking::blocking;
use crate::measure::Stop;
use crate::model::{ReduceTerms, ReducedScene, ReducedSpeed, Track, WorkloadResult, WorkloadSpec, frontier};
use crate::{EngineError, Result};

/// What a replay does before or after it asks pair by pair, in a sentence.
#[derive(Default)]
pub(super) struct Doing(Mutex<Option<String>>);

impl Doing {
    pub fn say(&self, what: Option<String>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = what;
    }

    pub fn now(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Tells how far it is, and ends it.
struct Looking {
    stop: Stop,
    doing: Arc<Doing>,
}

impl Watch for Looking {
    fn step(&self, what: &str, done: u64, total: u64) {
        self.doing.say(Some(format!("Reducing the scene: {what}, {done} of {total}.")));
    }

    fn stopped(&self) -> bool {
        self.stop.asked()
    }
}

/// A replay that also reduces its scene.
pub(super) struct Reducing<'a> {
    pub replays: &'a Replays,
    pub recording: &'a Arc<Recording>,
    pub spec: &'a WorkloadSpec,
    pub algorithms: &'a [Arc<Algorithm>],
    pub stop: &'a Stop,
    pub doing: &'a Arc<Doing>,
    /// The first order in which the objects were asked: no algorithm may know the first one that was wanted.
    pub track: Track,
}

impl Reducing<'_> {
    /// Reduces the scene after its objects were replayed, and replays bodies, bodies and objects again. Also the recording about the
    /// bodies, as a file. For a frontier, the bodies of other tolerances are replayed as well.
    pub async fn reduced(&self, terms: ReduceTerms, first: &WorkloadResult) -> Result<(ReducedScene, Vec<u8>)> {
        let Reduced { reduction, recording, others, .. } = self.reduce(terms).await?;
        let bodies = Arc::new(recording);
        let second = self.again(&bodies, "Measuring the reduced scene.").await?;
        let third = self.again(&bodies, "Measuring the reduced scene again.").await?;
        let last = self.again(self.recording, "Measuring the objects again.").await?;
        let speed = ReducedSpeed::of([first, &second, &third, &last]);
        let mut points = Vec::new();
        for (tolerance, recording) in others {
            let what = format!("Measuring the scene for a tolerance of {tolerance}.");
            points.push((tolerance, self.again(&Arc::new(recording), &what).await?));
        }
        let frontier = terms.frontier.then(|| {
            let mut all: Vec<_> = points.iter().map(|(tolerance, result)| (*tolerance, result)).collect();
            all.push((terms.tolerance, &second));
            all.sort_by(|x, y| x.0.total_cmp(&y.0));
            frontier(first, &all)
        });
        let folder = self.replays.data.clone();
        let file = blocking(move || {
            let fault = |e: std::io::Error| EngineError::fault("Writing the reduced recording failed", e);
            let file = tempfile::NamedTempFile::new_in(&folder).map_err(fault)?;
            bodies.write(file.path())?;
            std::fs::read(file.path()).map_err(fault)
        });
        Ok((ReducedScene { reduction, speed, frontier }, file.await?))
    }

    async fn reduce(&self, terms: ReduceTerms) -> Result<Reduced> {
        let Replays { advisor, machine, data, .. } = self.replays;
        let advisor = Advisor::new(advisor, machine, &data.join(SHELF));
        let watch = Looking { stop: self.stop.clone(), doing: self.doing.clone() };
        let of = self.recording.clone();
        let reduced = blocking(move || {
            let make = |name: &str, object: &Arc<_>| advisor.simplify(name, object, &watch);
            reduce::reduce::<EngineError>(&of, terms, &make, &watch)
        });
        Ok(reduced.await?.ok_or(LabError::Stopped)?)
    }

    async fn again(&self, recording: &Arc<Recording>, what: &str) -> Result<WorkloadResult> {
        self.doing.say(Some(what.to_owned()));
        let spec = WorkloadSpec { tracks: vec![self.track], reduce: None, ..self.spec.clone() };
        let (algorithms, stop) = (self.algorithms.to_vec(), self.stop.clone());
        Ok(self.replays.replay(recording.clone(), spec, algorithms, stop, |_| {}, || {}).await?.result)
    }
}
