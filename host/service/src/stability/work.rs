//! Stability runs at work: one part at a time, so that runs and checks come between, and a restart goes on behind the last part.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use ocb_lab::LabError;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::stability::{self, Selection};

use super::runs_sql::StabilityRow;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, MOST_LOST};
use crate::config::Ceilings;
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::{AlgorithmInfo, Stability, State};
use crate::plugins::registry::Registry;
use crate::runs::current::Work;
use crate::runs::priority::{IDLE, INTERACTIVE};
use crate::store::Store;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

/// What is to be tried next.
pub(super) struct Next {
    pub algorithm: Arc<Algorithm>,
    /// Nothing when all parts are done.
    pub part: Option<&'static str>,
    /// The parts before it.
    pub done: Vec<String>,
    /// What these have found.
    pub found: Stability,
}

/// The stability runs that wait, and what carries them out.
pub struct StabilityRuns {
    pub store: Store,
    pub registry: Arc<Registry>,
    pub work: Arc<Work>,
    pub machine: Machine,
    pub ceilings: Ceilings,
    /// Measuring machines do it.
    pub elsewhere: bool,
}

impl StabilityRuns {
    /// Tries the next part of the run whose turn it is; false when none waits here. Idle work gives way to any request after so many.
    pub async fn next(&self, idle: Option<u64>) -> Result<bool> {
        if self.elsewhere {
            return Ok(false);
        }
        let tried = self.try_next(idle).await;
        self.work.unset_current();
        tried
    }

    async fn try_next(&self, idle: Option<u64>) -> Result<bool> {
        let priority = if idle.is_some() { IDLE } else { INTERACTIVE };
        let Some((attempt, row)) = self.begin(priority, &self.work.worker).await? else { return Ok(false) };
        let stop = Stop::default();
        let _held = self.work.begin(&attempt, &stop, idle);
        // Who ended it between the beginning and the line above found nothing to stop.
        let open = self.store.stability_run(&row.id).await?.is_some_and(|now| now.state == State::Running);
        if !open {
            stop.stop();
        }
        let how = in_time(self.one_part(&attempt, &row, &stop), &stop, self.limit(&row)).await;
        self.settle(&attempt, &row, how, stop.reason().as_deref()).await?;
        Ok(true)
    }

    /// Begins the next part for a worker. A run whose part was lost too often is given up.
    pub(super) async fn begin(&self, priority: i64, worker: &Worker) -> Result<Option<(Attempt, StabilityRow)>> {
        while let Some((attempt, row)) = self.store.begin_part(priority, worker).await? {
            if row.attempts <= MOST_LOST {
                return Ok(Some((attempt, row)));
            }
            let message = format!(
                "This run failed {MOST_LOST} times in the same part and is not tried again; the service's log says why."
            );
            self.store.give_up_part(&attempt, State::Failed, Some(&message)).await?;
        }
        Ok(None)
    }

    /// Notes how an attempt at a part ended; the reason is that for which it was stopped.
    pub(super) async fn settle(
        &self,
        attempt: &Attempt,
        row: &StabilityRow,
        how: std::result::Result<(), LabError>,
        reason: Option<&str>,
    ) -> Result<()> {
        match how {
            Ok(()) => Ok(()),
            // Its time is over.
            Err(LabError::Stopped) if reason.is_some() => {
                self.store.give_up_part(attempt, State::Cancelled, reason).await.map(|_| ())
            }
            Err(LabError::Stopped) => self.store.put_back_part(attempt).await,
            // Ours: the part is tried again, after the dispatcher has waited a little.
            Err(e @ LabError::Fault(_)) => {
                self.store.lose_part(attempt).await?;
                Err(e.into())
            }
            Err(e) => {
                tracing::warn!("stability run {}: {e}", row.id);
                let message = EngineError::from(e).for_visitors().to_string();
                self.store.give_up_part(attempt, State::Failed, Some(&message)).await.map(|_| ())
            }
        }
    }

    /// What is left of the time of a run, and what its owner is told when it is over.
    pub(super) fn limit(&self, row: &StabilityRow) -> Option<(Duration, String)> {
        let advice = "Choose fewer tests or seeds, or log in.";
        let (longest, reason) = self.ceilings.limit_of(row.owner.as_deref(), advice)?;
        Some((longest.saturating_sub(Duration::from_secs_f64(row.spent_seconds)), reason))
    }

    async fn one_part(&self, attempt: &Attempt, row: &StabilityRow, stop: &Stop) -> std::result::Result<(), LabError> {
        let mut next = self.next_part(row).await?;
        if let Some(part) = next.part {
            next.found = self.tried(&next.algorithm, row, part, next.found, stop).await?;
        }
        let accepted = self.accept(attempt, row, next, stop.worked().as_secs_f64()).await;
        accepted.map(|_| ()).map_err(|e| LabError::Fault(e.to_string()))
    }

    /// What is to be tried next, and on what.
    pub(super) async fn next_part(&self, row: &StabilityRow) -> std::result::Result<Next, LabError> {
        let algorithm = self
            .registry
            .named(&row.spec.algorithm, row.owner.as_deref())
            .map_err(|e| LabError::Invalid(e.to_string()))?;
        let selection = Selection::of(&row.spec);
        let kept = self.store.stability_found(&row.id).await.map_err(|e| LabError::Fault(e.to_string()))?;
        // What another file found is no part of this result.
        let kept = kept.filter(|found| found.plugin_sha256 == algorithm.info.plugin_sha256);
        let done = if kept.is_some() { row.done.clone() } else { Vec::new() };
        let part = stability::parts(&selection).into_iter().find(|part| done.iter().all(|done| done != part));
        let found = kept.unwrap_or_else(|| stability::begin(&algorithm, &selection));
        Ok(Next { algorithm, part, done, found })
    }

    /// Keeps what was found with this part, in so many seconds; false when the attempt is not the current one.
    pub(super) async fn accept(
        &self,
        attempt: &Attempt,
        row: &StabilityRow,
        tried: Next,
        seconds: f64,
    ) -> Result<bool> {
        let Next { algorithm, part, mut done, mut found } = tried;
        done.extend(part.map(str::to_owned));
        found.complete = done.len() == stability::parts(&Selection::of(&row.spec)).len();
        let Some(ended) = self.store.accept_part(attempt, &done, &found, row.spent_seconds + seconds).await? else {
            return Ok(false);
        };
        if ended {
            publish(&self.store, &self.registry, row, &algorithm, &found).await?;
        }
        Ok(true)
    }

    /// Tries a part on a thread of its own: a jail ends with the thread that started it.
    async fn tried(
        &self,
        algorithm: &Arc<Algorithm>,
        row: &StabilityRow,
        part: &'static str,
        mut found: Stability,
        stop: &Stop,
    ) -> std::result::Result<Stability, LabError> {
        let (registry, machine) = (self.registry.clone(), self.machine.clone());
        let (algorithm, stop, selection) = (algorithm.clone(), stop.clone(), Selection::of(&row.spec));
        let (sender, ended) = tokio::sync::oneshot::channel();
        let work = move || {
            let _right = stop.right_to_measure(|| {})?.ok_or(LabError::Stopped)?;
            stability::part(registry.runner(), &machine, &algorithm, &selection, part, &mut found, &stop)?;
            Ok(found)
        };
        let thread = thread::Builder::new().name("stability".into()).spawn(move || drop(sender.send(work())));
        thread.map_err(|e| LabError::fault("Starting the stability run's thread failed", e))?;
        ended.await.unwrap_or_else(|_| Err(LabError::Fault("The stability run failed; see the log.".into())))
    }
}

/// A whole run of a public algorithm as it is usually used takes its place in the table that everybody sees.
async fn publish(
    store: &Store,
    registry: &Registry,
    row: &StabilityRow,
    algorithm: &Algorithm,
    found: &Stability,
) -> Result<()> {
    let usual = row.spec.parts.is_empty() && row.spec.seeds.is_none() && algorithm.settings.is_empty();
    let named = |info: &AlgorithmInfo| (&info.id, &info.plugin_sha256) == (&found.algorithm, &found.plugin_sha256);
    let public = registry.public().iter().any(named);
    if usual && public { store.keep_stability(found).await } else { Ok(()) }
}
