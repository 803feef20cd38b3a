//! Workloads at work: one replay at a time, begun anew after a restart.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use ocb_lab::workload::{Far, Found};
use tokio::time::sleep;

use super::replay::{Order, Replays, algorithms_for};
use super::sql::WorkloadRow;
use crate::attempts::sql::end;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, MOST_LOST, Outcome};
use crate::measure::Stop;
use crate::model::State;
use crate::time_limit::in_time;
use crate::{EngineError, Result};

/// How often it is noted how far a replay is.
const NOTE: Duration = Duration::from_secs(1);

impl Replays {
    /// Replays the recording whose turn it is; false when none waits here.
    pub async fn next(&self) -> Result<bool> {
        if self.elsewhere {
            return Ok(false);
        }
        let Some((attempt, row)) = self.begin(&self.work.worker).await? else { return Ok(false) };
        let stop = Stop::default();
        let _held = self.work.begin(&attempt, &stop, None);
        // Who ended it between the beginning and the line above found nothing to stop.
        let open = self.store.workload(&row.id).await?.is_some_and(|now| now.state == State::Running);
        if !open {
            stop.stop();
        }
        let how = self.carry_out(&attempt, &row, &stop).await;
        self.work.unset_current();
        match how {
            Err(_) if stop.asked() => self.stopped(&attempt, stop.reason().as_deref()).await?,
            how => self.settle(&attempt, &row, how).await?,
        }
        Ok(true)
    }

    /// Begins the next replay for a worker. One that was lost too often is given up.
    pub(super) async fn begin(&self, worker: &Worker) -> Result<Option<(Attempt, WorkloadRow)>> {
        while let Some((attempt, row)) = self.store.begin_replay(worker).await? {
            if row.attempts <= MOST_LOST {
                return Ok(Some((attempt, row)));
            }
            let message = format!(
                "The service or a measuring machine ended or failed {MOST_LOST} times in the middle of this replay, so it is not tried again; the \
                 service's log says why."
            );
            self.store.give_up_replay(&attempt, State::Failed, Some(&message)).await?;
        }
        Ok(None)
    }

    /// It was stopped: because its time is over, which its owner is told, or for now.
    pub(super) async fn stopped(&self, attempt: &Attempt, reason: Option<&str>) -> Result<()> {
        match reason {
            Some(_) => self.store.give_up_replay(attempt, State::Cancelled, reason).await.map(|_| ()),
            None => self.store.put_back_replay(attempt).await,
        }
    }

    /// Notes how an attempt ended that was not stopped.
    pub(super) async fn settle(&self, attempt: &Attempt, row: &WorkloadRow, how: Result<bool>) -> Result<()> {
        match how {
            Ok(_) => Ok(()),
            // Ours: it is tried again, after the dispatcher has waited a little.
            Err(e @ EngineError::Fault(_)) => {
                let mut connection = self.store.pool.acquire().await?;
                end(&mut connection, attempt, Outcome::Lost).await?;
                Err(e)
            }
            Err(e) => {
                tracing::warn!("workload {}: {e}", row.id);
                let message = e.for_visitors().to_string();
                self.store.give_up_replay(attempt, State::Failed, Some(&message)).await.map(|_| ())
            }
        }
    }

    /// The time of a replay, and what its owner is told when it is over.
    pub(super) fn limit(&self, row: &WorkloadRow) -> Option<(Duration, String)> {
        let advice = "Choose fewer algorithms or a smaller budget, or log in.";
        self.ceilings.limit_of(row.owner.as_deref(), advice)
    }

    /// What is to be replayed.
    pub(super) async fn order(&self, row: &WorkloadRow) -> Result<Order> {
        let recording = self.recordings.get(&row.recording).await?;
        let spec = row.spec.clone();
        let algorithms = algorithms_for(&self.registry, &recording, &spec.algorithms, row.owner.as_deref())?;
        Ok(Order { recording, spec, algorithms })
    }

    async fn carry_out(&self, attempt: &Attempt, row: &WorkloadRow, stop: &Stop) -> Result<bool> {
        let order = self.order(row).await?;
        let far: Arc<Mutex<(u64, Option<String>)>> = Arc::default();
        let told = far.clone();
        let tell = move |now: Far| {
            let mut far = told.lock().unwrap_or_else(PoisonError::into_inner);
            match now {
                Far::Pairs(done) => *far = (done, None),
                Far::Doing(what) => far.1 = Some(what),
            }
        };
        let replaying = self.here(order, stop.clone(), move |asked, site| asked.carry_out(site, &tell));
        tokio::pin!(replaying);
        let noted = async {
            loop {
                tokio::select! {
                    found = &mut replaying => break found,
                    () = sleep(NOTE) => {
                        let (done, doing) = far.lock().unwrap_or_else(PoisonError::into_inner).clone();
                        self.store.replay_is_at(&row.id, done, doing.as_deref()).await?;
                    }
                }
            }
        };
        let found = in_time(noted, stop, self.limit(row)).await?;
        self.accept(attempt, row, found).await
    }

    /// Keeps what was found; false when the attempt is not the current one.
    pub(super) async fn accept(&self, attempt: &Attempt, row: &WorkloadRow, found: Found) -> Result<bool> {
        let Found { result, queries, reduced } = found;
        let _keeping = self.store.locks.keeping().await?;
        let queries = self.keep(queries, "application/vnd.apache.parquet").await?;
        let reduced = match reduced {
            Some(file) => Some(self.keep(file, "application/zip").await?),
            None => None,
        };
        let accepted = self.store.accept_replay(attempt, &result, &queries, reduced.as_deref()).await?;
        if !accepted {
            tracing::warn!("workload {}: the result of attempt {} is not kept", row.id, attempt.number);
        }
        Ok(accepted)
    }

    async fn keep(&self, file: Vec<u8>, kind: &str) -> Result<String> {
        let length = file.len();
        let name = self.blobs.put(file).await?;
        self.store.add_blob(&name, length, kind).await?;
        Ok(name)
    }
}
