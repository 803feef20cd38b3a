//! Workloads at work: one replay at a time, begun anew after a restart.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use ocb_lab::workload::{Progress, workload_parquet};
use tokio::time::sleep;

use super::reduce::{Doing, Reducing};
use super::replay::{Replays, algorithms_for};
use super::sql::WorkloadRow;
use crate::attempts::sql::end;
use crate::attempts::{Attempt, MOST_LOST, Outcome};
use crate::measure::Stop;
use crate::model::State;
use crate::quotas::time;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

/// How often it is noted how far a replay is.
const NOTE: Duration = Duration::from_secs(1);

impl Replays {
    /// Replays the recording whose turn it is; false when none waits.
    pub async fn next(&self) -> Result<bool> {
        let Some((attempt, row)) = self.store.begin_replay(&self.work.worker).await? else { return Ok(false) };
        if row.attempts > MOST_LOST {
            let message = format!(
                "The service ended {MOST_LOST} times in the middle of this replay, so it is not tried again; its log says why."
            );
            self.store.give_up_replay(&attempt, State::Failed, Some(&message)).await?;
            return Ok(true);
        }
        let stop = Stop::default();
        let _held = self.work.begin(&attempt, &stop, None);
        // Who ended it between the beginning and the line above found nothing to stop.
        let open = self.store.workload(&row.id).await?.is_some_and(|now| now.state == State::Running);
        if !open {
            stop.stop();
        }
        let ended = self.carry_out(&attempt, &row, &stop).await;
        self.work.unset_current();
        match ended {
            Ok(()) => {}
            // Its time is over.
            Err(_) if stop.asked() && stop.reason().is_some() => {
                self.store.give_up_replay(&attempt, State::Cancelled, stop.reason().as_deref()).await?;
            }
            Err(_) if stop.asked() => self.store.put_back_replay(&attempt).await?,
            // Ours: it is tried again, after the dispatcher has waited a little.
            Err(e @ EngineError::Fault(_)) => {
                let mut connection = self.store.pool.acquire().await?;
                end(&mut connection, &attempt, Outcome::Lost).await?;
                return Err(e);
            }
            Err(e) => {
                tracing::warn!("workload {}: {e}", row.id);
                self.store.give_up_replay(&attempt, State::Failed, Some(&e.for_visitors().to_string())).await?;
            }
        }
        Ok(true)
    }

    async fn carry_out(&self, attempt: &Attempt, row: &WorkloadRow, stop: &Stop) -> Result<()> {
        let told = self.store.workload_row(&row.id).await?.recording;
        let recording = self.recordings.get(&told).await?;
        let algorithms = algorithms_for(&self.registry, &recording, &row.spec.algorithms, row.owner.as_deref())?;
        let done = Arc::new(AtomicU64::new(0));
        let doing = Arc::new(Doing::default());
        let told = (done.clone(), doing.clone());
        let tell = move |progress: Progress| match progress {
            Progress::Scene { algorithm, process, of } => {
                told.1.say(Some(format!("Asking {algorithm} about the whole scene: process {process} of {of}.")));
            }
            Progress::Pairs { done, .. } => {
                told.1.say(None);
                told.0.store(done, Ordering::Relaxed);
            }
        };
        let replaying = async {
            let of = (recording.clone(), row.spec.clone(), algorithms.clone());
            let mut replayed = self.replay(of.0, of.1, of.2, stop.clone(), tell, || {}).await?;
            let Some(terms) = row.spec.reduce else { return Ok::<_, EngineError>((replayed, None)) };
            let track = replayed.result.tracks[0].track;
            let (spec, doing) = (&row.spec, &doing);
            let reducing =
                Reducing { replays: self, recording: &recording, spec, algorithms: &algorithms, stop, doing, track };
            let (reduced, file) = reducing.reduced(terms, &replayed.result).await?;
            replayed.result.reduced = Some(reduced);
            Ok((replayed, Some(file)))
        };
        tokio::pin!(replaying);
        let noted = async {
            loop {
                tokio::select! {
                    replayed = &mut replaying => break replayed,
                    () = sleep(NOTE) => {
                        let (done, doing) = (done.load(Ordering::Relaxed), doing.now());
                        self.store.replay_is_at(&row.id, done, doing.as_deref()).await?;
                    }
                }
            }
        };
        let limit = self.ceilings.longest_of(row.owner.as_deref()).map(|longest| {
            let reason = format!(
                "Stopped after {}, the time limit for guests. Choose fewer algorithms or a smaller budget, or log in.",
                time(longest.as_secs_f64())
            );
            (longest, reason)
        });
        let (replayed, reduced) = in_time(noted, stop, limit).await?;
        let table = workload_parquet(&replayed.rows, &recording.queries)?;
        let length = table.len();
        let _keeping = self.store.locks.keeping().await?;
        let queries = self.blobs.put(table).await?;
        self.store.add_blob(&queries, length, "application/vnd.apache.parquet").await?;
        let reduced = match reduced {
            Some(file) => {
                let length = file.len();
                let reduced = self.blobs.put(file).await?;
                self.store.add_blob(&reduced, length, "application/zip").await?;
                Some(reduced)
            }
            None => None,
        };
        if !self.store.accept_replay(attempt, &replayed.result, &queries, reduced.as_deref()).await? {
            tracing::warn!("workload {}: the result of attempt {} is not kept", row.id, attempt.number);
        }
        Ok(())
    }
}
