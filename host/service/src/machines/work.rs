//! The work of measuring machines, from asking for a run to handing in its results.

use std::sync::PoisonError;
use std::time::Duration;

use ocb_lab::job::{Found, Results, Step};
use ocb_lab::worker::Seen;
use tokio::time::Instant;

use super::handing::Handing;
use super::sentinel::sentinel_due;
use super::sql::worker;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind};
use crate::blocking::blocking;
use crate::boxed;
use crate::columns::{read_records, read_triangle_tests};
use crate::engine::Engine;
use crate::measure::Preliminary;
use crate::model::{
    AlgorithmResult, Ended, Environment, MachineFacts, MeasuredAlgorithm, NextWork, OutcomeName, Preview, State, Told,
    WorkOrder,
};
use crate::runs::accept::End;
use crate::runs::carry_out::too_long;
use crate::runs::priority::{IDLE, INTERACTIVE};
use crate::runs::sql::RunRow;
use crate::runs::{draw, spec};
use crate::{EngineError, Result};

/// How often a machine that waits for work looks into the queue, unless a run is prepared here.
const LOOK: Duration = Duration::from_secs(1);

impl Engine {
    /// The sentinel, about once an hour, or the next prepared run for this machine, or another kind of work in turn; waits so long for
    /// one. What it had counts as lost: it has ended in the middle of that.
    ///
    /// # Errors
    /// `Busy` when the machine does not measure the same as this service, or not the same as before; `TooMuch` while it rests after
    /// a failure.
    #[boxed]
    pub async fn next_order(&self, machine: &str, facts: &MachineFacts, wait: Duration) -> Result<NextWork> {
        self.admit(machine, facts).await?;
        if !self.inner.config.elsewhere {
            return Err(EngineError::Busy("This service measures by itself; start it with --internal.".into()));
        }
        self.take_back_from(machine).await?;
        if let Some(algorithm) =
            sentinel_due(&self.inner.store, &self.inner.registry, self.inner.config.most_drift, machine, facts).await?
        {
            return Ok(NextWork::Sentinel(Box::new(algorithm)));
        }
        let (asked, worker) = (Instant::now(), worker(machine, &facts.hardware_class));
        let last = self.inner.store.last_kind_of(&worker).await?;
        while !self.inner.work.closing() {
            let prepared = self.inner.work.prepared.notified();
            if let Some(work) = self.next_in_turn(&worker, machine, last).await? {
                return Ok(work);
            }
            let Some(left) = wait.checked_sub(asked.elapsed()) else { break };
            let _ = tokio::time::timeout(left.min(LOOK), prepared).await;
        }
        Ok(NextWork::Nothing)
    }

    /// What is next for a machine, if anything waits: what visitors wait for in their turns, with a check in between, and last what
    /// nobody asked for. All but runs are for machines of the usual class.
    async fn next_in_turn(&self, worker: &Worker, machine: &str, last: Option<Kind>) -> Result<Option<NextWork>> {
        let (store, usual) = (&self.inner.store, self.inner.classes.usual());
        let errands = worker.class == usual;
        let mut kinds = vec![Kind::Measure];
        if errands {
            kinds = store.in_turn(worker, Some(&usual)).await?;
            kinds.insert(if last == Some(Kind::Check) { kinds.len() } else { 0 }, Kind::Check);
        }
        for kind in kinds {
            if kind == Kind::Measure {
                while let Some(attempt) = store.begin_prepared_run(worker, &usual).await? {
                    if let Some(order) = self.begun(machine, &attempt).await? {
                        return Ok(Some(NextWork::Run(Box::new(order))));
                    }
                }
            } else if let Some(errand) = self.next_errand(kind, INTERACTIVE, worker).await? {
                return Ok(Some(NextWork::Errand(Box::new(errand))));
            }
        }
        for kind in [Kind::Stability, Kind::Advise].into_iter().filter(|_| errands) {
            if let Some(errand) = self.next_errand(kind, IDLE, worker).await? {
                return Ok(Some(NextWork::Errand(Box::new(errand))));
            }
        }
        Ok(None)
    }

    /// The order of an attempt; nothing when its run cannot be measured, or not yet.
    async fn begun(&self, machine: &str, attempt: &Attempt) -> Result<Option<WorkOrder>> {
        self.inner.run_events.queue_moved();
        match self.try_begin(attempt).await {
            Ok(order) => Ok(order),
            // It cannot be measured as it was asked for.
            Err(e @ (EngineError::Invalid(_) | EngineError::NotFound(_))) => {
                let row = self.inner.store.run_row(&attempt.job).await?;
                self.inner.run_ends.ended(attempt, &row, &Err(e), None, None).await?;
                Ok(None)
            }
            // It was ended meanwhile.
            Err(EngineError::Busy(_)) => Ok(None),
            // A fault of ours, which may last: the run is not the first in the queue for ever.
            Err(e) => {
                tracing::error!("run {}, attempt {} cannot begin: {e}", attempt.job, attempt.number);
                self.inner.run_ends.lose(attempt, Some(&worker(machine, ""))).await?;
                Err(e)
            }
        }
    }

    async fn try_begin(&self, attempt: &Attempt) -> Result<Option<WorkOrder>> {
        let row = self.inner.store.run_row(&attempt.job).await?;
        let Some(order) = self.inner.orders.order(attempt, &row).await? else {
            self.inner.store.prepare_again(attempt).await?;
            self.inner.work.wake.notify_one();
            return Ok(None);
        };
        self.inner.store.keep_order(&order.attempt, &order).await?;
        // Who follows the run hears that it has begun.
        let (orders, attempt) = (self.inner.orders.clone(), attempt.clone());
        blocking(move || orders.begin(&attempt, &row)).await?;
        Ok(Some(order))
    }

    /// Is this the current attempt of the machine?
    #[boxed]
    pub async fn is_at_work(&self, machine: &str, attempt: &str) -> Result<bool> {
        let there = self.inner.store.attempt_of(machine, attempt).await?.is_some();
        if !there {
            self.inner.orders.forget(attempt);
        }
        Ok(there)
    }

    /// A sign of life of a machine's attempt; false when it has ended here.
    #[boxed]
    pub async fn beat_of(&self, machine: &str, attempt: &str, steps: Vec<Told>) -> Result<bool> {
        let Some(attempt) = self.inner.store.attempt_of(machine, attempt).await? else {
            self.inner.orders.forget(attempt);
            return Ok(false);
        };
        if !self.inner.store.beat(&attempt.id).await? {
            return Ok(false);
        }
        if attempt.kind != Kind::Measure {
            return self.told_of_errand(&attempt, steps).await;
        }
        if self.inner.store.gives_way(&attempt.job, &self.inner.classes.usual()).await? {
            self.put_back_work_of(machine).await?;
            return Ok(false);
        }
        if steps.is_empty() && self.inner.orders.heard(&attempt.id) {
            return Ok(true);
        }
        let row = self.inner.store.run_row(&attempt.job).await?;
        let (orders, live) = (self.inner.orders.clone(), self.inner.live.clone());
        let telling = blocking(move || {
            let working = orders.working(&attempt, &row)?;
            let mut log = working.log.lock().unwrap_or_else(PoisonError::into_inner);
            let reference = spec::reference(&row.spec, &live.registry);
            let name = reference.as_ref().map_or("", |reference| reference.info.name.as_str());
            for step in steps.into_iter().filter_map(told) {
                if let Step::Progress { place, done, total, worked } = step {
                    live.progress(&row.id, place, done, total, worked);
                }
                log.step(&step, name)?;
            }
            Ok(())
        });
        match telling.await {
            // It was ended between the lines.
            Err(EngineError::Busy(_)) => Ok(false),
            told => told.map(|()| true),
        }
    }

    /// Shows what a machine has found so far; false when its attempt has ended here.
    #[boxed]
    pub async fn seen_of(&self, machine: &str, attempt: &str, seen: Seen) -> Result<bool> {
        let Some((attempt, order)) = self.inner.store.order_of(machine, attempt).await? else { return Ok(false) };
        let Seen { place, preliminary: Preliminary { result, records, seconds } } = seen;
        let ordered = order.algorithms.get(place).is_some_and(|it| it.info.id == result.algorithm);
        if !ordered || !records.fits(order.set.configurations) {
            return Err(wrong("a preliminary one is of another algorithm or of other configurations"));
        }
        if !self.inner.orders.heard(&attempt.id) {
            let row = self.inner.store.run_row(&attempt.job).await?;
            let (orders, current) = (self.inner.orders.clone(), attempt.clone());
            blocking(move || orders.working(&current, &row).map(|_| ())).await?;
        }
        // Ranks are given here, at the end.
        let result = AlgorithmResult { preliminary: true, rank: None, place_so_far: None, ..result };
        let seen = Seen { place, preliminary: Preliminary { result, records, seconds } };
        self.inner.store.keep_seen(&attempt, &seen, Some(&self.inner.work.worker)).await?;
        self.inner.live.seen(&order.run, place, seen.preliminary);
        Ok(true)
    }

    /// Takes what a machine hands in; false, and nothing is kept, when its attempt is not the current one.
    #[boxed]
    pub async fn hand_in(&self, machine: &str, attempt: &str, handing: Handing) -> Result<bool> {
        let current = self.inner.store.attempt_of(machine, attempt).await?;
        if let Some(errand) = current.as_ref().filter(|current| current.kind != Kind::Measure) {
            return self.hand_in_errand(machine, errand.clone(), handing).await;
        }
        let Some((current, order)) = self.inner.store.with_order(current).await? else { return Ok(false) };
        let row = self.inner.store.run_row(&current.job).await?;
        match self.take(machine, (&current, &order), &row, handing).await {
            // It was cancelled or deleted while it was taken.
            Err(EngineError::Busy(_) | EngineError::NotFound(_)) if !self.is_at_work(machine, attempt).await? => {
                Ok(false)
            }
            Err(e) => Err(e),
            Ok(accepted) => {
                self.inner.orders.forget(attempt);
                self.inner.run_events.ring(&row.id);
                self.inner.work.prepared.notify_waiters();
                Ok(accepted)
            }
        }
    }

    async fn take(
        &self,
        machine: &str,
        (attempt, order): (&Attempt, &WorkOrder),
        row: &RunRow,
        Handing { ended: how, files }: Handing,
    ) -> Result<bool> {
        let inner = &self.inner;
        match how {
            Ended::Measured { algorithms, .. } if let Some(why) = failure(&algorithms) => {
                self.failed(machine, attempt, row, &why).await
            }
            Ended::Measured { algorithms, environment, preview } => {
                let files = blocking(move || readable(&algorithms, files).map(|files| (algorithms, files)));
                let (algorithms, files) = files.await?;
                let class = inner.store.class_of_attempt(&attempt.id).await?;
                if environment.as_ref().is_some_and(|machine| machine.hardware_class != class) {
                    return Err(wrong("they are of another hardware class"));
                }
                let measured = self.results(row, order, algorithms, (environment, preview), files)?;
                let (orders, results) = (inner.orders.clone(), inner.results.clone());
                let of = (attempt.clone(), row.clone());
                let end = blocking(move || {
                    let working = orders.working(&of.0, &of.1)?;
                    let mut log = working.log.lock().unwrap_or_else(PoisonError::into_inner);
                    results.hand_in(&mut log, &of.1, measured)
                });
                inner.run_ends.ended(attempt, row, &Ok(end.await?), None, None).await
            }
            Ended::TooLong => {
                let (orders, of) = (inner.orders.clone(), (attempt.clone(), row.clone()));
                let closing = blocking(move || {
                    let working = orders.working(&of.0, &of.1)?;
                    working.log.lock().unwrap_or_else(PoisonError::into_inner).end_open(State::Cancelled, None)
                });
                closing.await?;
                let reason = inner.config.ceilings.longest_run(row).map(too_long);
                inner.run_ends.ended(attempt, row, &Ok(End::Stopped), reason.as_deref(), None).await
            }
            Ended::Impossible { message } => {
                let why = Err(EngineError::Invalid(message));
                inner.run_ends.ended(attempt, row, &why, None, None).await
            }
            Ended::PutBack => inner.store.put_back_run(attempt).await,
            Ended::Checked { .. } | Ended::Tried { .. } | Ended::Replayed { .. } | Ended::Advised { .. } => {
                Err(wrong("a run was ordered"))
            }
            Ended::Failed { message } => self.failed(machine, attempt, row, &message).await,
        }
    }

    /// The machine could not measure: it rests, and the run waits for another one, three times at most.
    async fn failed(&self, machine: &str, attempt: &Attempt, row: &RunRow, why: &str) -> Result<bool> {
        tracing::error!("run {}: the machine {machine} failed: {why}", row.id);
        self.inner.store.machine_failed(machine, why).await?;
        Ok(self.inner.run_ends.lose(attempt, Some(&worker(machine, ""))).await?.is_some())
    }

    /// The results of a machine, if they are of what was ordered.
    fn results(
        &self,
        row: &RunRow,
        order: &WorkOrder,
        algorithms: Vec<MeasuredAlgorithm>,
        (environment, preview): (Option<Box<Environment>>, Option<Box<Preview>>),
        files: Vec<[Option<Vec<u8>>; 2]>,
    ) -> Result<Results> {
        if algorithms.len() != order.algorithms.len() {
            return Err(wrong("another number of algorithms"));
        }
        let mut found = Vec::new();
        for ((measured, files), ordered) in algorithms.into_iter().zip(files).zip(&order.algorithms) {
            let MeasuredAlgorithm { result, plugin_sha256, seconds_per_query, .. } = measured;
            if result.algorithm != ordered.info.id || plugin_sha256 != ordered.info.plugin_sha256 {
                return Err(wrong(&format!("{} was not ordered, or was measured from another file", result.algorithm)));
            }
            let [records, triangle_tests] = files;
            found.push(Found { result, records, triangle_tests, plugin_sha256, seconds_per_query });
        }
        let draw = draw::drawn(row, order.draw.seed);
        let environment = environment.map(|environment| Environment { draw: Some(draw), ..*environment });
        Ok(Results { algorithms: found, environment, preview: preview.map(|preview| *preview) })
    }
}

/// Why nothing was measured, if that is the fault of the machine and not of the algorithms.
fn failure(algorithms: &[MeasuredAlgorithm]) -> Option<String> {
    let outcomes = || algorithms.iter().map(|it| &it.result.outcome);
    let ours = outcomes().find(|outcome| outcome.ours || outcome.name == OutcomeName::FileReplaced)?;
    algorithms.iter().all(|it| it.result.n == 0).then(|| ours.message.clone())
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
fn told(step: Told) -> Option<Step> {
    match step {
        Told::Waiting { waiting } => Some(Step::Waiting(waiting)),
        Told::Progress { place, done, total, worked_us } => {
            Some(Step::Progress { place, done, total, worked: Duration::from_micros(worked_us) })
        }
        // Of something else.
        Told::Line { .. } | Told::Loads | Told::Replaying { .. } | Told::Step { .. } => None,
    }
}
