//! Carrying out an attempt at a run: on a thread of its own, in its time, with a record of its end.

use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;

use crate::attempts::Attempt;
use crate::attempts::lost::run_was_lost;
use crate::engine::Inner;
use crate::measure::Stop;
use crate::model::State;
use crate::runs::accept::{End, RunEnd};
use crate::runs::benchmark;
use crate::runs::looking::show;
use crate::runs::preliminary::Shown;
use crate::runs::sql::RunRow;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

/// After a fault of the database.
pub const BACK_OFF: Duration = Duration::from_secs(2);

/// Carries out an attempt at a run; idle work gives way when more is asked for than was.
pub async fn carry_out(inner: &Arc<Inner>, attempt: &Attempt, idle: Option<u64>) -> Result<()> {
    let (id, stop) = (attempt.job.as_str(), Stop::default());
    let _held = inner.work.begin(attempt, &stop, idle);
    inner.run_events.queue_moved();
    let row = inner.store.run_row(id).await?;
    let shown = show(&inner.under_way, &inner.registry, &row);
    let how = match run_in_time(inner, attempt, &row, &stop).await {
        // Whoever stopped it need not wait for another attempt.
        Err(EngineError::Fault(_)) if stop.asked() => Ok(End::Stopped),
        how => how,
    };
    inner.work.unset_current();
    if let (Ok(End::Stopped), true) = (&how, inner.work.closing() || stop.for_now()) {
        if inner.store.put_back_run(attempt).await? {
            inner.run_events.ring(id);
        }
        return Ok(());
    }
    if let Err(e @ EngineError::Fault(_)) = how {
        drop(shown);
        return failed_here(inner, attempt, &e).await;
    }
    ended(inner, attempt, &row, &how, stop.reason().as_deref(), Some(shown)).await.map(|_| ())
}

/// The service could not carry out a run: its database was away, its disk is full. The run waits again, and has failed after three
/// such attempts. While the database is away, this is tried again: the run would count as running until the next start.
async fn failed_here(inner: &Arc<Inner>, attempt: &Attempt, fault: &EngineError) -> Result<()> {
    tracing::error!("run {}, attempt {}: {fault}", attempt.job, attempt.number);
    loop {
        tokio::time::sleep(BACK_OFF).await;
        match inner.store.lose_run(attempt, Some(&inner.work.worker)).await {
            Ok(Some(state)) => return run_was_lost(&inner.campaigns, &attempt.job, state).await,
            Ok(None) => return Ok(()),
            Err(e) if inner.work.closing() => return Err(e),
            Err(e) => tracing::error!("the end of run {} cannot be recorded: {e}", attempt.job),
        }
    }
}

/// Records how an attempt at a run ended, here or on a measuring machine; false when it was not the current one, and then nothing
/// of it is kept.
pub async fn ended(
    inner: &Inner,
    attempt: &Attempt,
    row: &RunRow,
    how: &Result<End>,
    reason: Option<&str>,
    shown: Option<Shown>,
) -> Result<bool> {
    if let Ok(End::Prepared) = how {
        let prepared = inner.store.run_is_prepared(attempt).await?;
        inner.run_events.ring(&row.id);
        inner.orders.prepared.notify_waiters();
        return Ok(prepared);
    }
    let accepted = accept(inner, attempt, row, how, reason).await?;
    drop(shown);
    if !accepted {
        tracing::warn!("run {}: the result of attempt {} comes too late and is not kept", row.id, attempt.number);
        return Ok(false);
    }
    inner.run_events.ring(&row.id);
    if let Err(e) = inner.campaigns.run_of_campaign_ended(&row.id).await {
        tracing::error!("run {}: its end could not be recorded in its campaign: {e}", row.id);
    }
    inner.run_events.queue_moved();
    Ok(true)
}

/// Runs the benchmark on a thread of its own, and stops it when its time limit is over.
async fn run_in_time(inner: &Arc<Inner>, attempt: &Attempt, row: &RunRow, stop: &Stop) -> Result<End> {
    let (sender, ended) = tokio::sync::oneshot::channel();
    let (for_run, for_attempt, for_stop, handle) = (inner.clone(), attempt.clone(), stop.clone(), Handle::current());
    let thread = std::thread::Builder::new().name("run".into()).spawn(move || {
        let _ = sender.send(benchmark::run(&for_run, &for_attempt, &for_stop, &handle));
    });
    thread.map_err(|e| EngineError::fault("Starting the run's thread failed", e))?;
    let limit = inner.config.ceilings.longest_run(row).map(|longest| (longest, too_long(longest)));
    // The sender is dropped without a word only when the thread panicked.
    in_time(ended, stop, limit).await.unwrap_or_else(|_| Err(EngineError::Fault("The run failed; see the log.".into())))
}

/// Hands in how the run ended; false when this is not the current attempt any more. Without this record the run would count as
/// running until the next start, so a database error is retried.
async fn accept(
    inner: &Inner,
    attempt: &Attempt,
    row: &RunRow,
    ended: &Result<End>,
    reason: Option<&str>,
) -> Result<bool> {
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
        match inner.store.accept_run(attempt, RunEnd { state, message: message.as_deref(), handed }).await {
            Ok(accepted) => return Ok(accepted),
            Err(e) if inner.work.closing() => return Err(e),
            Err(e) => tracing::error!("the end of run {} cannot be recorded: {e}", row.id),
        }
        tokio::time::sleep(BACK_OFF).await;
    }
}

/// Why a run that took too long was stopped.
pub fn too_long(longest: Duration) -> String {
    format!(
        "Stopped after {} minutes, the time limit for guests. Ask for fewer configurations or algorithms, or log in.",
        longest.as_secs().div_ceil(60)
    )
}
