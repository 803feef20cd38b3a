//! Asking for runs, looking at them and ending them.

pub mod accept;
pub mod asking;
pub mod benchmark;
pub mod benchmarks;
pub mod carry_out;
pub mod current;
pub mod dispatcher;
pub mod draw;
pub mod ends;
pub mod estimate;
pub mod events;
pub mod events_sql;
pub mod featured;
pub mod follow;
#[cfg(feature = "postgres")]
pub mod hear;
pub mod live;
pub mod log;
pub mod looking;
pub mod places;
pub mod preliminary;
pub mod priority;
pub mod queue;
pub mod remaining;
pub mod repro;
pub mod share;
pub mod spec;
pub mod sql;
pub mod stored_spec;

use std::time::{Duration, Instant};

use crate::boxed;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::{AccountInfo, Cursor, Page, Part, Role, RunInfo, RunSpec, Stage, State};
use crate::quotas::{Visitor, granted};
use crate::runs::asking::RunContext;
use crate::runs::events::plain_event;
use crate::runs::log::fresh_stages;
use crate::runs::priority::INTERACTIVE;
use crate::runs::sql::RunRow;
use crate::{EngineError, Result};

/// How long `cancel` waits for a run under way to end before it answers.
const CANCEL_PATIENCE: Duration = Duration::from_secs(3);

impl Engine {
    /// Checks the spec and queues the run.
    #[boxed]
    pub async fn submit(&self, spec: RunSpec, owner: Option<&str>) -> Result<RunInfo> {
        let asking = RunContext { owner, priority: INTERACTIVE, ..RunContext::default() };
        self.queue(spec, asking).await.map(|(run, _)| run)
    }

    /// The same for a visitor. Repeating a request with the same key returns the existing run. True when the run is new.
    #[boxed]
    pub async fn submit_for(&self, spec: RunSpec, visitor: &Visitor, key: Option<&str>) -> Result<(RunInfo, bool)> {
        let (owner, address) = (Some(visitor.owner.as_str()), visitor.address.as_deref());
        self.queue(spec, RunContext { owner, address, priority: INTERACTIVE, key, ..RunContext::default() }).await
    }

    pub(crate) async fn queue(&self, spec: RunSpec, asking: RunContext<'_>) -> Result<(RunInfo, bool)> {
        let (id, new) = self.inner.runs.enqueue(spec, asking).await?;
        self.run(&id, asking.owner).await.map(|run| (run, new))
    }

    /// Queues a preview's run for all of its configurations. It stays the same run; its numbers are a preview's until those
    /// of the whole are there. The configurations of the preview are measured again: they are few, their times were taken
    /// earlier, and the interval over processes needs processes that measured everything.
    #[boxed]
    pub async fn refine(&self, id: &str, caller: Option<&str>) -> Result<RunInfo> {
        let row = self.inner.store.run_row(id).await?;
        if caller.is_none() || row.owner.as_deref() != caller {
            return Err(EngineError::Forbidden("Only the owner of this run may refine it.".into()));
        }
        let nothing = || EngineError::Busy("Only a run that has ended as a preview can be refined.".into());
        if row.preview.is_none() {
            return Err(nothing());
        }
        let whole = RunSpec { precision: None, at_most: None, ..row.spec.clone() };
        let checked = self.inner.runs.check(&whole, caller).await?;
        let expected_seconds = self.inner.runs.estimate_alone(&checked).await?.total_seconds;
        // The old secret is known by now.
        let granted_seconds = granted(&checked.spec);
        let row = RunRow { spec: checked.spec, secret: Some(draw::secret()), expected_seconds, granted_seconds, ..row };
        let _alone = self.inner.store.locks.alone(Lock::Admission).await?;
        self.inner.config.ceilings.have_room_for_a_run(&self.inner.store, &row).await?;
        if !self.inner.store.queue_again(&row, &fresh_stages(&row.spec.algorithms)).await? {
            return Err(nothing());
        }
        self.inner.run_events.queue_moved();
        self.inner.work.call();
        self.run(id, caller).await
    }

    /// One run.
    #[boxed]
    pub async fn run(&self, id: &str, viewer: Option<&str>) -> Result<RunInfo> {
        let row = self.inner.store.run_row(id).await?;
        self.info(row, viewer).await
    }

    /// The owner's runs, newest first. A part holds fewer where an object of a run is hidden from its owner.
    #[boxed]
    pub async fn runs(&self, owner: &str, page: &Page) -> Result<Part<RunInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.runs_of(owner, &from, limit + 1).await?;
        let part = Part::of(rows, limit, |row: &RunRow| Cursor::behind(row.created_us, &row.id));
        let mut entries = Vec::new();
        for row in part.entries {
            if self.inner.objects.may_see(&row, Some(owner)).await? {
                entries.push(self.info(row, Some(owner)).await?);
            }
        }
        Ok(Part { entries, next: part.next })
    }

    /// The newest finished run for the start page; while there is none, the one that is being measured for it.
    #[boxed]
    pub async fn featured(&self) -> Result<Option<RunInfo>> {
        match self.inner.store.newest_featured().await? {
            Some(row) => Ok(Some(self.info(row, None).await?)),
            None => Ok(None),
        }
    }

    /// Ends a run that is queued or under way. A run that has ended stays as it is.
    #[boxed]
    pub async fn cancel(&self, id: &str, caller: Option<&str>) -> Result<RunInfo> {
        let row = self.inner.store.run_row(id).await?;
        if caller.is_none() || row.owner.as_deref() != caller {
            return Err(EngineError::Forbidden("Only the owner of this run may cancel it.".into()));
        }
        self.end(&row, None).await?;
        self.run(id, caller).await
    }

    /// Cancels any run, for curators and administrators; its owner sees who did.
    ///
    /// # Errors
    /// `Forbidden` for all others.
    #[boxed]
    pub async fn cancel_of_others(&self, id: &str, curator: &AccountInfo) -> Result<RunInfo> {
        if curator.role < Role::Curator {
            return Err(EngineError::Forbidden("Only the owner of this run or a curator may cancel it.".into()));
        }
        let row = self.inner.store.run_row(id).await?;
        self.end(&row, Some("Cancelled by a curator.")).await?;
        self.run(id, Some(&curator.owner())).await
    }

    /// Cancels any queued or running run, with a reason for its owner.
    pub(crate) async fn end(&self, row: &RunRow, reason: Option<&'static str>) -> Result<()> {
        let id = row.id.as_str();
        let asked = Instant::now();
        loop {
            let ended = row.after(State::Cancelled);
            if self.inner.store.end_waiting_run(id, ended, reason).await? {
                self.inner.run_events.tell(&self.inner.store, id, plain_event(ended, 0)).await?;
                self.inner.run_events.queue_moved();
                break;
            }
            // Between the beginning and the start there is a moment in which neither works; so it is tried until it does.
            self.inner.work.stop_current(Some(id), reason);
            if self.inner.store.withdraw_run(id, &self.inner.work.worker, ended, reason).await? {
                self.inner.run_events.ring(id);
                self.inner.run_events.queue_moved();
                break;
            }
            let state = self.inner.store.run_row(id).await?.state;
            if !matches!(state, State::Queued | State::Running) || asked.elapsed() > CANCEL_PATIENCE {
                break;
            }
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        self.inner.under_way.forget(id);
        if let Some(campaign) = &row.campaign {
            self.inner.campaigns.end_campaign_when_through(campaign).await?;
        }
        Ok(())
    }

    async fn info(&self, row: RunRow, viewer: Option<&str>) -> Result<RunInfo> {
        let store = &self.inner.store;
        let runs_ahead = match row.state {
            State::Queued => store.runs_before(&row.id, &self.inner.classes.waiting_for(&row.spec)).await?.unwrap_or(0),
            _ => 0,
        };
        let mut stages = store.stages(&row.id).await?;
        // A run that was cancelled before its turn, or before it began again, has none of them at work.
        if row.state == State::Cancelled {
            let open = |stage: &&mut Stage| matches!(stage.state, State::Queued | State::Running);
            stages.iter_mut().filter(open).for_each(|stage| stage.state = State::Cancelled);
        }
        let mut results = self.inner.results.results_so_far(&row.id).await?;
        let mut seconds_left = self.inner.under_way.seconds_left(&row.id);
        // Ended at another service, or it waits again, since its machine was heard from here.
        if row.state != State::Running {
            results.retain(|result| !result.preliminary);
            seconds_left = None;
        }
        Ok(RunInfo {
            stages,
            results,
            mine: viewer.is_some() && row.owner.as_deref() == viewer,
            visibility: self.inner.objects.visibility_of(&row).await?,
            runs_ahead,
            id: row.id,
            object_a_name: row.object_a_name,
            object_b_name: row.object_b_name,
            state: row.state,
            message: row.message,
            set: row.set,
            environment: row.environment,
            preview: row.preview,
            campaign: row.campaign,
            rerun_of: row.rerun_of,
            commitment: row.secret.as_deref().filter(|_| row.spec.seed.is_none()).map(draw::commitment),
            attempts: row.attempts,
            created_us: row.created_us,
            finished_us: row.finished_us,
            seconds_left,
            spec: row.spec,
        })
    }
}
