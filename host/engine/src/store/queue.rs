//! The queue: which run is next, and what becomes of interrupted ones.

use super::{Store, now_us};
use crate::Result;

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
    /// Takes the next run: smallest priority, then whose turn was longest ago, then the oldest.
    pub async fn claim(&self) -> Result<Option<String>> {
        let now = now_us();
        let claimed: Option<(String, String)> = sqlx::query_as(
            "UPDATE runs SET state = 'running', attempts = attempts + 1, started_us = $1, message = NULL \
             WHERE state = 'queued' AND id = ( \
                 SELECT r.id FROM runs r LEFT JOIN served s ON s.owner = r.turn \
                 WHERE r.state = 'queued' \
                 ORDER BY r.priority, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1) \
             RETURNING id, turn",
        )
        .bind(now)
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

    /// Puts a run under way back without counting the attempt: the service was asked to stop.
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

    /// How many runs wait for a turn at this priority or a smaller one, and the seconds that they were expected to take.
    pub async fn waiting(&self, priority: i64) -> Result<(u32, f64)> {
        let text = "SELECT COUNT(*), COALESCE(SUM(expected_seconds), 0.0) FROM runs \
                    WHERE state = 'queued' AND priority <= $1";
        let (count, seconds): (i64, f64) = sqlx::query_as(text).bind(priority).fetch_one(&self.pool).await?;
        Ok((count as u32, seconds))
    }

    /// The same with those under way.
    pub async fn runs_before(&self, id: &str) -> Result<Option<u32>> {
        let Some(waiting) = self.waiting_before(id).await? else { return Ok(None) };
        Ok(Some(waiting + self.running().await?.len() as u32))
    }

    /// How many of the waiting runs are served before this one if nothing else is asked for; nothing when it does not wait.
    pub async fn waiting_before(&self, id: &str) -> Result<Option<u32>> {
        let own: Option<(String, i64, i64)> =
            sqlx::query_as("SELECT turn, priority, created_us FROM runs WHERE id = $1 AND state = 'queued'")
                .bind(id)
                .fetch_optional(&self.pool)
                .await?;
        let Some((turn, priority, created_us)) = own else { return Ok(None) };
        let sooner: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM runs WHERE state = 'queued' AND priority < $1")
            .bind(priority)
            .fetch_one(&self.pool)
            .await?;
        let of_turn: i64 = sqlx::query_scalar(
            "SELECT COUNT(*) FROM runs WHERE state = 'queued' AND priority = $1 AND turn = $2 \
             AND (created_us, id) < ($3, $4)",
        )
        .bind(priority)
        .bind(&turn)
        .bind(created_us)
        .bind(id)
        .fetch_one(&self.pool)
        .await?;
        let turns: Vec<(String, i64, i64, i64, String)> = sqlx::query_as(
            "SELECT r.turn, COUNT(*), MIN(COALESCE(s.served_us, 0)), MIN(r.created_us), MIN(r.id) \
             FROM runs r LEFT JOIN served s ON s.owner = r.turn WHERE r.state = 'queued' AND r.priority = $1 \
             GROUP BY r.turn",
        )
        .bind(priority)
        .fetch_all(&self.pool)
        .await?;
        let turns = turns.into_iter().map(|(turn, waiting, served_us, created_us, id)| Turn {
            turn,
            waiting,
            since: (served_us, created_us, id),
        });
        Ok(Some((sooner + of_turn + of_others(&turn, of_turn, turns.collect())) as u32))
    }

    /// Runs under way: their ids, when they were started and what they were expected to take.
    pub async fn running(&self) -> Result<Vec<(String, i64, f64)>> {
        Ok(sqlx::query_as("SELECT id, COALESCE(started_us, 0), expected_seconds FROM runs WHERE state = 'running'")
            .fetch_all(&self.pool)
            .await?)
    }
}

/// Who waits for a turn.
struct Turn {
    turn: String,
    /// So many runs.
    waiting: i64,
    /// Who has the smallest is served first: when it was served last, then what it waits with.
    since: (i64, i64, String),
}

/// How many runs of others come before the run of this turn that has so many of its own before it: turns go round, so that
/// those whose turn is sooner have one more than it, as far as they have any.
fn of_others(turn: &str, before: i64, turns: Vec<Turn>) -> i64 {
    let Some(own) = turns.iter().find(|other| other.turn == turn) else { return 0 };
    let others = turns.iter().filter(|other| other.turn != turn);
    others.map(|other| other.waiting.min(before + i64::from(other.since < own.since))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_has_many_runs_does_not_keep_others_waiting() {
        let turns = || {
            let turn = |turn: &str, waiting, served_us| Turn {
                turn: turn.into(),
                waiting,
                since: (served_us, 1, turn.into()),
            };
            vec![turn("a", 100, 5), turn("b", 2, 7), turn("c", 1, 0)]
        };
        // c1 a1 b1 a2 b2 a3 ...
        let place = |turn, before| before + of_others(turn, before, turns());
        assert_eq!([place("c", 0), place("a", 0), place("b", 0)], [0, 1, 2]);
        assert_eq!([place("a", 1), place("b", 1), place("a", 2), place("a", 99)], [3, 4, 5, 102]);
    }
}
