//! Stability runs at work: one part at a time, so that runs and checks come between, and a restart goes on behind the last part.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use ocb_lab::LabError;
use ocb_lab::algorithm::Algorithm;
use ocb_lab::stability;

use super::runs::selection;
use super::runs_sql::StabilityRow;
use crate::attempts::{Attempt, MOST_LOST};
use crate::config::Ceilings;
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::{AlgorithmInfo, Stability, State};
use crate::plugins::registry::Registry;
use crate::quotas::time;
use crate::runs::current::Work;
use crate::runs::priority::{IDLE, INTERACTIVE};
use crate::store::Store;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

/// The stability runs that wait, and what carries them out.
pub struct StabilityRuns {
    pub store: Store,
    pub registry: Arc<Registry>,
    pub work: Arc<Work>,
    pub machine: Machine,
    pub ceilings: Ceilings,
}

impl StabilityRuns {
    /// Tries the next part of the run whose turn it is; false when none waits. Idle work gives way to any request after so many.
    pub async fn next(&self, idle: Option<u64>) -> Result<bool> {
        let tried = self.try_next(idle).await;
        self.work.unset_current();
        tried
    }

    async fn try_next(&self, idle: Option<u64>) -> Result<bool> {
        let priority = if idle.is_some() { IDLE } else { INTERACTIVE };
        let begun = self.store.begin_part(priority, &self.work.worker).await?;
        let Some((attempt, row)) = begun else { return Ok(false) };
        if row.attempts > MOST_LOST {
            let message = format!(
                "This run failed {MOST_LOST} times in the same part and is not tried again; the service's log says why."
            );
            self.store.give_up_part(&attempt, State::Failed, Some(&message)).await?;
            return Ok(true);
        }
        let stop = Stop::default();
        let _held = self.work.begin(&attempt, &stop, idle);
        // Who ended it between the beginning and the line above found nothing to stop.
        let open = self.store.stability_run(&row.id).await?.is_some_and(|now| now.state == State::Running);
        if !open {
            stop.stop();
        }
        match self.part_in_time(&attempt, &row, &stop).await {
            Ok(()) => {}
            // Its time is over.
            Err(LabError::Stopped) if stop.reason().is_some() => {
                self.store.give_up_part(&attempt, State::Cancelled, stop.reason().as_deref()).await?;
            }
            Err(LabError::Stopped) => self.store.put_back_part(&attempt).await?,
            // Ours: the part is tried again, after the dispatcher has waited a little.
            Err(e @ LabError::Fault(_)) => {
                self.store.lose_part(&attempt).await?;
                return Err(e.into());
            }
            Err(e) => {
                tracing::warn!("stability run {}: {e}", row.id);
                let message = EngineError::from(e).for_visitors().to_string();
                self.store.give_up_part(&attempt, State::Failed, Some(&message)).await?;
            }
        }
        Ok(true)
    }

    /// Tries a part, and stops it when the time of its run is over.
    async fn part_in_time(
        &self,
        attempt: &Attempt,
        row: &StabilityRow,
        stop: &Stop,
    ) -> std::result::Result<(), LabError> {
        let limit = self.ceilings.longest_of(row.owner.as_deref()).map(|longest| {
            let reason = format!(
                "Stopped after {}, the time limit for guests. Choose fewer tests or seeds, or log in.",
                time(longest.as_secs_f64())
            );
            (longest.saturating_sub(Duration::from_secs_f64(row.spent_seconds)), reason)
        });
        in_time(self.one_part(attempt, row, stop), stop, limit).await
    }

    async fn one_part(&self, attempt: &Attempt, row: &StabilityRow, stop: &Stop) -> std::result::Result<(), LabError> {
        let fault = |e: EngineError| LabError::Fault(e.to_string());
        let algorithm = self
            .registry
            .named(&row.spec.algorithm, row.owner.as_deref())
            .map_err(|e| LabError::Invalid(e.to_string()))?;
        let selection = selection(&row.spec);
        let kept = self.store.stability_found(&row.id).await.map_err(fault)?;
        // What another file found is no part of this result.
        let kept = kept.filter(|found| found.plugin_sha256 == algorithm.info.plugin_sha256);
        let mut done = if kept.is_some() { row.done.clone() } else { Vec::new() };
        let mut found = kept.unwrap_or_else(|| stability::begin(&algorithm, &selection));
        let parts = stability::parts(&selection);
        if let Some(part) = parts.iter().find(|part| done.iter().all(|done| done != *part)) {
            found = self.tried(&algorithm, row, part, found, stop).await?;
            done.push((*part).to_owned());
        }
        found.complete = done.len() == parts.len();
        let seconds = row.spent_seconds + stop.worked().as_secs_f64();
        if self.store.accept_part(attempt, &done, &found, seconds).await.map_err(fault)? {
            publish(&self.store, &self.registry, row, &algorithm, &found).await.map_err(fault)?;
        }
        Ok(())
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
        let (algorithm, stop, selection) = (algorithm.clone(), stop.clone(), selection(&row.spec));
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
