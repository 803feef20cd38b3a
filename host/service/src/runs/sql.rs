//! Runs and their stages.

use sqlx::any::AnyRow;
use sqlx::{Any, Executor, Row};

use crate::attempts::Attempt;
use crate::attempts::sql::while_current;
use crate::model::{Cursor, Environment, Preview, RunSpec, SetInfo, Stage, State, Visibility};
use crate::runs::stored_spec::read_spec;
use crate::store::{Store, from_json, now_us, to_json};
use crate::visibility::sql::visibility;
use crate::{EngineError, Result};

/// One row of the table of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct RunRow {
    /// UUIDv7.
    pub id: String,
    /// Who asked; absent for runs of the service itself.
    pub owner: Option<String>,
    /// May be shown on the start page.
    pub featured: bool,
    /// It has a plugin that was not public, so that only its owner sees it, whatever they decide. It stays so when the plugin
    /// is published: that must not publish what its author measured before.
    pub private: bool,
    /// Who else sees it, as its owner decided.
    pub visibility: Visibility,
    /// Smaller is served first.
    pub priority: i64,
    /// Whose turn it takes; the empty text for runs of the service itself and of campaigns, which take nobody's.
    pub turn: String,
    /// Network of the request, if known.
    pub address: Option<String>,
    /// Longest measuring time: budget times algorithms.
    pub granted_seconds: f64,
    /// The suite that it belongs to, by its hash.
    pub suite: Option<String>,
    /// The campaign that it belongs to.
    pub campaign: Option<String>,
    /// The run that it repeats there; its owner may have taken that away since.
    pub rerun_of: Option<String>,
    /// State.
    pub state: State,
    /// How often it was started.
    pub attempts: u32,
    /// Why it failed or was cancelled.
    pub message: Option<String>,
    /// What was asked, defaults filled in.
    pub spec: RunSpec,
    /// Name of object A when the run was asked for.
    pub object_a_name: String,
    /// Name of object B.
    pub object_b_name: String,
    /// The configuration set, once known.
    pub set: Option<SetInfo>,
    /// Blob of the set.
    pub set_blob: Option<String>,
    /// The machine, once measured.
    pub environment: Option<Environment>,
    /// What its results are a preview of; absent when all configurations were measured.
    pub preview: Option<Preview>,
    /// What its seed is drawn from; absent in runs of older versions.
    pub secret: Option<String>,
    /// What it was expected to take when it was asked for.
    pub expected_seconds: f64,
    /// When it was asked for.
    pub created_us: i64,
    /// When it ended.
    pub finished_us: Option<i64>,
}

impl RunRow {
    /// Id of object A.
    pub fn object_a(&self) -> &str {
        &self.spec.object_a
    }

    /// Id of object B.
    pub fn object_b(&self) -> &str {
        self.spec.object_b.as_deref().unwrap_or(&self.spec.object_a)
    }

    /// A preview of which all configurations are to be measured now.
    pub fn is_refined(&self) -> bool {
        self.preview.is_some() && !self.spec.is_partial()
    }

    /// What a run that ended so is from then on: a preview stays one when no more could be measured.
    pub fn after(&self, ended: State) -> State {
        match ended {
            State::Failed | State::Cancelled if self.is_refined() => State::Done,
            other => other,
        }
    }
}

/// All columns of [`RunRow`], in any order: they are read by name.
macro_rules! select_runs {
    ($rest:literal) => {
        concat!(
            "SELECT id, owner, featured, private, visibility, priority, turn, address, granted_seconds, state, attempts, message, spec, object_a_name, object_b_name, ",
            "set_info, set_blob, environment, preview, secret, expected_seconds, created_us, finished_us, suite, campaign, rerun_of FROM runs ",
            $rest
        )
    };
}
pub(crate) use select_runs;

impl Store {
    /// Queues a run with its stages; false when its owner has used this key of a request before, or its campaign
    /// repeats the same run already.
    pub async fn add_run(&self, run: &RunRow, stages: &[Stage], key: Option<&str>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let added = sqlx::query(
            "INSERT INTO runs (id, owner, featured, priority, state, attempts, spec, object_a_name, object_b_name, \
             secret, expected_seconds, created_us, private, request_key, visibility, suite, campaign, rerun_of, turn, \
             address, granted_seconds, hardware_class) \
             VALUES ($1, $2, $3, $4, $5, 0, $6, $7, $8, $9, $10, $11, $12, $13, $14, $15, $16, $17, $18, $19, $20, $21) \
             ON CONFLICT DO NOTHING",
        )
        .bind(&run.id)
        .bind(run.owner.as_deref())
        .bind(i64::from(run.featured))
        .bind(run.priority)
        .bind(state_name(run.state))
        .bind(to_json(&run.spec)?)
        .bind(&run.object_a_name)
        .bind(&run.object_b_name)
        .bind(run.secret.as_deref())
        .bind(run.expected_seconds)
        .bind(run.created_us)
        .bind(i64::from(run.private))
        .bind(key)
        .bind(run.visibility.name())
        .bind(run.suite.as_deref())
        .bind(run.campaign.as_deref())
        .bind(run.rerun_of.as_deref())
        .bind(&run.turn)
        .bind(run.address.as_deref())
        .bind(run.granted_seconds)
        .bind(run.spec.hardware_class.as_deref())
        .execute(&mut *transaction)
        .await?;
        if added.rows_affected() == 0 {
            return Ok(false);
        }
        for (position, stage) in stages.iter().enumerate() {
            sqlx::query("INSERT INTO run_stages (run_id, position, stage) VALUES ($1, $2, $3)")
                .bind(&run.id)
                .bind(position as i64)
                .bind(to_json(stage)?)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(true)
    }

    /// The run that its owner asked for under this key.
    pub async fn run_of_request(&self, owner: &str, key: &str) -> Result<Option<RunRow>> {
        let row = sqlx::query(select_runs!("WHERE owner = $1 AND request_key = $2"))
            .bind(owner)
            .bind(key)
            .fetch_optional(&self.pool)
            .await?;
        row.as_ref().map(read_run).transpose()
    }

    /// Queues a run that has ended again, with another request, another secret and a log that begins anew. Its results
    /// stay until others replace them. False when it has not ended.
    pub async fn queue_again(&self, run: &RunRow, stages: &[Stage]) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let queued = sqlx::query(
            "UPDATE runs SET state = 'queued', attempts = 0, message = NULL, spec = $1, secret = $2, \
             expected_seconds = $3, finished_us = NULL, granted_seconds = $5, last_event = 0, prepared = 0 WHERE id = $4 AND state = 'done'",
        )
        .bind(to_json(&run.spec)?)
        .bind(run.secret.as_deref())
        .bind(run.expected_seconds)
        .bind(&run.id)
        .bind(run.granted_seconds)
        .execute(&mut *transaction)
        .await?;
        if queued.rows_affected() == 0 {
            return Ok(false);
        }
        sqlx::query("DELETE FROM run_events WHERE run_id = $1").bind(&run.id).execute(&mut *transaction).await?;
        for (position, stage) in stages.iter().enumerate() {
            sqlx::query("UPDATE run_stages SET stage = $1 WHERE run_id = $2 AND position = $3")
                .bind(to_json(stage)?)
                .bind(&run.id)
                .bind(position as i64)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(true)
    }

    /// One run.
    pub async fn run(&self, id: &str) -> Result<Option<RunRow>> {
        find_run(&self.pool, id).await
    }

    /// The run, or that there is none.
    pub async fn run_row(&self, id: &str) -> Result<RunRow> {
        self.run(id).await?.ok_or_else(|| no_run(id))
    }

    /// The owner's runs from this place on, newest first, at most `limit`.
    pub async fn runs_of(&self, owner: &str, from: &Cursor, limit: usize) -> Result<Vec<RunRow>> {
        let rows = sqlx::query(select_runs!(
            "WHERE owner = $1 AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4"
        ))
        .bind(owner)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_run).collect()
    }

    /// The newest finished runs that are public, and those of this owner; without those of suites.
    pub async fn finished_runs(&self, owner: Option<&str>, limit: i64) -> Result<Vec<RunRow>> {
        let rows = sqlx::query(select_runs!(
            "WHERE state = 'done' AND suite IS NULL AND (visibility = 'public' OR owner = $1) \
             ORDER BY finished_us DESC, id DESC LIMIT $2"
        ))
        .bind(owner)
        .bind(limit)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_run).collect()
    }

    /// The newest finished run for the start page, or while there is none, the one that is to become it.
    pub async fn newest_featured(&self) -> Result<Option<RunRow>> {
        let row = sqlx::query(select_runs!(
            "WHERE featured = 1 AND state IN ('queued', 'running', 'done') \
             ORDER BY CASE state WHEN 'done' THEN 0 ELSE 1 END, finished_us DESC, id DESC LIMIT 1"
        ))
        .fetch_optional(&self.pool)
        .await?;
        row.as_ref().map(read_run).transpose()
    }

    /// How many runs for the start page are queued, under way or done.
    pub async fn featured_count(&self) -> Result<i64> {
        Ok(sqlx::query_scalar(
            "SELECT COUNT(*) FROM runs WHERE featured = 1 AND state IN ('queued', 'running', 'done')",
        )
        .fetch_one(&self.pool)
        .await?)
    }

    /// Ends a run that waits; false when it does not.
    pub async fn end_waiting_run(&self, id: &str, to: State, message: Option<&str>) -> Result<bool> {
        let text = "UPDATE runs SET state = $1, message = $2, finished_us = $3 WHERE id = $4 AND state = 'queued'";
        let done = sqlx::query(text).bind(state_name(to)).bind(message).bind(now_us()).bind(id);
        Ok(done.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// Notes the run's configuration set; false when the attempt is not the current one.
    pub async fn set_of_run(&self, attempt: &Attempt, info: &SetInfo, blob: &str) -> Result<bool> {
        let text = concat!("UPDATE runs SET set_info = $1, set_blob = $2 WHERE id = $3 AND ", while_current!("$4"));
        let done = sqlx::query(text).bind(to_json(info)?).bind(blob).bind(&attempt.job).bind(&attempt.id);
        Ok(done.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// Records the request with the configurations' seed that was drawn for it; false when the attempt is not the current one.
    pub async fn spec_of_run(&self, attempt: &Attempt, spec: &RunSpec) -> Result<bool> {
        let text = concat!("UPDATE runs SET spec = $1 WHERE id = $2 AND ", while_current!("$3"));
        let done = sqlx::query(text).bind(to_json(spec)?).bind(&attempt.job).bind(&attempt.id);
        Ok(done.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// The run's stages in order.
    pub async fn stages(&self, id: &str) -> Result<Vec<Stage>> {
        let rows: Vec<String> = sqlx::query_scalar("SELECT stage FROM run_stages WHERE run_id = $1 ORDER BY position")
            .bind(id)
            .fetch_all(&self.pool)
            .await?;
        rows.iter().map(|stage| from_json(stage)).collect()
    }
}

/// One run.
pub(crate) async fn find_run(from: impl Executor<'_, Database = Any>, id: &str) -> Result<Option<RunRow>> {
    let row = sqlx::query(select_runs!("WHERE id = $1")).bind(id).fetch_optional(from).await?;
    row.as_ref().map(read_run).transpose()
}

pub(crate) fn read_run(row: &AnyRow) -> Result<RunRow> {
    let set: Option<String> = row.try_get("set_info")?;
    let environment: Option<String> = row.try_get("environment")?;
    let preview: Option<String> = row.try_get("preview")?;
    Ok(RunRow {
        id: row.try_get("id")?,
        owner: row.try_get("owner")?,
        featured: row.try_get::<i64, _>("featured")? != 0,
        private: row.try_get::<i64, _>("private")? != 0,
        visibility: visibility(row.try_get("visibility")?)?,
        priority: row.try_get("priority")?,
        turn: row.try_get("turn")?,
        address: row.try_get("address")?,
        granted_seconds: row.try_get("granted_seconds")?,
        suite: row.try_get("suite")?,
        campaign: row.try_get("campaign")?,
        rerun_of: row.try_get("rerun_of")?,
        state: named_state(row.try_get("state")?)?,
        attempts: row.try_get::<i64, _>("attempts")? as u32,
        message: row.try_get("message")?,
        spec: read_spec(row.try_get("spec")?)?,
        object_a_name: row.try_get("object_a_name")?,
        object_b_name: row.try_get("object_b_name")?,
        set: set.map(|text| from_json(&text)).transpose()?,
        set_blob: row.try_get("set_blob")?,
        environment: environment.map(|text| from_json(&text)).transpose()?,
        preview: preview.map(|text| from_json(&text)).transpose()?,
        secret: row.try_get("secret")?,
        expected_seconds: row.try_get("expected_seconds")?,
        created_us: row.try_get("created_us")?,
        finished_us: row.try_get("finished_us")?,
    })
}

/// There is no such run, or not for who asks: both sound alike.
pub fn no_run(run: &str) -> EngineError {
    EngineError::NotFound(format!("There is no run {run:?}; check the link."))
}

pub(crate) fn state_name(state: State) -> &'static str {
    match state {
        State::Queued => "queued",
        State::Running => "running",
        State::Done => "done",
        State::Failed => "failed",
        State::Cancelled => "cancelled",
    }
}

pub(crate) fn named_state(name: &str) -> Result<State> {
    match name {
        "queued" => Ok(State::Queued),
        "running" => Ok(State::Running),
        "done" => Ok(State::Done),
        "failed" => Ok(State::Failed),
        "cancelled" => Ok(State::Cancelled),
        other => Err(EngineError::Fault(format!("The database holds a run in the unknown state {other:?}."))),
    }
}
