//! Stability runs that visitors start: asking for them, looking at them, ending them.

use ocb_lab::stability::{self, Selection};

use super::runs_sql::StabilityRow;
use crate::attempts::Kind;
use crate::boxed;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::{AccountInfo, Cursor, Page, Part, Role, StabilityRunInfo, StabilitySpec, State};
use crate::quotas::{Visitor, turn};
use crate::requests::Made;
use crate::runs::current::Work;
use crate::runs::priority::INTERACTIVE;
use crate::store::{Store, now_us};
use crate::{EngineError, Result};

/// So many of one account, or of the guests of one address, may be queued or running, and so many in all.
const MOST_OPEN: i64 = 3;
const MOST_IN_ALL: i64 = 200;
/// When to ask again: a run takes minutes.
const RETRY_SECONDS: u32 = 120;
/// Seeds per value at most.
const MOST_SEEDS: u32 = 10;

impl Engine {
    /// Queues a stability run of an algorithm that the visitor may use. True when it is new: the same request under the same key
    /// returns the existing one.
    ///
    /// # Errors
    /// `Invalid` without such an algorithm or part, `TooMuch` when too many wait.
    #[boxed]
    pub async fn start_stability(
        &self,
        spec: StabilitySpec,
        visitor: &Visitor,
        key: Option<&str>,
    ) -> Result<(StabilityRunInfo, bool)> {
        let (inner, owner) = (&self.inner, visitor.owner.as_str());
        check(&spec)?;
        let algorithm = inner.registry.named(&spec.algorithm, Some(owner))?;
        let id = self.id_of_request(owner, Made::StabilityRun, key, &spec).await?;
        // Two concurrent requests must not share the last of a quota.
        let _alone = inner.store.locks.alone(Lock::Admission).await?;
        if inner.store.stability_run(&id).await?.is_some() {
            return Ok((self.stability_run(&id).await?, false));
        }
        let turn = turn(owner, visitor.address.as_deref());
        let [all, own] = inner.store.open_stability(&turn).await?;
        if own >= MOST_OPEN || all >= MOST_IN_ALL {
            let whose = if own >= MOST_OPEN { format!("{own} of your") } else { format!("{all}") };
            let message =
                format!("{whose} stability runs are queued or running; try again when one of them has ended.");
            return Err(EngineError::TooMuch { message, retry_seconds: RETRY_SECONDS });
        }
        let row = StabilityRow {
            id,
            owner: Some(owner.to_owned()),
            turn,
            priority: INTERACTIVE,
            state: State::Queued,
            attempts: 0,
            message: None,
            name: algorithm.info.name.clone(),
            spec,
            done: Vec::new(),
            spent_seconds: 0.0,
            created_us: now_us(),
            finished_us: None,
        };
        let new = inner.store.add_stability_run(&row).await?;
        inner.work.call();
        Ok((self.stability_run(&row.id).await?, new))
    }

    /// Those of this owner, newest first, without results.
    #[boxed]
    pub async fn stability_runs(&self, owner: &str, page: &Page) -> Result<Part<StabilityRunInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.stability_runs_of(owner, &from, limit + 1).await?;
        let part = Part::of(rows, limit, |row: &StabilityRow| Cursor::behind(row.created_us, &row.id));
        let mut entries = Vec::new();
        for row in part.entries {
            entries.push(self.inner.store.stability_info(row).await?);
        }
        Ok(Part { entries, next: part.next })
    }

    /// How far it is, with what it found so far.
    #[boxed]
    pub async fn stability_run(&self, id: &str) -> Result<StabilityRunInfo> {
        let row = self.inner.store.stability_row(id).await?;
        let result = self.inner.store.stability_found(id).await?;
        Ok(StabilityRunInfo { result, ..self.inner.store.stability_info(row).await? })
    }

    /// Ends it and keeps what it found; only its owner may.
    #[boxed]
    pub async fn cancel_stability(&self, id: &str, caller: Option<&str>) -> Result<StabilityRunInfo> {
        self.inner.store.own_stability(id, caller, "cancel").await?;
        self.inner.work.end_stability(&self.inner.store, id, None).await?;
        self.stability_run(id).await
    }

    /// All that have not ended, in the order in which they were asked for, for curators and administrators.
    ///
    /// # Errors
    /// `Forbidden` for all others.
    #[boxed]
    pub async fn open_stability_runs(&self, curator: &AccountInfo) -> Result<Vec<StabilityRunInfo>> {
        curates(curator)?;
        let mut all = Vec::new();
        for row in self.inner.store.open_stability_runs().await? {
            all.push(self.inner.store.stability_info(row).await?);
        }
        Ok(all)
    }

    /// Ends anybody's, for curators and administrators, who do not see what it found; its owner sees who did.
    ///
    /// # Errors
    /// `Forbidden` for all others.
    #[boxed]
    pub async fn cancel_stability_of_others(&self, id: &str, curator: &AccountInfo) -> Result<StabilityRunInfo> {
        curates(curator)?;
        self.inner.store.stability_row(id).await?;
        self.inner.work.end_stability(&self.inner.store, id, Some("Cancelled by a curator.")).await?;
        self.inner.store.stability_info(self.inner.store.stability_row(id).await?).await
    }

    /// Takes it away; only its owner may.
    #[boxed]
    pub async fn remove_stability(&self, id: &str, caller: Option<&str>) -> Result<()> {
        self.inner.store.own_stability(id, caller, "delete").await?;
        self.inner.work.end_stability(&self.inner.store, id, None).await?;
        self.inner.store.remove_stability(id).await
    }

    /// # Errors
    /// `NotFound` when the run is there and somebody else's.
    #[boxed]
    pub async fn stability_run_is_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        match self.inner.store.stability_run(id).await? {
            Some(row) if row.owner.as_deref() != viewer => Err(no_run(id)),
            _ => Ok(()),
        }
    }
}

impl Store {
    async fn stability_row(&self, id: &str) -> Result<StabilityRow> {
        self.stability_run(id).await?.ok_or_else(|| no_run(id))
    }

    async fn stability_info(&self, row: StabilityRow) -> Result<StabilityRunInfo> {
        let waits = row.state == State::Queued;
        let runs_ahead = if waits { self.stability_before(&row).await? } else { 0 };
        Ok(info(row, runs_ahead))
    }

    async fn own_stability(&self, id: &str, caller: Option<&str>, may: &str) -> Result<()> {
        let row = self.stability_row(id).await?;
        if caller.is_some() && row.owner.as_deref() == caller {
            return Ok(());
        }
        Err(EngineError::Forbidden(format!("Only the owner of this stability run may {may} it.")))
    }
}

impl Work {
    /// The row first: a part that ends at this moment finds it ended.
    pub(crate) async fn end_stability(&self, store: &Store, id: &str, reason: Option<&str>) -> Result<()> {
        store.end_stability(id, State::Cancelled, reason).await?;
        self.stop_current(Some(id), None);
        store.withdraw(Kind::Stability, id, &self.worker).await.map(|_| ())
    }
}

fn curates(account: &AccountInfo) -> Result<()> {
    if account.role < Role::Curator {
        return Err(EngineError::Forbidden("Only the owner of this stability run or a curator may cancel it.".into()));
    }
    Ok(())
}

fn check(spec: &StabilitySpec) -> Result<()> {
    Selection::of(spec).check()?;
    match spec.seeds {
        Some(seeds) if !(1..=MOST_SEEDS).contains(&seeds) => {
            Err(EngineError::Invalid(format!("Seeds per value must be from 1 to {MOST_SEEDS}, not {seeds}.")))
        }
        _ => Ok(()),
    }
}

fn info(row: StabilityRow, runs_ahead: u32) -> StabilityRunInfo {
    let parts = stability::parts(&Selection::of(&row.spec));
    let open = matches!(row.state, State::Queued | State::Running);
    StabilityRunInfo {
        step: parts.get(row.done.len()).filter(|_| open).map(|part| (*part).to_owned()),
        done: row.done.len() as u32,
        total: parts.len() as u32,
        runs_ahead,
        id: row.id,
        spec: row.spec,
        name: row.name,
        state: row.state,
        message: row.message,
        created_us: row.created_us,
        finished_us: row.finished_us,
        result: None,
    }
}

/// There is no such run, or not for who asks: both sound alike.
fn no_run(id: &str) -> EngineError {
    EngineError::NotFound(format!("There is no stability run {id:?}; check the link."))
}
