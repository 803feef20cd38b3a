//! What runs under way show, and who hears of it.

use std::sync::Arc;
use std::time::Duration;

use crate::measure::Preliminary;
use crate::plugins::registry::Registry;
use crate::runs::events::RunEvents;
use crate::runs::preliminary::{Shown, UnderWay};
use crate::runs::spec::reference;
use crate::runs::sql::RunRow;
use crate::store::Store;

/// Where runs under way show how far they are and what they have found.
pub struct LiveRuns {
    /// Holds their stages and events.
    pub store: Store,
    /// Knows their algorithms.
    pub registry: Arc<Registry>,
    pub run_events: RunEvents,
    pub under_way: Arc<UnderWay>,
}

impl LiveRuns {
    /// This run is under way now and may show something.
    pub fn show(&self, row: &RunRow) -> Shown {
        // Where the reference is none of the algorithms, it takes turns, too.
        let apart = reference(&row.spec, &self.registry).filter(|apart| !row.spec.algorithms.contains(&apart.info.id));
        let algorithms = row.spec.algorithms.len() + usize::from(apart.is_some());
        self.under_way.begin(&row.id, self.registry.profile(), algorithms, row.expected_seconds)
    }

    /// The algorithm at this place of the run's list is so far in the rounds.
    pub fn progress(&self, run: &str, place: usize, done: u64, total: u64, worked: Duration) {
        self.under_way.estimate(run, |it| it.progress(place, done, total, worked.as_secs_f64()));
    }

    /// It has something to show.
    pub fn seen(&self, run: &str, place: usize, seen: Preliminary) {
        self.under_way.show(run, place, seen);
        self.run_events.ring(run);
    }
}
