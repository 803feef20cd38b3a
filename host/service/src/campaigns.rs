//! Campaigns: a curator has stored benchmarks measured again for another hardware class, suite or oracle.
//!
//! A campaign's runs are ordinary ones that come after whatever anybody waits for. What it measures follows from what is stored,
//! so a campaign that was half queued when its service ended is completed by the service that keeps house, and repeats no run twice. The old
//! results stay as they are.

pub mod columns;
mod compare;
pub mod course;
mod failures;
mod plan;
pub mod sql;

use std::collections::BTreeMap;
use std::time::Duration;

use crate::accounts::{NAME_OF_OPERATOR, said};
use crate::audit::Note;
use crate::boxed;
use crate::campaigns::compare::side_by_side;
use crate::campaigns::course::Campaigns;
use crate::campaigns::sql::CampaignRow;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::{
    AccountInfo, CampaignInfo, CampaignPreview, CampaignRequest, CampaignRuns, Compared, Cursor, Owner, Page, Part,
    State,
};
use crate::notices::telling::notice;
use crate::plugins::sql::THE_SERVICE;
use crate::requests::Made;
use crate::runs::asking::RunContext;
use crate::runs::events::plain_event;
use crate::runs::priority::BACKGROUND;
use crate::store::now_us;
use crate::{EngineError, Result};

/// How often it is looked for campaigns that the service which queued them did not complete.
const LOOK: Duration = Duration::from_secs(60);

impl Engine {
    /// What a campaign on this hardware class, or on the usual one, would queue now; nothing is queued.
    ///
    /// # Errors
    /// `Invalid` when no machine has this class.
    #[boxed]
    pub async fn preview_campaign(&self, suite: bool, people: bool, class: Option<&str>) -> Result<CampaignPreview> {
        let inner = &self.inner;
        let class = inner.classes.measures_on(class)?;
        let due = inner.campaigns.due(suite, people, &class, &[]).await?;
        let of_suite = || due.iter().filter(|due| due.of_suite);
        Ok(CampaignPreview {
            suite_runs: of_suite().count() as u32,
            suite_repeats: of_suite().filter(|due| due.repeats.is_some()).count() as u32,
            peoples_runs: due.iter().filter(|due| !due.of_suite).count() as u32,
            expected_seconds: self.seconds_for(&due).await?,
            hardware_class: class,
            oracle: ocb_core::oracle::VERSION,
            suite_version: inner.suite.document.version,
        })
    }

    /// Makes a campaign and queues its runs; `by` is a curator, or nobody when whoever has the data folder makes it. True when it
    /// is new: asked again under the same key, it is the campaign that there is.
    #[boxed]
    pub async fn create_campaign(
        &self,
        by: Option<&AccountInfo>,
        asked: CampaignRequest,
        key: Option<&str>,
    ) -> Result<(CampaignInfo, bool)> {
        let inner = &self.inner;
        let reason = said(&asked.reason, "say why it is measured again (the reason is public)")?;
        if !asked.suite && !asked.people {
            return Err(EngineError::Invalid(
                "A campaign measures the suite, user runs, or both; choose at least one.".into(),
            ));
        }
        let class = inner.classes.measures_on(asked.hardware_class.as_deref())?;
        let owner = by.map_or_else(|| NAME_OF_OPERATOR.to_owned(), AccountInfo::owner);
        let id = self.id_of_request(&owner, Made::Campaign, key, &asked).await?;
        let viewer = by.map(AccountInfo::owner);
        if inner.store.campaign(&id).await?.is_some() {
            return Ok((self.campaign(&id, viewer.as_deref()).await?, false));
        }
        if inner.campaigns.due(asked.suite, asked.people, &class, &[]).await?.is_empty() {
            return Err(EngineError::Busy(
                "There is nothing to measure again: everything is queued or was measured on this hardware class with \
                 this oracle."
                    .into(),
            ));
        }
        inner.suite_runs.keep_suite().await?;
        let row = CampaignRow {
            id,
            reason,
            of_suite: asked.suite,
            of_people: asked.people,
            created_by: by.map_or(NAME_OF_OPERATOR, |by| &by.name).to_owned(),
            created_us: now_us(),
            hardware_class: class,
            oracle: ocb_core::oracle::VERSION,
            suite: inner.suite.sha256.clone(),
            queued_us: None,
            cancelled_us: None,
            ended_us: None,
        };
        let subject = subject(&row.id);
        let note = Note { actor: &row.created_by, action: "campaign created", subject: &subject, detail: &row.reason };
        let new = inner.store.add_campaign(&row, note).await?;
        // Whoever asked may be gone before all of it is queued; closing waits for it.
        let (sender, filled) = tokio::sync::oneshot::channel();
        let (engine, id) = (self.clone(), row.id.clone());
        inner.tasks.spawn(async move {
            // Nobody is left to be told: the log is, and the next start takes the campaign up.
            if let Err(Err(e)) = sender.send(engine.fill_campaign(&id).await) {
                tracing::error!("campaign {id}: not all of it was queued: {e}");
            }
        });
        filled.await.unwrap_or_else(|_| Err(EngineError::Fault("Queueing the campaign failed.".into())))?;
        Ok((self.campaign(&row.id, viewer.as_deref()).await?, new))
    }

    /// Campaigns, newest first, without their results.
    #[boxed]
    pub async fn campaigns(&self, page: &Page) -> Result<Part<CampaignInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.campaigns(&from, limit + 1).await?;
        let part = Part::of(rows, limit, |row: &CampaignRow| Cursor::behind(row.created_us, &row.id));
        let mut entries = Vec::new();
        for row in part.entries {
            entries.push(self.inner.campaigns.campaign_info(row).await?);
        }
        Ok(Part { entries, next: part.next })
    }

    /// One campaign with the results that the viewer may see.
    #[boxed]
    pub async fn campaign(&self, id: &str, viewer: Option<&str>) -> Result<CampaignInfo> {
        // The state before the results: where it is the end, they are all of them.
        let info = self.inner.campaigns.campaign_info(self.inner.campaigns.campaign_row(id).await?).await?;
        let (store, objects) = (&self.inner.store, &self.inner.objects);
        let results = side_by_side(store, objects, &store.campaign_runs(id).await?, viewer).await?;
        Ok(CampaignInfo { results, ..info })
    }

    /// Ends what waits of a campaign; the run at work comes to its end. One that has ended stays as it is.
    #[boxed]
    pub async fn cancel_campaign(&self, by: Option<&AccountInfo>, id: &str) -> Result<CampaignInfo> {
        self.inner.campaigns.campaign_row(id).await?;
        let actor = by.map_or(NAME_OF_OPERATOR, |by| by.name.as_str());
        self.inner.campaigns.cancel_campaign(id, actor, "").await?;
        self.campaign(id, by.map(AccountInfo::owner).as_deref()).await
    }

    /// Queues what is missing of a campaign.
    #[boxed]
    async fn fill_campaign(&self, id: &str) -> Result<()> {
        let inner = &self.inner;
        {
            let _alone = inner.store.locks.alone(Lock::Planning).await?;
            let row = inner.campaigns.campaign_row(id).await?;
            let own = inner.store.campaign_runs(id).await?;
            for due in inner.campaigns.due(row.of_suite, row.of_people, &row.hardware_class, &own).await? {
                if inner.work.closing() {
                    return Ok(());
                }
                if inner.campaigns.campaign_row(id).await?.cancelled_us.is_some() {
                    break;
                }
                let asking = RunContext {
                    owner: due.owner(),
                    priority: BACKGROUND,
                    suite: Some(inner.suite.sha256.as_str()).filter(|_| due.of_suite),
                    campaign: Some(id),
                    rerun_of: due.repeats.as_ref().map(|run| run.id.as_str()),
                    ..RunContext::default()
                };
                match inner.runs.enqueue(due.spec.clone(), asking).await {
                    Err(e) if due.can_be_left_out(&e) => {
                        tracing::warn!("campaign {id}: a run cannot be repeated: {e}");
                    }
                    queued => drop(queued?),
                }
            }
        }
        inner.store.campaign_is_queued(id).await?;
        if inner.campaigns.campaign_row(id).await?.cancelled_us.is_some() {
            inner.campaigns.end_waiting_of(id).await?;
        }
        inner.campaigns.end_campaign_when_through(id).await
    }

    /// Takes up what an ended process left: what is half queued is completed, what is for another machine, suite or oracle ends. A
    /// fault of one campaign keeps nothing else from beginning.
    pub(crate) async fn take_up_campaigns(&self) {
        let open = match self.inner.store.open_campaigns().await {
            Ok(open) => open,
            Err(e) => return tracing::error!("campaigns could not be resumed: {e}"),
        };
        for row in open {
            if let Err(e) = self.take_up(&row).await {
                tracing::error!("campaign {}: it could not be resumed: {e}", row.id);
            }
        }
    }

    /// While this service keeps house, campaigns that another service could not complete.
    pub(crate) async fn look_after_campaigns(self) {
        let house = &self.inner.house;
        while house.here().await {
            tokio::select! {
                () = tokio::time::sleep(LOOK) => {}
                () = house.gone() => continue,
            }
            if let Err(e) = self.complete_campaigns().await {
                tracing::error!("campaigns could not be completed: {e}");
            }
        }
    }

    /// Queues what is missing of them, and ends those whose last run has ended.
    pub(crate) async fn complete_campaigns(&self) -> Result<()> {
        let inner = &self.inner;
        for row in inner.store.open_campaigns().await? {
            if row.queued_us.is_some() || row.cancelled_us.is_some() {
                inner.campaigns.end_campaign_when_through(&row.id).await?;
            } else if inner.campaigns.is_for_now(&row) {
                self.fill_campaign(&row.id).await?;
            }
        }
        Ok(())
    }

    async fn take_up(&self, row: &CampaignRow) -> Result<()> {
        let inner = &self.inner;
        for run in inner.store.campaign_runs(&row.id).await? {
            inner.campaigns.take_out_failing(row, &run).await?;
        }
        if row.cancelled_us.is_some() {
            inner.campaigns.end_waiting_of(&row.id).await?;
        } else if !inner.campaigns.is_for_now(row) {
            let told = "The hardware classes, the suite or the oracle of the service have changed.";
            return inner.campaigns.cancel_campaign(&row.id, THE_SERVICE, told).await;
        } else if row.queued_us.is_none() {
            return self.fill_campaign(&row.id).await;
        }
        inner.campaigns.end_campaign_when_through(&row.id).await
    }
}

impl Campaigns {
    /// For a class on which runs are measured here, this oracle and this suite.
    fn is_for_now(&self, row: &CampaignRow) -> bool {
        self.suite_runs.classes.names().contains(&row.hardware_class)
            && row.oracle == ocb_core::oracle::VERSION
            && row.suite == self.suite_runs.suite.sha256
    }

    pub(crate) async fn campaign_row(&self, id: &str) -> Result<CampaignRow> {
        let row = self.store.campaign(id).await?;
        row.ok_or_else(|| EngineError::NotFound(format!("There is no campaign {id:?}; check the link.")))
    }

    async fn campaign_info(&self, row: CampaignRow) -> Result<CampaignInfo> {
        let runs = self.store.campaign_counts(&row.id).await?;
        let suites = self.store.suites().await?;
        let suite_version = suites.iter().find(|suite| suite.sha256 == row.suite).map_or(0, |s| s.document.version);
        Ok(CampaignInfo {
            state: state(&row, runs),
            suite: row.of_suite,
            people: row.of_people,
            suite_version,
            id: row.id,
            reason: row.reason,
            created_by: row.created_by,
            created_us: row.created_us,
            hardware_class: row.hardware_class,
            oracle: row.oracle,
            suite_sha256: row.suite,
            runs,
            ended_us: row.ended_us,
            results: Vec::new(),
        })
    }

    async fn cancel_campaign(&self, id: &str, actor: &str, detail: &str) -> Result<()> {
        let subject = subject(id);
        let note = Note { actor, action: "campaign cancelled", subject: &subject, detail };
        if self.store.cancel_campaign(id, note).await? {
            self.end_waiting_of(id).await?;
        }
        self.end_campaign_when_through(id).await
    }

    async fn end_waiting_of(&self, id: &str) -> Result<()> {
        for run in self.store.end_waiting_of_campaign(id).await? {
            self.run_events.tell(&self.store, &run, plain_event(State::Cancelled, 0)).await?;
        }
        Ok(())
    }

    /// A run has ended; if it belongs to a campaign, that takes note of it.
    #[boxed]
    pub async fn run_of_campaign_ended(&self, id: &str) -> Result<()> {
        let Some(run) = self.store.run(id).await? else { return Ok(()) };
        let Some(campaign) = &run.campaign else { return Ok(()) };
        let row = self.campaign_row(campaign).await?;
        self.take_out_failing(&row, &run).await?;
        self.end_campaign_when_through(campaign).await
    }

    /// When nothing of it waits, those whose runs were repeated are told, and the campaign has ended. Who is told is told before that
    /// is noted: after a kill rather twice than never.
    #[boxed]
    pub async fn end_campaign_when_through(&self, id: &str) -> Result<()> {
        // Of two that find nothing waiting, one tells.
        let _alone = self.store.locks.alone(Lock::Campaigns).await?;
        let row = self.campaign_row(id).await?;
        let runs = self.store.campaign_counts(id).await?;
        let filled = row.queued_us.is_some() || row.cancelled_us.is_some();
        if row.ended_us.is_some() || !filled || runs.waiting + runs.running > 0 {
            return Ok(());
        }
        let mut accounts: BTreeMap<String, u32> = BTreeMap::new();
        for run in self.store.campaign_runs(id).await?.iter().filter(|run| run.state == State::Done) {
            if let Some(account) = run.owner.as_deref().and_then(|owner| Owner::of(owner).account()) {
                *accounts.entry(account.to_owned()).or_default() += 1;
            }
        }
        for (account, count) in accounts {
            let runs = if count == 1 {
                "One of your public runs was".into()
            } else {
                format!("{count} of your public runs were")
            };
            let text = format!(
                "{runs} measured again: {} Old and new results are shown side by side; the old ones do not change.",
                sentence(&row.reason)
            );
            let told = notice("Your public runs were measured again", &text, &format!("/campaigns/{id}"));
            self.outbox.notify(&account, &told).await?;
        }
        self.store.end_campaign(id).await
    }
}

/// Old and new results as CSV with a header line.
pub fn campaign_csv(results: &[Compared]) -> Result<Vec<u8>> {
    Ok(ocb_lab::columns::csv(&columns::campaign_parquet(results)?)?)
}

/// With a full stop, so that another sentence may follow.
fn sentence(text: &str) -> String {
    let closed = text.ends_with(['.', '!', '?']);
    if closed { text.to_owned() } else { format!("{text}.") }
}

fn state(row: &CampaignRow, runs: CampaignRuns) -> State {
    if row.cancelled_us.is_some() {
        State::Cancelled
    } else if row.queued_us.is_none() || runs.waiting + runs.running > 0 {
        State::Running
    } else {
        State::Done
    }
}

fn subject(id: &str) -> String {
    format!("campaign:{id}")
}
