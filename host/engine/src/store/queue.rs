//! The queue: which run is next, and what becomes of interrupted ones.

use std::collections::HashMap;

use super::{Store, now_us};
use crate::Result;

/// A waiting run, as far as its place in the queue depends on it.
#[derive(Clone, Debug, PartialEq)]
pub struct QueuedRun {
    /// Its id.
    pub id: String,
    /// Its owner; the empty text for runs of the service itself and of campaigns, which take nobody's turn.
    pub owner: String,
    /// Smaller is served first.
    pub priority: i64,
    /// When it was asked for.
    pub created_us: i64,
    /// What it was expected to take when it was asked for.
    pub expected_seconds: f64,
}

impl Store {
    /// Takes the next run: smallest priority, then the owner served longest ago, then the oldest.
    pub async fn claim(&self) -> Result<Option<String>> {
        let now = now_us();
        let claimed: Option<(String, String)> = sqlx::query_as(
            "UPDATE runs SET state = 'running', attempts = attempts + 1, started_us = $1, message = NULL \
             WHERE state = 'queued' AND id = ( \
                 SELECT r.id FROM runs r LEFT JOIN served s \
                 ON s.owner = CASE WHEN r.campaign IS NULL THEN COALESCE(r.owner, '') ELSE '' END \
                 WHERE r.state = 'queued' \
                 ORDER BY r.priority, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1) \
             RETURNING id, CASE WHEN campaign IS NULL THEN COALESCE(owner, '') ELSE '' END",
        )
        .bind(now)
        .fetch_optional(&self.pool)
        .await?;
        let Some((id, owner)) = claimed else { return Ok(None) };
        sqlx::query(
            "INSERT INTO served (owner, served_us) VALUES ($1, $2) \
             ON CONFLICT (owner) DO UPDATE SET served_us = excluded.served_us",
        )
        .bind(owner)
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

    /// Puts a run under way back without counting the attempt: the service was asked to stop.
    pub async fn put_back(&self, id: &str) -> Result<()> {
        sqlx::query("UPDATE runs SET state = 'queued', attempts = attempts - 1 WHERE id = $1 AND state = 'running'")
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// How many runs of this owner wait, without those of campaigns, for which nobody asked.
    pub async fn waiting_runs(&self, owner: &str) -> Result<u64> {
        let text = "SELECT COUNT(*) FROM runs WHERE owner = $1 AND state = 'queued' AND campaign IS NULL";
        let count: i64 = sqlx::query_scalar(text).bind(owner).fetch_one(&self.pool).await?;
        Ok(count as u64)
    }

    /// All waiting runs in the order in which they will be served if nothing else is asked for.
    pub async fn queued(&self) -> Result<Vec<QueuedRun>> {
        let rows: Vec<(String, String, i64, i64, f64)> = sqlx::query_as(
            "SELECT id, CASE WHEN campaign IS NULL THEN COALESCE(owner, '') ELSE '' END, priority, created_us, \
             expected_seconds FROM runs WHERE state = 'queued'",
        )
        .fetch_all(&self.pool)
        .await?;
        let served: Vec<(String, i64)> =
            sqlx::query_as("SELECT owner, served_us FROM served").fetch_all(&self.pool).await?;
        let waiting = rows
            .into_iter()
            .map(|(id, owner, priority, created_us, expected_seconds)| QueuedRun {
                id,
                owner,
                priority,
                created_us,
                expected_seconds,
            })
            .collect();
        Ok(in_order(waiting, served.into_iter().collect()))
    }

    /// Runs under way: their ids, when they were started and what they were expected to take.
    pub async fn running(&self) -> Result<Vec<(String, i64, f64)>> {
        Ok(sqlx::query_as("SELECT id, COALESCE(started_us, 0), expected_seconds FROM runs WHERE state = 'running'")
            .fetch_all(&self.pool)
            .await?)
    }
}

/// Plays the claims: serving an owner moves that owner behind all others of the same priority.
fn in_order(mut waiting: Vec<QueuedRun>, mut served: HashMap<String, i64>) -> Vec<QueuedRun> {
    let mut clock = served.values().copied().max().unwrap_or(0).max(0);
    let mut order = Vec::with_capacity(waiting.len());
    while let Some(next) = (0..waiting.len()).min_by_key(|&i| {
        let run = &waiting[i];
        (run.priority, served.get(&run.owner).copied().unwrap_or(0), run.created_us, run.id.clone())
    }) {
        let run = waiting.swap_remove(next);
        clock += 1;
        served.insert(run.owner.clone(), clock);
        order.push(run);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(id: &str, owner: &str, priority: i64, created_us: i64) -> QueuedRun {
        QueuedRun { id: id.into(), owner: owner.into(), priority, created_us, expected_seconds: 1.0 }
    }

    #[test]
    fn an_owner_with_many_runs_does_not_keep_others_waiting() {
        let waiting = vec![run("a1", "a", 1, 1), run("a2", "a", 1, 2), run("a3", "a", 1, 3), run("b1", "b", 1, 4)];
        let ids: Vec<String> = in_order(waiting, HashMap::new()).into_iter().map(|r| r.id).collect();
        assert_eq!(ids, ["a1", "b1", "a2", "a3"]);
    }

    #[test]
    fn priority_goes_before_fairness() {
        let waiting = vec![run("quick", "", 3, 1), run("b1", "b", 1, 4)];
        let ids: Vec<String> = in_order(waiting, HashMap::from([("b".into(), 9)])).into_iter().map(|r| r.id).collect();
        assert_eq!(ids, ["b1", "quick"]);
    }
}
