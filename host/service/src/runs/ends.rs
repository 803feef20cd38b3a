//! Recording how attempts at runs end, wherever they were measured.

use std::sync::Arc;

use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, BACK_OFF};
use crate::campaigns::course::Campaigns;
use crate::model::State;
use crate::runs::accept::{End, RunEnd};
use crate::runs::current::Work;
use crate::runs::events::RunEvents;
use crate::runs::preliminary::Shown;
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::{EngineError, Result};

/// Where the end of a run is recorded, and who hears of it.
pub struct RunEnds {
    pub store: Store,
    pub run_events: RunEvents,
    pub campaigns: Arc<Campaigns>,
    pub work: Arc<Work>,
}

impl RunEnds {
    /// Records how an attempt at a run ended, here or on a measuring machine; false when it was not the current one, and then
    /// nothing of it is kept.
    pub async fn ended(
        &self,
        attempt: &Attempt,
        row: &RunRow,
        how: &Result<End>,
        reason: Option<&str>,
        shown: Option<Shown>,
    ) -> Result<bool> {
        if let Ok(End::Prepared) = how {
            let prepared = self.store.run_is_prepared(attempt).await?;
            self.run_events.ring(&row.id);
            self.work.prepared.notify_waiters();
            return Ok(prepared);
        }
        let accepted = self.accept(attempt, row, how, reason).await?;
        drop(shown);
        if !accepted {
            tracing::warn!("run {}: the result of attempt {} comes too late and is not kept", row.id, attempt.number);
            return Ok(false);
        }
        self.run_events.ring(&row.id);
        if let Err(e) = self.campaigns.run_of_campaign_ended(&row.id).await {
            tracing::error!("run {}: its end could not be recorded in its campaign: {e}", row.id);
        }
        self.run_events.queue_moved();
        Ok(true)
    }

    /// Hands in how the run ended; false when this is not the current attempt any more. Without this record the run would count as
    /// running until the next start, so a database error is retried.
    async fn accept(&self, attempt: &Attempt, row: &RunRow, ended: &Result<End>, reason: Option<&str>) -> Result<bool> {
        let (state, message, handed) = match ended {
            Ok(End::Done { handed, .. }) => {
                let state = if handed.failed.is_some() { State::Failed } else { State::Done };
                (state, handed.failed.clone(), Some(&**handed))
            }
            Ok(End::Prepared | End::Stopped) => (row.after(State::Cancelled), reason.map(str::to_owned), None),
            Err(e) => {
                tracing::warn!("run {} failed: {e}", row.id);
                (row.after(State::Failed), Some(e.to_string()), None)
            }
        };
        loop {
            match self.store.accept_run(attempt, RunEnd { state, message: message.as_deref(), handed }).await {
                Ok(accepted) => return Ok(accepted),
                Err(e) if self.work.closing() => return Err(e),
                Err(e) => tracing::error!("the end of run {} cannot be recorded: {e}", row.id),
            }
            tokio::time::sleep(BACK_OFF).await;
        }
    }

    /// The service could not carry out a run: its database was away, its disk is full. The run waits again, and has failed after
    /// three such attempts. While the database is away, this is tried again: the run would count as running until the next start.
    pub async fn failed_here(&self, attempt: &Attempt, fault: &EngineError) -> Result<()> {
        tracing::error!("run {}, attempt {}: {fault}", attempt.job, attempt.number);
        loop {
            tokio::time::sleep(BACK_OFF).await;
            match self.store.lose_run(attempt, Some(&self.work.worker)).await {
                Ok(Some(state)) => return self.was_lost(&attempt.job, state).await,
                Ok(None) => return Ok(()),
                Err(e) if self.work.closing() => return Err(e),
                Err(e) => tracing::error!("the end of run {} cannot be recorded: {e}", attempt.job),
            }
        }
    }

    /// The attempt came to nothing, as all of a worker that is given up: its run waits again, or has failed after three. What it is
    /// now, if the attempt was lost.
    pub async fn lose(&self, attempt: &Attempt, given_up: Option<&Worker>) -> Result<Option<State>> {
        let state = self.store.lose_run(attempt, given_up).await?;
        if let Some(state) = state {
            self.was_lost(&attempt.job, state).await?;
        }
        Ok(state)
    }

    /// What follows from a lost attempt at a run.
    async fn was_lost(&self, run: &str, now: State) -> Result<()> {
        self.run_events.ring(run);
        self.run_events.queue_moved();
        if now == State::Queued { Ok(()) } else { self.campaigns.run_of_campaign_ended(run).await }
    }
}
