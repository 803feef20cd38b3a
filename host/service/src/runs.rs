//! Asking for runs, looking at them and ending them.

pub mod accept;
pub mod benchmark;
pub mod carry_out;
pub mod current;
pub mod dispatcher;
pub mod draw;
pub mod ends;
pub mod estimate;
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
use crate::model::{AccountInfo, Cursor, Page, Part, Role, RunInfo, RunSpec, Stage, State, Visibility};
use crate::quotas::{Visitor, granted, turn};
use crate::runs::log::{fresh_stages, plain_event};
use crate::runs::priority::INTERACTIVE;
use crate::runs::sql::RunRow;
use crate::store::now_us;
use crate::{EngineError, Result};

/// How long `cancel` waits for a run under way to end before it answers.
const CANCEL_PATIENCE: Duration = Duration::from_secs(3);

/// Who asks for a run, and what for.
#[derive(Clone, Copy, Default)]
pub(crate) struct RunContext<'a> {
    /// Who owns it; the service when nobody does.
    pub owner: Option<&'a str>,
    /// Network of the request.
    pub address: Option<&'a str>,
    /// Smaller is served first.
    pub priority: i64,
    /// For the start page.
    pub featured: bool,
    /// The request's name.
    pub key: Option<&'a str>,
    /// The suite that it belongs to.
    pub suite: Option<&'a str>,
    /// The campaign that it belongs to.
    pub campaign: Option<&'a str>,
    /// The run that it repeats there.
    pub rerun_of: Option<&'a str>,
}

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
        let (id, new) = self.enqueue(spec, asking).await?;
        self.run(&id, asking.owner).await.map(|run| (run, new))
    }

    /// The same, for who needs its id alone.
    pub(crate) async fn enqueue(&self, spec: RunSpec, asking: RunContext<'_>) -> Result<(String, bool)> {
        let RunContext { owner, address, priority, featured, key, suite, campaign, rerun_of } = asking;
        let checked = self.check(&spec, owner).await?;
        let asked_before = match (owner, key) {
            (Some(owner), Some(key)) => self.inner.store.run_of_request(owner, key).await?.is_some(),
            _ => false,
        };
        let expected = estimate::estimate_alone(&self.inner, &checked).await?;
        let row = RunRow {
            id: uuid::Uuid::now_v7().to_string(),
            owner: owner.map(str::to_owned),
            featured,
            private: checked.algorithms.iter().any(|c| self.inner.registry.is_private(c)),
            // The service's own runs are for everybody.
            visibility: if priority == INTERACTIVE { Visibility::default() } else { Visibility::Public },
            priority,
            turn: owner.filter(|_| campaign.is_none()).map_or_else(String::new, |owner| turn(owner, address)),
            address: address.map(str::to_owned),
            granted_seconds: granted(&checked.spec),
            suite: suite.map(str::to_owned),
            campaign: campaign.map(str::to_owned),
            rerun_of: rerun_of.map(str::to_owned),
            state: State::Queued,
            attempts: 0,
            message: None,
            object_a_name: checked.object_a.name,
            object_b_name: checked.object_b.name,
            set: None,
            set_blob: None,
            environment: None,
            preview: None,
            secret: Some(draw::secret()),
            expected_seconds: expected.total_seconds,
            created_us: now_us(),
            finished_us: None,
            spec: checked.spec,
        };
        // Two concurrent requests must not share the last of a quota.
        let _alone = self.inner.store.locks.alone(Lock::Admission).await?;
        if !asked_before && campaign.is_none() {
            self.has_room_for_a_run(&row).await?;
        }
        if !self.inner.store.add_run(&row, &fresh_stages(&row.spec.algorithms), key).await? {
            return self.asked_before(&row, key.unwrap_or_default()).await.map(|run| (run, false));
        }
        self.inner.run_events.queue_moved();
        self.inner.work.call();
        Ok((row.id, true))
    }

    /// The run that was asked for under the key of this one, or that repeats the same one in its campaign.
    async fn asked_before(&self, row: &RunRow, key: &str) -> Result<String> {
        let missing = || EngineError::Fault("The run was lost while it was being stored.".into());
        if let (Some(campaign), Some(repeated)) = (&row.campaign, &row.rerun_of) {
            return Ok(self.inner.store.repeat_of(campaign, repeated).await?.ok_or_else(missing)?.id);
        }
        let owner = row.owner.as_deref().unwrap_or_default();
        let known = self.inner.store.run_of_request(owner, key).await?.ok_or_else(missing)?;
        if known.spec != row.spec {
            let told = format!("The key {key:?} was used for another run; use a new key for each run.");
            return Err(EngineError::Invalid(told));
        }
        Ok(known.id)
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
        let checked = self.check(&whole, caller).await?;
        let expected_seconds = estimate::estimate_alone(&self.inner, &checked).await?.total_seconds;
        // The old secret is known by now.
        let granted_seconds = granted(&checked.spec);
        let row = RunRow { spec: checked.spec, secret: Some(draw::secret()), expected_seconds, granted_seconds, ..row };
        let _alone = self.inner.store.locks.alone(Lock::Admission).await?;
        self.has_room_for_a_run(&row).await?;
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
