//! Campaigns and their runs.

use sqlx::Row;
use sqlx::any::AnyRow;

use crate::Result;
use crate::audit::Note;
use crate::audit::append;
use crate::model::{CampaignRuns, Cursor, RunSpec, Stage, State};
use crate::runs::sql::RunRow;
use crate::runs::sql::{named_state, read_run, select_runs};
use crate::store::{Store, now_us, to_json};

/// One row of the table of campaigns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CampaignRow {
    /// UUIDv7.
    pub id: String,
    /// Why it was made.
    pub reason: String,
    /// It measures the suite.
    pub of_suite: bool,
    /// It measures public runs again.
    pub of_people: bool,
    /// Name of who made it.
    pub created_by: String,
    /// When it was made.
    pub created_us: i64,
    /// The hardware class that it measures on.
    pub hardware_class: String,
    /// Version of the oracle that judges.
    pub oracle: u32,
    /// The suite, by its hash.
    pub suite: String,
    /// Since when all of it is in the queue.
    pub queued_us: Option<i64>,
    /// When it was cancelled.
    pub cancelled_us: Option<i64>,
    /// Since when nothing of it waits and everybody is told.
    pub ended_us: Option<i64>,
}

macro_rules! select_campaigns {
    ($rest:literal) => {
        concat!(
            "SELECT id, reason, of_suite, of_people, created_by, created_us, hardware_class, oracle, suite, queued_us, ",
            "cancelled_us, ended_us FROM campaigns ",
            $rest
        )
    };
}

impl Store {
    /// Adds a campaign, and notes it; false when there is one of this id.
    pub async fn add_campaign(&self, row: &CampaignRow, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let added = sqlx::query(
            "INSERT INTO campaigns (id, reason, of_suite, of_people, created_by, created_us, hardware_class, oracle, suite) \
             VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9) ON CONFLICT (id) DO NOTHING",
        )
        .bind(&row.id)
        .bind(&row.reason)
        .bind(i64::from(row.of_suite))
        .bind(i64::from(row.of_people))
        .bind(&row.created_by)
        .bind(row.created_us)
        .bind(&row.hardware_class)
        .bind(i64::from(row.oracle))
        .bind(&row.suite)
        .execute(&mut *transaction)
        .await?;
        let new = added.rows_affected() == 1;
        if new {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(new)
    }

    /// One campaign.
    pub async fn campaign(&self, id: &str) -> Result<Option<CampaignRow>> {
        let row = sqlx::query(select_campaigns!("WHERE id = $1")).bind(id).fetch_optional(&self.pool).await?;
        row.as_ref().map(read).transpose()
    }

    /// Campaigns from this place on, newest first, at most `limit`.
    pub async fn campaigns(&self, from: &Cursor, limit: usize) -> Result<Vec<CampaignRow>> {
        let rows = sqlx::query(select_campaigns!(
            "WHERE (created_us, id) < ($1, $2) ORDER BY created_us DESC, id DESC LIMIT $3"
        ))
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read).collect()
    }

    /// Those that have not ended, oldest first.
    pub async fn open_campaigns(&self) -> Result<Vec<CampaignRow>> {
        let text = select_campaigns!("WHERE ended_us IS NULL ORDER BY created_us, id");
        let rows = sqlx::query(text).fetch_all(&self.pool).await?;
        rows.iter().map(read).collect()
    }

    /// Notes that all of a campaign is in the queue.
    pub async fn campaign_is_queued(&self, id: &str) -> Result<()> {
        let text = "UPDATE campaigns SET queued_us = $1 WHERE id = $2 AND queued_us IS NULL";
        sqlx::query(text).bind(now_us()).bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// Cancels a campaign that has not ended, and notes it; false when it has, or is cancelled already.
    pub async fn cancel_campaign(&self, id: &str, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let text = "UPDATE campaigns SET cancelled_us = $1 WHERE id = $2 AND ended_us IS NULL AND cancelled_us IS NULL";
        let done = sqlx::query(text).bind(now_us()).bind(id).execute(&mut *transaction).await?;
        let cancelled = done.rows_affected() == 1;
        if cancelled {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(cancelled)
    }

    /// Ends the runs of a campaign that wait, and gives their ids.
    pub async fn end_waiting_of_campaign(&self, id: &str) -> Result<Vec<String>> {
        let text = "UPDATE runs SET state = 'cancelled', finished_us = $1 WHERE campaign = $2 AND state = 'queued' \
                    RETURNING id";
        Ok(sqlx::query_scalar(text).bind(now_us()).bind(id).fetch_all(&self.pool).await?)
    }

    /// Notes that a campaign has ended.
    pub async fn end_campaign(&self, id: &str) -> Result<()> {
        let text = "UPDATE campaigns SET ended_us = $1 WHERE id = $2 AND ended_us IS NULL";
        sqlx::query(text).bind(now_us()).bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// The runs of a campaign in the order in which they were asked for.
    pub async fn campaign_runs(&self, id: &str) -> Result<Vec<RunRow>> {
        let text = select_runs!("WHERE campaign = $1 ORDER BY created_us, id");
        let rows = sqlx::query(text).bind(id).fetch_all(&self.pool).await?;
        rows.iter().map(read_run).collect()
    }

    /// How many of its runs are in which state.
    pub async fn campaign_counts(&self, id: &str) -> Result<CampaignRuns> {
        let text = "SELECT state, COUNT(*), SUM(expected_seconds) FROM runs WHERE campaign = $1 GROUP BY state";
        let rows: Vec<(String, i64, f64)> = sqlx::query_as(text).bind(id).fetch_all(&self.pool).await?;
        let mut counts = CampaignRuns::default();
        for (state, count, seconds) in rows {
            let state = named_state(&state)?;
            if matches!(state, State::Queued | State::Running) {
                counts.expected_seconds += seconds;
            }
            let counted = match state {
                State::Queued => &mut counts.waiting,
                State::Running => &mut counts.running,
                State::Done => &mut counts.done,
                State::Failed => &mut counts.failed,
                State::Cancelled => &mut counts.cancelled,
            };
            *counted = count as u32;
        }
        Ok(counts)
    }

    /// The run that repeats this one in a campaign.
    pub async fn repeat_of(&self, campaign: &str, run: &str) -> Result<Option<RunRow>> {
        let text = select_runs!("WHERE campaign = $1 AND rerun_of = $2");
        let row = sqlx::query(text).bind(campaign).bind(run).fetch_optional(&self.pool).await?;
        row.as_ref().map(read_run).transpose()
    }

    /// Runs of accounts that agree to have them measured again, which wait, are at work or have results; the newest first.
    pub async fn runs_of_the_agreeing(&self) -> Result<Vec<RunRow>> {
        let rows = sqlx::query(select_runs!(
            "WHERE suite IS NULL AND featured = 0 AND state IN ('queued', 'running', 'done') \
             AND owner IN (SELECT 'account:' || id FROM accounts WHERE agrees_to_reruns = 1) \
             ORDER BY created_us DESC, id DESC"
        ))
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_run).collect()
    }

    /// Waiting runs of suites and campaigns, which nobody waits for.
    pub async fn waiting_of_the_service(&self) -> Result<Vec<RunRow>> {
        let rows = sqlx::query(select_runs!(
            "WHERE state = 'queued' AND (suite IS NOT NULL OR campaign IS NOT NULL) ORDER BY created_us, id"
        ))
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_run).collect()
    }

    /// Asks less of a run that waits; false when it waits no more.
    pub async fn ask_less(&self, id: &str, spec: &RunSpec, stages: &[Stage]) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let done = sqlx::query("UPDATE runs SET spec = $1 WHERE id = $2 AND state = 'queued'")
            .bind(to_json(spec)?)
            .bind(id)
            .execute(&mut *transaction)
            .await?;
        if done.rows_affected() == 0 {
            return Ok(false);
        }
        sqlx::query("DELETE FROM run_stages WHERE run_id = $1").bind(id).execute(&mut *transaction).await?;
        for (position, stage) in stages.iter().enumerate() {
            sqlx::query("INSERT INTO run_stages (run_id, position, stage) VALUES ($1, $2, $3)")
                .bind(id)
                .bind(position as i64)
                .bind(to_json(stage)?)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(true)
    }
}

fn read(row: &AnyRow) -> Result<CampaignRow> {
    Ok(CampaignRow {
        id: row.try_get("id")?,
        reason: row.try_get("reason")?,
        of_suite: row.try_get::<i64, _>("of_suite")? != 0,
        of_people: row.try_get::<i64, _>("of_people")? != 0,
        created_by: row.try_get("created_by")?,
        created_us: row.try_get("created_us")?,
        hardware_class: row.try_get("hardware_class")?,
        oracle: row.try_get::<i64, _>("oracle")? as u32,
        suite: row.try_get("suite")?,
        queued_us: row.try_get("queued_us")?,
        cancelled_us: row.try_get("cancelled_us")?,
        ended_us: row.try_get("ended_us")?,
    })
}
