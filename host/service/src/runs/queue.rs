//! The queue: which run is next.

use sqlx::AnyConnection;

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end, withdraw};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, Outcome};
use crate::model::State;
use crate::runs::events_sql::append_event;
use crate::runs::log::plain_event;
use crate::runs::priority::{BACKGROUND, IDLE};
use crate::runs::sql::state_name;
use crate::store::{Store, now_us};

/// The queued and running work of an owner or an address.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Granted {
    /// Queued runs.
    pub waiting: u64,
    /// Measuring time of queued and running runs.
    pub seconds: f64,
}

macro_rules! granted {
    ($whose:literal) => {
        concat!(
            "SELECT CAST(COALESCE(SUM(CASE WHEN state = 'queued' THEN 1 ELSE 0 END), 0) AS BIGINT), ",
            "COALESCE(SUM(granted_seconds), 0.0) FROM runs ",
            "WHERE state IN ('queued', 'running') AND campaign IS NULL AND ",
            $whose,
            " = $1"
        )
    };
}

impl Store {
    /// Begins an attempt at the next run: smallest priority, then whose turn was longest ago, then the oldest. Idle work is not
    /// among them.
    pub async fn begin_run(&self, worker: &Worker) -> Result<Option<Attempt>> {
        self.begin_between(worker, i64::MIN, BACKGROUND).await
    }

    /// Begins an attempt at a run that the service queued for when it is idle.
    pub async fn begin_idle_run(&self, worker: &Worker) -> Result<Option<Attempt>> {
        self.begin_between(worker, IDLE, IDLE).await
    }

    async fn begin_between(&self, worker: &Worker, smallest: i64, largest: i64) -> Result<Option<Attempt>> {
        // Another worker may take what this one has chosen; then it chooses again.
        loop {
            let next: Option<String> = sqlx::query_scalar(concat!(
                "SELECT r.id FROM runs r LEFT JOIN served s ON s.owner = r.turn ",
                "WHERE r.state = 'queued' AND r.priority BETWEEN $1 AND $2 AND ",
                at_rest!("measure", "r.id"),
                " ORDER BY r.priority, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1"
            ))
            .bind(smallest)
            .bind(largest)
            .fetch_optional(&self.pool)
            .await?;
            let Some(next) = next else { return Ok(None) };
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, Kind::Measure, &next, worker).await? else { continue };
            let turn: Option<String> = sqlx::query_scalar(
                "UPDATE runs SET state = 'running', attempts = attempts + 1, started_us = $1, message = NULL \
                 WHERE id = $2 AND state = 'queued' RETURNING turn",
            )
            .bind(now_us())
            .bind(&next)
            .fetch_optional(&mut *transaction)
            .await?;
            let Some(turn) = turn else { continue };
            served(&mut transaction, &turn).await?;
            transaction.commit().await?;
            return Ok(Some(attempt));
        }
    }

    /// Puts a run under way back without counting the attempt: it was asked to stop, and not because of what it did. False when
    /// the attempt is not the current one.
    pub async fn put_back_run(&self, attempt: &Attempt) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::PutBack).await? {
            return Ok(false);
        }
        let text = "UPDATE runs SET state = 'queued', attempts = attempts - 1 WHERE id = $1 AND state = 'running'";
        sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        append_event(&mut transaction, &attempt.job, &mut plain_event(State::Queued, 0)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Ends a run that another worker is at; false when none is.
    pub async fn withdraw_run(&self, id: &str, here: &Worker, to: State, message: Option<&str>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !withdraw(&mut transaction, Kind::Measure, id, here).await? {
            return Ok(false);
        }
        let text = "UPDATE runs SET state = $1, message = $2, finished_us = $3 WHERE id = $4 AND state = 'running'";
        let query = sqlx::query(text).bind(state_name(to)).bind(message).bind(now_us()).bind(id);
        query.execute(&mut *transaction).await?;
        append_event(&mut transaction, id, &mut plain_event(to, 0)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Of this owner, without runs of campaigns.
    pub async fn granted_to(&self, owner: &str) -> Result<Granted> {
        self.granted(granted!("owner"), owner).await
    }

    /// Of all visitors from this address.
    pub async fn granted_at(&self, address: &str) -> Result<Granted> {
        self.granted(granted!("address"), address).await
    }

    async fn granted(&self, text: &'static str, whose: &str) -> Result<Granted> {
        let (waiting, seconds): (i64, f64) = sqlx::query_as(text).bind(whose).fetch_one(&self.pool).await?;
        Ok(Granted { waiting: waiting as u64, seconds })
    }

    /// Runs under way that others wait for: their ids, when they were started and what they were expected to take.
    pub async fn running(&self) -> Result<Vec<(String, i64, f64)>> {
        let text = "SELECT id, COALESCE(started_us, 0), expected_seconds FROM runs \
                    WHERE state = 'running' AND priority <= $1";
        Ok(sqlx::query_as(text).bind(BACKGROUND).fetch_all(&self.pool).await?)
    }
}

/// Who has this turn was served now.
pub(crate) async fn served(connection: &mut AnyConnection, turn: &str) -> Result<()> {
    let text = "INSERT INTO served (owner, served_us) VALUES ($1, $2) \
                ON CONFLICT (owner) DO UPDATE SET served_us = excluded.served_us";
    sqlx::query(text).bind(turn).bind(now_us()).execute(connection).await?;
    Ok(())
}
