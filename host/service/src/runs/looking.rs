//! Preliminary results of a run: which runs have them, and passing them on.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use ocb_core::configuration::ConfigurationSet;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::pairing::Pairing;

use crate::engine::Inner;
use crate::machine::MeasuringRight;
use crate::measure::{self, Part, Preliminary, Stop, Task};
use crate::model::RunSpec;
use crate::runs::draw;
use crate::runs::sql::RunRow;

/// One run while it is looked at.
pub struct Looking<'a> {
    inner: &'a Inner,
    stop: &'a Stop,
    run: String,
    spec: RunSpec,
    algorithms: Vec<Arc<Algorithm>>,
    reference: Option<Arc<Algorithm>>,
    /// Of the processes that look; those that measure have another.
    seed: u64,
    watched: bool,
    looked: AtomicBool,
}

impl<'a> Looking<'a> {
    /// Runs of the suite and of campaigns have no visitor who waits, and a refined run has results already: none of them is shown
    /// early.
    pub fn new(
        inner: &'a Inner,
        stop: &'a Stop,
        row: &RunRow,
        algorithms: Vec<Arc<Algorithm>>,
        reference: Option<Arc<Algorithm>>,
    ) -> Self {
        Self {
            inner,
            stop,
            run: row.id.clone(),
            spec: row.spec.clone(),
            seed: draw::seed(row, "first look", &algorithms),
            algorithms,
            reference,
            watched: !inner.config.elsewhere && row.suite.is_none() && row.campaign.is_none() && !row.is_refined(),
            looked: AtomicBool::new(false),
        }
    }

    /// The run's task on this set, without controls.
    pub fn task<'t>(&'t self, pairing: &'t Pairing, set: &'t ConfigurationSet, part: Part) -> Task<'t> {
        let task = Task::of(&self.spec, (pairing, set, part), &self.algorithms, self.reference.as_ref());
        Task { seed: self.seed, watched: self.watched, ..task }
    }

    /// Where the rest of the set takes long: looks at its beginning. The machine may belong to another process now.
    pub fn at_beginning(&self, pairing: &Pairing, set: &ConfigurationSet, of: u64) {
        let Ok(Some(_right)) = MeasuringRight::try_take() else { return };
        self.inner.under_way.begins_with(set.clone());
        self.look(pairing, set, Part { precision: None, at_most: usize::MAX, of });
    }

    /// Looks, unless that was done.
    pub fn before_the_rounds(&self, pairing: &Pairing, set: &ConfigurationSet, part: Part) {
        if measure::worth_a_look(part.most(set) as u64) {
            self.look(pairing, set, part);
        }
    }

    fn look(&self, pairing: &Pairing, set: &ConfigurationSet, part: Part) {
        if !self.watched || self.looked.swap(true, Ordering::Relaxed) {
            return;
        }
        let task = self.task(pairing, set, part);
        let (runner, machine) = (self.inner.registry.runner(), &self.inner.machine);
        measure::first_look(&task, runner, machine, self.stop, &mut |place, seen| self.show(place, seen));
    }

    /// An algorithm is so far in the rounds.
    pub fn progress(&self, index: usize, done: u64, total: u64, worked: Duration) {
        self.inner.under_way.estimate(|it| it.progress(index, done, total, worked.as_secs_f64()));
    }

    /// The algorithm at this place of the run's list has something to show.
    pub fn show(&self, place: usize, seen: Preliminary) {
        self.inner.under_way.show(place, seen);
        self.inner.run_events.ring(&self.run);
    }
}
