//! The work of measuring machines, from asking for a run to handing in its results.

use std::time::Duration;

use ocb_lab::job::{Found, Results, Step};
use tokio::runtime::Handle;

use super::orders::{draw_of, order};
use super::sql::worker;
use crate::attempts::Attempt;
use crate::attempts::lost::run_was_lost;
use crate::blocking::blocking;
use crate::boxed;
use crate::columns::{read_records, read_triangle_tests};
use crate::engine::Engine;
use crate::model::{Ended, Environment, MachineFacts, MeasuredAlgorithm, Preview, Told, WorkOrder};
use crate::runs::benchmark::End;
use crate::runs::carry_out::{ended, too_long};
use crate::runs::sql::RunRow;
use crate::runs::{hand_in, spec};
use crate::{EngineError, Result};

/// How often a machine that waits for work looks into the queue, unless something new is announced.
const LOOK: Duration = Duration::from_secs(1);

/// How a machine ended an attempt, with the files.
pub struct Handing {
    /// How.
    pub ended: Ended,
    /// Records, then tests per triangle, of each algorithm that has them, in the order of the algorithms.
    pub files: Vec<Vec<u8>>,
}

impl Engine {
    /// The next prepared run for this machine; waits so long for one.
    ///
    /// # Errors
    /// `Busy` when the machine does not measure the same as this service, or not the same as before.
    #[boxed]
    pub async fn next_order(&self, machine: &str, facts: &MachineFacts, wait: Duration) -> Result<Option<WorkOrder>> {
        self.admit(machine, facts).await?;
        if !self.inner.config.elsewhere {
            return Err(EngineError::Busy("This service measures by itself; start it with --internal.".into()));
        }
        let (asked, worker) = (tokio::time::Instant::now(), worker(machine, &facts.hardware_class));
        while !self.inner.closing() {
            if let Some(attempt) = self.inner.store.begin_prepared_run(&worker).await? {
                return self.begun(&attempt).await.map(Some);
            }
            let Some(left) = wait.checked_sub(asked.elapsed()) else { break };
            let _ = tokio::time::timeout(left.min(LOOK), self.inner.wake.notified()).await;
        }
        Ok(None)
    }

    async fn begun(&self, attempt: &Attempt) -> Result<WorkOrder> {
        self.inner.run_events.queue_moved();
        let row = self.inner.run_row(&attempt.job).await?;
        match order(&self.inner, attempt, &row).await {
            Ok(order) => {
                // Who follows the run hears that it has begun.
                let (inner, attempt, handle) = (self.inner.clone(), attempt.clone(), Handle::current());
                blocking(move || inner.orders.log(&inner, &attempt, &row, &handle).map(|_| ())).await?;
                Ok(order)
            }
            Err(e) => {
                // The run cannot be measured as it was asked for, or the service is at fault; either way it does not stay begun.
                ended(&self.inner, attempt, &row, &Err(e), None, None).await?;
                Err(EngineError::Busy("The next run could not be begun; ask again.".into()))
            }
        }
    }

    /// A sign of life of a machine's attempt; false when it has ended here.
    #[boxed]
    pub async fn beat_of(&self, machine: &str, attempt: &str, steps: Vec<Told>) -> Result<bool> {
        let Some(attempt) = self.inner.store.attempt_of(machine, attempt).await? else { return Ok(false) };
        if !self.inner.store.beat(&attempt.id).await? {
            return Ok(false);
        }
        if !steps.is_empty() {
            let row = self.inner.run_row(&attempt.job).await?;
            let (inner, handle) = (self.inner.clone(), Handle::current());
            let told = blocking(move || {
                let log = inner.orders.log(&inner, &attempt, &row, &handle)?;
                let mut log = log.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                let reference = spec::reference(&row.spec, &inner.registry);
                let name = reference.as_ref().map_or("", |reference| reference.info.name.as_str());
                steps.into_iter().try_for_each(|step| hand_in::tell(&mut log, &told(step), name))
            });
            // It may have been ended between the lines.
            return match told.await {
                Err(EngineError::Busy(_)) => Ok(false),
                told => told.map(|()| true),
            };
        }
        Ok(true)
    }

    /// Takes what a machine hands in; false, and nothing is kept, when its attempt is not the current one.
    #[boxed]
    pub async fn hand_in(&self, machine: &str, attempt: &str, handing: Handing) -> Result<bool> {
        let inner = &self.inner;
        let Some(attempt) = inner.store.attempt_of(machine, attempt).await? else { return Ok(false) };
        let row = inner.run_row(&attempt.job).await?;
        let Handing { ended: how, files } = handing;
        let accepted = match how {
            Ended::Measured { algorithms, environment, preview } => {
                let files = blocking(move || readable(&algorithms, files).map(|files| (algorithms, files)));
                let (algorithms, files) = files.await?;
                let results = self.results(&row, algorithms, (environment, preview), files)?;
                let (inner, of, handle) = (self.inner.clone(), (attempt.clone(), row.clone()), Handle::current());
                let end = blocking(move || {
                    let log = inner.orders.log(&inner, &of.0, &of.1, &handle)?;
                    let mut log = log.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    hand_in::keep(&inner, &mut log, &of.1, results)
                })
                .await?;
                ended(&self.inner, &attempt, &row, &Ok(end), None, None).await?
            }
            Ended::TooLong => {
                let reason = inner.longest_run(&row).map(too_long);
                ended(inner, &attempt, &row, &Ok(End::Stopped), reason.as_deref(), None).await?
            }
            Ended::PutBack => inner.store.put_back_run(&attempt).await?,
            Ended::Failed { message } => {
                tracing::error!("run {}: the machine {machine} failed: {message}", row.id);
                let state = inner.store.lose_run(&attempt, Some(&worker(machine, ""))).await?;
                if let Some(state) = state {
                    run_was_lost(inner, &row.id, state).await?;
                }
                state.is_some()
            }
        };
        inner.orders.forget(&attempt.id);
        inner.run_events.ring(&row.id);
        inner.wake.notify_one();
        Ok(accepted)
    }

    /// The results of a machine, if they are of what was ordered.
    fn results(
        &self,
        row: &RunRow,
        algorithms: Vec<MeasuredAlgorithm>,
        (environment, preview): (Option<Box<Environment>>, Option<Box<Preview>>),
        files: Vec<[Option<Vec<u8>>; 2]>,
    ) -> Result<Results> {
        let ordered = self.inner.algorithms_of(row)?;
        if algorithms.len() != ordered.len() {
            return Err(wrong("another number of algorithms"));
        }
        let mut found = Vec::new();
        for ((measured, files), ordered) in algorithms.into_iter().zip(files).zip(ordered) {
            let MeasuredAlgorithm { result, plugin_sha256, seconds_per_query, .. } = measured;
            if result.algorithm != ordered.info.id || plugin_sha256 != ordered.info.plugin_sha256 {
                return Err(wrong(&format!("{} was not ordered, or was measured from another file", result.algorithm)));
            }
            let [records, triangle_tests] = files;
            found.push(Found { result, records, triangle_tests, plugin_sha256, seconds_per_query });
        }
        if environment.as_ref().is_some_and(|machine| machine.hardware_class != self.inner.hardware_class()) {
            return Err(wrong("they are of another hardware class"));
        }
        let draw = draw_of(&self.inner, row)?;
        let environment = environment.map(|environment| Environment { draw: Some(draw), ..*environment });
        Ok(Results { algorithms: found, environment, preview: preview.map(|preview| *preview) })
    }
}

fn wrong(what: &str) -> EngineError {
    EngineError::Invalid(format!("These results are not those of the run: {what}."))
}

/// The files of each algorithm, records and tests per triangle, if they are there and can be read.
fn readable(algorithms: &[MeasuredAlgorithm], files: Vec<Vec<u8>>) -> Result<Vec<[Option<Vec<u8>>; 2]>> {
    let mut files = files.into_iter();
    let mut next = |there: bool| there.then(|| files.next().ok_or_else(|| wrong("a file is missing"))).transpose();
    let mut found = Vec::new();
    for measured in algorithms {
        let (records, tests) = (next(measured.records)?, next(measured.triangle_tests)?);
        let read = records.as_deref().map(read_records).transpose().map(|_| ());
        let counted = tests.as_deref().map(read_triangle_tests).transpose().map(|_| ());
        if let Err(e) = read.and(counted) {
            return Err(wrong(&format!("a file of {} cannot be read ({e})", measured.result.algorithm)));
        }
        found.push([records, tests]);
    }
    if files.next().is_some() {
        return Err(wrong("there is a file too many"));
    }
    Ok(found)
}

/// A step as the run's log takes it.
fn told(step: Told) -> Step {
    match step {
        Told::Waiting { waiting } => Step::Waiting(waiting),
        Told::Progress { place, done, total, worked_us } => {
            Step::Progress { place, done, total, worked: Duration::from_micros(worked_us) }
        }
    }
}
