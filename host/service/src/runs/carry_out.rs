//! Carrying out an attempt at a run: on a thread of its own, in its time, with a record of its end.

use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;

use crate::attempts::Attempt;
use crate::measure::Stop;
use crate::runs::accept::End;
use crate::runs::benchmark;
use crate::runs::benchmarks::Benchmarks;
use crate::runs::sql::RunRow;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

impl Benchmarks {
    /// Carries out an attempt at a run; idle work gives way to any request after so many.
    pub async fn carry_out(self: &Arc<Self>, attempt: &Attempt, idle: Option<u64>) -> Result<()> {
        let (id, stop) = (attempt.job.as_str(), Stop::default());
        let _held = self.work.begin(attempt, &stop, idle);
        self.live.run_events.queue_moved();
        let row = self.store.run_row(id).await?;
        let shown = self.live.show(&row);
        let how = match self.run_in_time(attempt, &row, &stop).await {
            // Whoever stopped it need not wait for another attempt.
            Err(EngineError::Fault(_)) if stop.asked() => Ok(End::Stopped),
            how => how,
        };
        self.work.unset_current();
        if let (Ok(End::Stopped), true) = (&how, self.work.closing() || stop.for_now()) {
            if self.store.put_back_run(attempt).await? {
                self.live.run_events.ring(id);
            }
            return Ok(());
        }
        if let Err(e @ EngineError::Fault(_)) = how {
            drop(shown);
            return self.run_ends.failed_here(attempt, &e).await;
        }
        self.run_ends.ended(attempt, &row, &how, stop.reason().as_deref(), Some(shown)).await.map(|_| ())
    }

    /// Runs the benchmark on a thread of its own, and stops it when its time limit is over.
    async fn run_in_time(self: &Arc<Self>, attempt: &Attempt, row: &RunRow, stop: &Stop) -> Result<End> {
        let (sender, ended) = tokio::sync::oneshot::channel();
        let (benchmarks, handle) = (self.clone(), Handle::current());
        let (for_attempt, for_stop) = (attempt.clone(), stop.clone());
        let thread = std::thread::Builder::new().name("run".into()).spawn(move || {
            let _ = sender.send(benchmark::run(&benchmarks, &for_attempt, &for_stop, &handle));
        });
        thread.map_err(|e| EngineError::fault("Starting the run's thread failed", e))?;
        let limit = self.ceilings.longest_run(row).map(|longest| (longest, too_long(longest)));
        // The sender is dropped without a word only when the thread panicked.
        in_time(ended, stop, limit)
            .await
            .unwrap_or_else(|_| Err(EngineError::Fault("The run failed; see the log.".into())))
    }
}

/// Why a run that took too long was stopped.
pub fn too_long(longest: Duration) -> String {
    format!(
        "Stopped after {} minutes, the time limit for guests. Ask for fewer configurations or algorithms, or log in.",
        longest.as_secs().div_ceil(60)
    )
}
