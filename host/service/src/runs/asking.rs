//! Asking for runs: they are checked, estimated and queued.

use std::sync::Arc;

use crate::blobs::Blobs;
use crate::classes::Classes;
use crate::locks::Lock;
use crate::model::{RunSpec, State, Visibility};
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::quotas::{granted, turn};
use crate::runs::current::Work;
use crate::runs::draw;
use crate::runs::events::RunEvents;
use crate::runs::log::fresh_stages;
use crate::runs::priority::INTERACTIVE;
use crate::runs::sql::RunRow;
use crate::store::{Store, now_us};
use crate::{Ceilings, EngineError, Result};

/// Who asks for a run, and what for.
#[derive(Clone, Copy, Default)]
pub struct RunContext<'a> {
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

/// The runs that are asked for, and what that depends on.
pub struct Runs {
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Arc<Objects>,
    pub registry: Arc<Registry>,
    pub classes: Arc<Classes>,
    pub run_events: RunEvents,
    pub work: Arc<Work>,
    pub ceilings: Ceilings,
}

impl Runs {
    /// Checks the spec and queues the run; gives its id. True when the run is new.
    pub async fn enqueue(&self, spec: RunSpec, asking: RunContext<'_>) -> Result<(String, bool)> {
        let RunContext { owner, address, priority, featured, key, suite, campaign, rerun_of } = asking;
        let checked = self.check(&spec, owner).await?;
        let asked_before = match (owner, key) {
            (Some(owner), Some(key)) => self.store.run_of_request(owner, key).await?.is_some(),
            _ => false,
        };
        let expected = self.estimate_alone(&checked).await?;
        let row = RunRow {
            id: uuid::Uuid::now_v7().to_string(),
            owner: owner.map(str::to_owned),
            featured,
            private: checked.algorithms.iter().any(|c| self.registry.is_private(c)),
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
        let _alone = self.store.locks.alone(Lock::Admission).await?;
        if !asked_before && campaign.is_none() {
            self.ceilings.have_room_for_a_run(&self.store, &row).await?;
        }
        if !self.store.add_run(&row, &fresh_stages(&row.spec.algorithms), key).await? {
            return self.asked_before(&row, key.unwrap_or_default()).await.map(|run| (run, false));
        }
        self.run_events.queue_moved();
        self.work.call();
        Ok((row.id, true))
    }

    /// The run that was asked for under the key of this one, or that repeats the same one in its campaign.
    async fn asked_before(&self, row: &RunRow, key: &str) -> Result<String> {
        let missing = || EngineError::Fault("The run was lost while it was being stored.".into());
        if let (Some(campaign), Some(repeated)) = (&row.campaign, &row.rerun_of) {
            return Ok(self.store.repeat_of(campaign, repeated).await?.ok_or_else(missing)?.id);
        }
        let owner = row.owner.as_deref().unwrap_or_default();
        let known = self.store.run_of_request(owner, key).await?.ok_or_else(missing)?;
        if known.spec != row.spec {
            let told = format!("The key {key:?} was used for another run; use a new key for each run.");
            return Err(EngineError::Invalid(told));
        }
        Ok(known.id)
    }
}
