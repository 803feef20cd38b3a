//! Carrying out a claimed run: on a thread of its own, in its time, with a record of its end.

use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;

use crate::engine::Inner;
use crate::measure::Stop;
use crate::model::State;
use crate::runs::benchmark;
use crate::runs::benchmark::End;
use crate::runs::log::plain_event;
use crate::{EngineError, Result};

/// After a fault of the database.
pub const BACK_OFF: Duration = Duration::from_secs(2);

/// Carries out a claimed run; idle work gives way when more is asked for than was.
pub async fn carry_out(inner: &Arc<Inner>, id: &str, idle: Option<u64>) -> Result<()> {
    let stop = Stop::default();
    match idle {
        Some(asked) => inner.set_current_idle(id, &stop, asked),
        None => inner.set_current(id, &stop),
    }
    // A shutdown that came between the claim and this line found nothing to stop; it is noticed here.
    if inner.closing() {
        stop.stop();
    }
    inner.run_events.queue_moved();
    let ended = run_in_time(inner, id, &stop).await;
    inner.unset_current();
    let (state, message) = match ended {
        Ok(End::Done) => (State::Done, None),
        Ok(End::Stopped) if inner.closing() || stop.for_now() => {
            inner.store.put_back(id).await?;
            return inner.run_events.tell(&inner.store, id, plain_event(State::Queued, 0)).await;
        }
        Ok(End::Stopped) => (State::Cancelled, stop.reason()),
        Err(e) => {
            tracing::warn!("run {id} failed: {e}");
            (State::Failed, Some(e.to_string()))
        }
    };
    // Without this record the run would count as running until the next start, so a database error is retried.
    while let Err(e) = note_end(inner, id, state, message.as_deref()).await {
        tracing::error!("the end of run {id} cannot be recorded: {e}");
        if inner.closing() {
            return Err(e);
        }
        tokio::time::sleep(BACK_OFF).await;
    }
    if let Err(e) = inner.run_of_campaign_ended(id).await {
        tracing::error!("run {id}: its end could not be recorded in its campaign: {e}");
    }
    inner.run_events.queue_moved();
    Ok(())
}

/// Runs the benchmark on a thread of its own, and stops it when its time limit is over.
async fn run_in_time(inner: &Arc<Inner>, id: &str, stop: &Stop) -> Result<End> {
    let longest = inner.longest_run(&inner.run_row(id).await?);
    let (sender, mut ended) = tokio::sync::oneshot::channel();
    let (for_run, for_id, for_stop, handle) = (inner.clone(), id.to_owned(), stop.clone(), Handle::current());
    let thread = std::thread::Builder::new().name("run".into()).spawn(move || {
        let _ = sender.send(benchmark::run(&for_run, &for_id, &for_stop, &handle));
    });
    thread.map_err(|e| EngineError::fault("Starting the run's thread failed", e))?;
    let in_time = match longest {
        Some(longest) => tokio::time::timeout(longest, &mut ended).await.map_err(|_| longest),
        None => Ok((&mut ended).await),
    };
    let ended = match in_time {
        Ok(ended) => ended,
        Err(longest) => {
            stop.stop_because(Some(too_long(longest)));
            ended.await
        }
    };
    // The sender is dropped without a word only when the thread panicked.
    ended.unwrap_or_else(|_| Err(EngineError::Fault("The run failed; see the log.".into())))
}

async fn note_end(inner: &Inner, id: &str, state: State, message: Option<&str>) -> Result<()> {
    let row = match inner.run_row(id).await {
        // Deleted meanwhile: there is nothing left to record.
        Err(EngineError::NotFound(_)) => return Ok(()),
        row => row?,
    };
    let state = row.after(state);
    inner.store.end_run(id, State::Running, state, message).await?;
    inner.run_events.tell(&inner.store, id, plain_event(state, 0)).await
}

fn too_long(longest: Duration) -> String {
    format!(
        "Stopped after {} minutes, the time limit for guests. Ask for fewer configurations or algorithms, or log in.",
        longest.as_secs().div_ceil(60)
    )
}
