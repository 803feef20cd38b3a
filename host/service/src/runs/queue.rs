//! The queue: which run is next, and what becomes of interrupted ones.

use crate::Result;
use crate::runs::priority::{BACKGROUND, IDLE};
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
    /// Takes the next run: smallest priority, then whose turn was longest ago, then the oldest. Idle work is not among them.
    pub async fn claim(&self) -> Result<Option<String>> {
        self.claim_between(i64::MIN, BACKGROUND).await
    }

    /// Takes a run that the service queued for when it is idle.
    pub async fn claim_idle(&self) -> Result<Option<String>> {
        self.claim_between(IDLE, IDLE).await
    }

    async fn claim_between(&self, smallest: i64, largest: i64) -> Result<Option<String>> {
        let now = now_us();
        let claimed: Option<(String, String)> = sqlx::query_as(
            "UPDATE runs SET state = 'running', attempts = attempts + 1, started_us = $1, message = NULL \
             WHERE state = 'queued' AND id = ( \
                 SELECT r.id FROM runs r LEFT JOIN served s ON s.owner = r.turn \
                 WHERE r.state = 'queued' AND r.priority BETWEEN $2 AND $3 \
                 ORDER BY r.priority, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1) \
             RETURNING id, turn",
        )
        .bind(now)
        .bind(smallest)
        .bind(largest)
        .fetch_optional(&self.pool)
        .await?;
        let Some((id, turn)) = claimed else { return Ok(None) };
        sqlx::query(
            "INSERT INTO served (owner, served_us) VALUES ($1, $2) \
             ON CONFLICT (owner) DO UPDATE SET served_us = excluded.served_us",
        )
        .bind(turn)
        .bind(now)
        .execute(&self.pool)
        .await?;
        Ok(Some(id))
    }

    /// Runs that an ended process left behind go back into the queue; those that were started `max_attempts` times fail.
    /// Gives the ids of both.
    pub async fn recover(&self, max_attempts: i64) -> Result<(Vec<String>, Vec<String>)> {
        let failed = sqlx::query_scalar(
            "UPDATE runs SET state = 'failed', finished_us = $1, message = $2 \
             WHERE state = 'running' AND attempts >= $3 RETURNING id",
        )
        .bind(now_us())
        .bind(format!("The service ended {max_attempts} times in the middle of this run, so it is not tried again."))
        .bind(max_attempts)
        .fetch_all(&self.pool)
        .await?;
        let queued = sqlx::query_scalar("UPDATE runs SET state = 'queued' WHERE state = 'running' RETURNING id")
            .fetch_all(&self.pool)
            .await?;
        Ok((queued, failed))
    }

    /// Puts a run under way back without counting the attempt: it was asked to stop, and not because of what it did.
    pub async fn put_back(&self, id: &str) -> Result<()> {
        sqlx::query("UPDATE runs SET state = 'queued', attempts = attempts - 1 WHERE id = $1 AND state = 'running'")
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
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
