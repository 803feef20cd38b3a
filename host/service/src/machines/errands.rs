//! Work of measuring machines other than runs: checks of plugins, parts of stability runs, replays, and advice.

use ocb_lab::LabError;

use super::handing::Handing;
use super::sql::worker;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind};
use crate::engine::Engine;
use crate::model::{Ended, Errand, Told, Wanted};
use crate::runs::priority::IDLE;
use crate::{EngineError, Result};

impl Engine {
    /// The next errand of this kind for a machine.
    pub(super) async fn next_errand(&self, kind: Kind, priority: i64, worker: &Worker) -> Result<Option<Errand>> {
        let errand = match kind {
            Kind::Check => self.inner.checks.errand(worker).await?,
            Kind::Stability => self.inner.stability.errand(priority, worker).await?,
            Kind::Replay => self.inner.replays.errand(worker).await?,
            Kind::Advise => self.inner.advices.errand(priority == IDLE, worker).await?,
            _ => None,
        };
        if let Some(errand) = &errand {
            self.inner.store.keep_order(&errand.attempt, errand).await?;
        }
        Ok(errand)
    }

    /// Keeps what a machine tells of an errand; false when its attempt has ended here.
    pub(super) async fn told_of_errand(&self, attempt: &Attempt, told: Vec<Told>) -> Result<bool> {
        for told in &told {
            match attempt.kind {
                Kind::Check if !self.inner.checks.told(attempt, told).await? => return Ok(false),
                Kind::Replay => self.inner.replays.told(attempt, told).await?,
                Kind::Advise if !self.inner.advices.told(attempt, told).await? => return Ok(false),
                _ => {}
            }
        }
        Ok(true)
    }

    /// Takes how a machine ended an errand; false, and nothing is kept, when its attempt is not the current one.
    pub(super) async fn hand_in_errand(&self, machine: &str, attempt: Attempt, handing: Handing) -> Result<bool> {
        let Some((attempt, errand)) = self.inner.store.with_order::<Errand>(Some(attempt)).await? else {
            return Ok(false);
        };
        let inner = &self.inner;
        match (handing.ended, errand.wanted) {
            (Ended::Checked { report }, Wanted::Check { plugin_sha256, .. }) => {
                inner.checks.take(&attempt, &plugin_sha256, *report).await
            }
            (Ended::Tried { found, seconds }, Wanted::Stability { part, .. }) => {
                inner.stability.take(&attempt, &part, *found, seconds).await
            }
            (Ended::Replayed { result }, Wanted::Replay { algorithms, .. }) => {
                inner.replays.take(&attempt, algorithms, *result, handing.files).await
            }
            (Ended::Advised { advice, papers }, Wanted::Advise { meshes, .. }) => {
                inner.advices.take(&attempt, &meshes, (*advice, papers), handing.files).await
            }
            (Ended::PutBack, _) => self.put_back(&attempt).await.map(|()| true),
            (Ended::TooLong, Wanted::Stability { .. }) => {
                inner.stability.not_done(&attempt, LabError::Stopped, true).await.map(|()| true)
            }
            (Ended::Impossible { message }, Wanted::Stability { .. }) => {
                inner.stability.not_done(&attempt, LabError::Invalid(message), false).await.map(|()| true)
            }
            (Ended::TooLong, Wanted::Replay { .. }) => inner.replays.too_long(&attempt).await.map(|()| true),
            (Ended::Impossible { message }, Wanted::Replay { .. }) => {
                inner.replays.not_done(&attempt, EngineError::Invalid(message)).await.map(|()| true)
            }
            (Ended::Impossible { message }, Wanted::Advise { .. }) => {
                inner.advices.not_done(&attempt, EngineError::Invalid(message)).await.map(|()| true)
            }
            (Ended::Failed { message } | Ended::Impossible { message }, _) => {
                tracing::error!("{} {}: the machine {machine} failed: {message}", attempt.kind.name(), attempt.job);
                inner.store.machine_failed(machine, &message).await?;
                self.lose_errand(machine, &attempt).await.map(|()| true)
            }
            _ => Err(EngineError::Invalid("This is not what was ordered.".into())),
        }
    }

    /// The job of a machine's attempt waits again, without a fault of its own.
    pub(super) async fn put_back(&self, attempt: &Attempt) -> Result<()> {
        let store = &self.inner.store;
        match attempt.kind {
            Kind::Check => store.put_back_check(attempt).await.map(|_| ()),
            Kind::Stability => store.put_back_part(attempt).await,
            Kind::Replay => store.put_back_replay(attempt).await,
            Kind::Advise => store.put_back_advice(attempt).await,
            _ => store.put_back_run(attempt).await.map(|_| ()),
        }
    }

    /// The machine failed. A check is put back, as if it had been made here.
    async fn lose_errand(&self, machine: &str, attempt: &Attempt) -> Result<()> {
        match attempt.kind {
            Kind::Check => self.put_back(attempt).await,
            _ => self.inner.store.lose(attempt, Some(&worker(machine, ""))).await.map(|_| ()),
        }
    }
}
