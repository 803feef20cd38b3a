//! The local dispatcher: one process owns the queue, one run is at work at a time, each on a thread of its own.

use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

use tokio::runtime::Handle;

use crate::engine::Inner;
use crate::measure::Stop;
use crate::model::State;
use crate::plugins::checks;
use crate::runs::benchmark;
use crate::runs::benchmark::End;
use crate::runs::log::plain_event;
use crate::stability::work::next_part;
use crate::{EngineError, Result};

/// A run that was started this often is not tried again: it may be what ends the service.
const MAX_ATTEMPTS: i64 = 3;
/// The queue is looked at this often even if nobody rings.
const IDLE: Duration = Duration::from_secs(30);
/// After a fault of the database.
const BACK_OFF: Duration = Duration::from_secs(2);
/// After several of checks in succession at most.
const LONGEST_BACK_OFF: Duration = Duration::from_secs(60);

/// Puts back what an ended process left behind.
pub async fn recover(inner: &Inner) -> Result<()> {
    let (queued, failed) = inner.store.recover(MAX_ATTEMPTS).await?;
    for run in &failed {
        inner.run_events.tell(&inner.store, run, plain_event(State::Failed, 0)).await?;
    }
    checks::recover(inner).await?;
    if !queued.is_empty() {
        tracing::info!("{} interrupted run(s) are back in the queue", queued.len());
    }
    Ok(())
}

/// Works on the queue until the engine closes.
pub async fn work(inner: Arc<Inner>) {
    let (mut faults, mut next_check) = (0, Instant::now());
    while !inner.closing() {
        // In turn, so that neither waits for all of the other.
        let mut checked = false;
        if Instant::now() >= next_check {
            match check_next(&inner).await {
                Ok(done) => (checked, faults) = (done, 0),
                Err(e) => {
                    let pause = back_off(faults);
                    (faults, next_check) = (faults + 1, Instant::now() + pause);
                    tracing::error!("checking a plugin, again in {} s: {e}", pause.as_secs());
                }
            }
        }
        let tried = next_part(&inner, |id, stop| inner.set_current(Some((id.to_owned(), stop.clone())))).await;
        inner.set_current(None);
        let tried = match tried {
            Ok(tried) => tried,
            Err(e) => {
                tracing::error!("a stability run: {e}");
                tokio::time::sleep(BACK_OFF).await;
                // It is tried again, whoever else comes.
                true
            }
        };
        match inner.store.claim().await {
            Ok(Some(id)) => {
                if let Err(e) = carry_out(&inner, &id).await {
                    tracing::error!("run {id}: {e}");
                    tokio::time::sleep(BACK_OFF).await;
                }
            }
            Ok(None) if checked || tried => {}
            Ok(None) => {
                let idle = if faults > 0 { next_check.saturating_duration_since(Instant::now()) } else { IDLE };
                let _ = tokio::time::timeout(idle, inner.wake.notified()).await;
            }
            Err(e) => {
                tracing::error!("reading the queue: {e}");
                tokio::time::sleep(BACK_OFF).await;
            }
        }
    }
}

/// How long checks wait after so many faults before this one.
fn back_off(faults: u32) -> Duration {
    BACK_OFF.saturating_mul(2_u32.saturating_pow(faults)).min(LONGEST_BACK_OFF)
}

/// Checks the plugin whose turn it is; false when none waits.
async fn check_next(inner: &Arc<Inner>) -> Result<bool> {
    let Some(row) = inner.store.claim_check(checks::MAX_ATTEMPTS).await? else { return Ok(false) };
    let stop = Stop::default();
    inner.set_current(Some((row.id.clone(), stop.clone())));
    if inner.closing() {
        stop.stop();
    }
    // Who ended it between the claim and this line found nothing to stop.
    let done = match inner.store.submission(&row.id).await {
        Ok(Some(now)) if now.state.is_checking() => checks::carry_out(inner, &row, &stop).await,
        other => other.map(|_| ()),
    };
    inner.set_current(None);
    if let Err(e) = done {
        // Our fault, not the plugin's: the attempt does not count. A database error is retried, as below.
        while let Err(e) = inner.store.put_back_check(&row.id).await {
            tracing::error!("the check of plugin {} cannot be put back: {e}", row.id);
            if inner.closing() {
                break;
            }
            tokio::time::sleep(BACK_OFF).await;
        }
        return Err(e);
    }
    Ok(true)
}

async fn carry_out(inner: &Arc<Inner>, id: &str) -> Result<()> {
    let stop = Stop::default();
    inner.set_current(Some((id.to_owned(), stop.clone())));
    // A shutdown that came between the claim and this line found nothing to stop; it is noticed here.
    if inner.closing() {
        stop.stop();
    }
    inner.run_events.queue_moved();
    let ended = run_in_time(inner, id, &stop).await;
    inner.set_current(None);
    let (state, message) = match ended {
        Ok(End::Done) => (State::Done, None),
        Ok(End::Stopped) if inner.closing() => {
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

impl Inner {
    /// Notes which run is at work and how it is stopped.
    fn set_current(&self, current: Option<(String, Stop)>) {
        *self.current.lock().unwrap_or_else(PoisonError::into_inner) = current;
    }

    /// Stops the run at work if it is this one, or whichever it is, with a reason for its owner.
    pub fn stop_current(&self, id: Option<&str>, reason: Option<&str>) {
        let current = self.current.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((running, stop)) = &*current
            && id.is_none_or(|id| id == running)
        {
            stop.stop_because(reason.map(str::to_owned));
        }
    }
}

#[test]
fn faults_in_succession_are_further_and_further_apart() {
    assert_eq!([0, 1, 2, 4, 5, 900].map(|faults| back_off(faults).as_secs()), [2, 4, 8, 32, 60, 60]);
}
