//! Carrying out an attempt at a run: on a thread of its own, in its time, with a record of its end.

use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;

use crate::attempts::Attempt;
use crate::engine::Inner;
use crate::measure::Stop;
use crate::runs::accept::End;
use crate::runs::benchmark;
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
    let shown = inner.live.show(&row);
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
        return inner.run_ends.failed_here(attempt, &e).await;
    }
    inner.run_ends.ended(attempt, &row, &how, stop.reason().as_deref(), Some(shown)).await.map(|_| ())
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

/// Why a run that took too long was stopped.
pub fn too_long(longest: Duration) -> String {
    format!(
        "Stopped after {} minutes, the time limit for guests. Ask for fewer configurations or algorithms, or log in.",
        longest.as_secs().div_ceil(60)
    )
}
