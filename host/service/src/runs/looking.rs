//! Preliminary results of a run: which runs have them, and passing them on.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use ocb_core::configuration::ConfigurationSet;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::pairing::Pairing;

use crate::machine::MeasuringRight;
use crate::measure::{self, Part, Preliminary, Stop, Task};
use crate::model::RunSpec;
use crate::runs::benchmarks::Benchmarks;
use crate::runs::draw;
use crate::runs::sql::RunRow;

/// One run while it is looked at.
pub struct Looking<'a> {
    benchmarks: &'a Benchmarks,
    stop: &'a Stop,
    run: String,
    spec: RunSpec,
    algorithms: Vec<Arc<Algorithm>>,
    reference: Option<Arc<Algorithm>>,
    /// Of the processes that look, if somebody may watch the run; those that measure have another.
    seed: Option<u64>,
    looked: AtomicBool,
}

/// The seed of the processes that look at a run before its rounds; nothing when nobody watches it. Runs of the suite and of campaigns
/// have no visitor who waits, and a refined run has results already.
pub fn seed(row: &RunRow, algorithms: &[Arc<Algorithm>]) -> Option<u64> {
    let watched = row.suite.is_none() && row.campaign.is_none() && !row.is_refined();
    watched.then(|| draw::seed(row, "first look", algorithms))
}

impl<'a> Looking<'a> {
    /// Where machines measure, the service looks at no run itself.
    pub fn new(
        benchmarks: &'a Benchmarks,
        stop: &'a Stop,
        row: &RunRow,
        algorithms: Vec<Arc<Algorithm>>,
        reference: Option<Arc<Algorithm>>,
    ) -> Self {
        Self {
            benchmarks,
            stop,
            run: row.id.clone(),
            spec: row.spec.clone(),
            seed: seed(row, &algorithms).filter(|_| !benchmarks.elsewhere),
            algorithms,
            reference,
            looked: AtomicBool::new(false),
        }
    }

    /// The run's task on this set, without controls.
    pub fn task<'t>(&'t self, pairing: &'t Pairing, set: &'t ConfigurationSet, part: Part) -> Task<'t> {
        let task = Task::of(&self.spec, (pairing, set, part), &self.algorithms, self.reference.as_ref());
        Task { watched: self.seed.is_some(), ..task }
    }

    /// The seed of the processes that look before the rounds, unless that was done.
    pub fn to_come(&self) -> Option<u64> {
        self.seed.filter(|_| !self.looked.swap(true, Ordering::Relaxed))
    }

    /// Where the rest of the set takes long: looks at its beginning. The machine may belong to another process now.
    pub fn at_beginning(&self, pairing: &Pairing, set: &ConfigurationSet, of: u64) {
        let Ok(Some(_right)) = MeasuringRight::try_take() else { return };
        let Some(seed) = self.to_come() else { return };
        self.benchmarks.live.under_way.begins_with(&self.run, set.clone());
        let task = Task { seed, ..self.task(pairing, set, Part { precision: None, at_most: usize::MAX, of }) };
        let (runner, machine) = (self.benchmarks.registry.runner(), &self.benchmarks.machine);
        measure::first_look(&task, runner, machine, self.stop, &mut |place, seen| self.show(place, seen));
    }

    /// An algorithm is so far in the rounds.
    pub fn progress(&self, index: usize, done: u64, total: u64, worked: Duration) {
        self.benchmarks.live.progress(&self.run, index, done, total, worked);
    }

    /// The algorithm at this place of the run's list has something to show.
    pub fn show(&self, place: usize, seen: Preliminary) {
        self.benchmarks.live.seen(&self.run, place, seen);
    }
}
