//! Stability runs in the queue.

use sqlx::AnyConnection;

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end, forget};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, Outcome};
use crate::model::{Cursor, Stability, StabilitySpec, State};
use crate::runs::places::{Waiting, before};
use crate::runs::priority::INTERACTIVE;
use crate::runs::queue::served;
use crate::runs::share::Since;
use crate::runs::sql::{named_state, state_name};
use crate::store::{Store, from_json, now_us, to_json};

/// One stability run.
#[derive(Clone, Debug)]
pub struct StabilityRow {
    pub id: String,
    pub owner: Option<String>,
    /// Whose turn it takes.
    pub turn: String,
    /// Of a visitor's request, or of idle work.
    pub priority: i64,
    pub state: State,
    /// How often the part that is next was begun.
    pub attempts: i64,
    pub message: Option<String>,
    /// The algorithm's.
    pub name: String,
    pub spec: StabilitySpec,
    /// Parts that are done.
    pub done: Vec<String>,
    /// Seconds that these took.
    pub spent_seconds: f64,
    pub created_us: i64,
    pub finished_us: Option<i64>,
}

type Columns =
    (String, Option<String>, String, i64, String, i64, Option<String>, String, String, String, f64, i64, Option<i64>);

macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT id, owner, turn, priority, state, attempts, message, name, spec, done, spent_seconds, created_us, finished_us ",
            "FROM stability_runs ",
            $rest
        )
    };
}

impl Store {
    /// Queues one; false when there is one with its id.
    pub async fn add_stability_run(&self, row: &StabilityRow) -> Result<bool> {
        let added = sqlx::query(
            "INSERT INTO stability_runs (id, owner, turn, state, attempts, name, spec, done, created_us, priority) \
             VALUES ($1, $2, $3, 'queued', 0, $4, $5, '[]', $6, $7) ON CONFLICT (id) DO NOTHING",
        )
        .bind(&row.id)
        .bind(&row.owner)
        .bind(&row.turn)
        .bind(&row.name)
        .bind(to_json(&row.spec)?)
        .bind(row.created_us)
        .bind(row.priority)
        .execute(&self.pool)
        .await?;
        Ok(added.rows_affected() == 1)
    }

    /// Begins the next part of the run of this priority that is due: runs under way first, then the visitor who was served longest
    /// ago.
    pub async fn begin_part(&self, priority: i64, worker: &Worker) -> Result<Option<(Attempt, StabilityRow)>> {
        // Another worker may take what this one has chosen; then it chooses again.
        while let Some((.., next)) = self.next_part(priority).await? {
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, Kind::Stability, &next, worker).await? else { continue };
            let text = "UPDATE stability_runs SET state = 'running', attempts = attempts + 1 \
                        WHERE id = $1 AND state IN ('queued', 'running') RETURNING turn";
            let turn: Option<String> = sqlx::query_scalar(text).bind(&next).fetch_optional(&mut *transaction).await?;
            let Some(turn) = turn else { continue };
            served(&mut transaction, &turn).await?;
            transaction.commit().await?;
            return Ok(self.stability_run(&next).await?.map(|row| (attempt, row)));
        }
        Ok(None)
    }

    /// The run of this priority of which a part is due; between its parts, what its visitor asked for meanwhile comes first.
    pub async fn next_part(&self, priority: i64) -> Result<Option<Since>> {
        let text = concat!(
            "SELECT COALESCE(s.served_us, 0), ",
            "COALESCE((SELECT MAX(a.begun_us) FROM attempts a WHERE a.job = r.id), r.created_us), r.id ",
            "FROM stability_runs r LEFT JOIN served s ON s.owner = r.turn ",
            "WHERE r.state IN ('queued', 'running') AND r.priority = $1 AND ",
            at_rest!("stability", "r.id"),
            " ORDER BY CASE r.state WHEN 'running' THEN 0 ELSE 1 END, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1"
        );
        Ok(sqlx::query_as(text).bind(priority).fetch_optional(&self.pool).await?)
    }

    /// Keeps the findings of the finished parts, and their time, and ends the run with the last part; a run that was cancelled
    /// meanwhile stays as it is. Whether this has ended it; nothing when the attempt is not the current one.
    pub async fn accept_part(
        &self,
        attempt: &Attempt,
        done: &[String],
        found: &Stability,
        seconds: f64,
    ) -> Result<Option<bool>> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(None);
        }
        let text = "UPDATE stability_runs SET attempts = 0, done = $1, found = $2, spent_seconds = $3 \
                    WHERE id = $4 AND state = 'running'";
        let query = sqlx::query(text).bind(to_json(&done)?).bind(to_json(found)?).bind(seconds);
        query.bind(&attempt.job).execute(&mut *transaction).await?;
        let ended = found.complete && end_open(&mut transaction, &attempt.job, State::Done, None).await?;
        transaction.commit().await?;
        Ok(Some(ended))
    }

    /// Ends the run of an attempt, for a reason that this came upon; false when the attempt is not the current one.
    pub async fn give_up_part(&self, attempt: &Attempt, state: State, message: Option<&str>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        end_open(&mut transaction, &attempt.job, state, message).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// The part under way was not finished, and by no fault of its own: the attempt does not count.
    pub async fn put_back_part(&self, attempt: &Attempt) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        if end(&mut transaction, attempt, Outcome::PutBack).await? {
            let text = "UPDATE stability_runs SET attempts = attempts - 1 WHERE id = $1 AND state = 'running'";
            sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        }
        transaction.commit().await?;
        Ok(())
    }

    /// The part under way could not be finished by a fault of ours, and is tried again.
    pub async fn lose_part(&self, attempt: &Attempt) -> Result<()> {
        let mut connection = self.pool.acquire().await?;
        end(&mut connection, attempt, Outcome::Lost).await.map(|_| ())
    }

    /// Ends one that has not ended; false when it had.
    pub async fn end_stability(&self, id: &str, state: State, message: Option<&str>) -> Result<bool> {
        let mut connection = self.pool.acquire().await?;
        end_open(&mut connection, id, state, message).await
    }

    /// One by its id.
    pub async fn stability_run(&self, id: &str) -> Result<Option<StabilityRow>> {
        let row: Option<Columns> = sqlx::query_as(select!("WHERE id = $1")).bind(id).fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }

    /// What one found so far.
    pub async fn stability_found(&self, id: &str) -> Result<Option<Stability>> {
        let text = "SELECT found FROM stability_runs WHERE id = $1";
        let found: Option<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_optional(&self.pool).await?;
        found.flatten().map(|text| from_json(&text)).transpose()
    }

    /// Those of an owner, newest first, behind a place in the list.
    pub async fn stability_runs_of(&self, owner: &str, from: &Cursor, limit: usize) -> Result<Vec<StabilityRow>> {
        let rows: Vec<Columns> = sqlx::query_as(select!(
            "WHERE owner = $1 AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4"
        ))
        .bind(owner)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.into_iter().map(read).collect()
    }

    /// All that have not ended, the oldest first.
    pub async fn open_stability_runs(&self) -> Result<Vec<StabilityRow>> {
        let rows: Vec<Columns> =
            sqlx::query_as(select!("WHERE state IN ('queued', 'running') ORDER BY created_us, id"))
                .fetch_all(&self.pool)
                .await?;
        rows.into_iter().map(read).collect()
    }

    /// How many of visitors have not ended: all, and those of this turn.
    pub async fn open_stability(&self, turn: &str) -> Result<[i64; 2]> {
        let text = "SELECT COUNT(*), COUNT(CASE WHEN turn = $1 THEN 1 END) FROM stability_runs \
                    WHERE state IN ('queued', 'running') AND priority = $2";
        let (all, own): (i64, i64) = sqlx::query_as(text).bind(turn).bind(INTERACTIVE).fetch_one(&self.pool).await?;
        Ok([all, own])
    }

    /// How many are under way, or are carried out before this one, which waits. Few wait, so all are looked at.
    pub async fn stability_before(&self, row: &StabilityRow) -> Result<u32> {
        let waiting: Vec<Waiting> = sqlx::query_as(
            "SELECT r.state, r.turn, COALESCE(s.served_us, 0), r.created_us, r.id \
             FROM stability_runs r LEFT JOIN served s ON s.owner = r.turn \
             WHERE r.state IN ('queued', 'running') AND r.priority = $1 ORDER BY r.created_us, r.id",
        )
        .bind(INTERACTIVE)
        .fetch_all(&self.pool)
        .await?;
        before(waiting, &row.turn, row.created_us, &row.id)
    }

    /// Takes one away.
    pub async fn remove_stability(&self, id: &str) -> Result<()> {
        sqlx::query("DELETE FROM stability_runs WHERE id = $1").bind(id).execute(&self.pool).await?;
        forget(&self.pool, id).await
    }
}

async fn end_open(connection: &mut AnyConnection, id: &str, state: State, message: Option<&str>) -> Result<bool> {
    let text = "UPDATE stability_runs SET state = $1, message = $2, finished_us = $3 \
                WHERE id = $4 AND state IN ('queued', 'running')";
    let query = sqlx::query(text).bind(state_name(state)).bind(message).bind(now_us()).bind(id);
    Ok(query.execute(connection).await?.rows_affected() == 1)
}

fn read(columns: Columns) -> Result<StabilityRow> {
    let (id, owner, turn, priority, state, attempts, message, name, spec, done, spent_seconds, created_us, finished_us) =
        columns;
    Ok(StabilityRow {
        id,
        owner,
        turn,
        priority,
        state: named_state(&state)?,
        attempts,
        message,
        name,
        spec: from_json(&spec)?,
        done: from_json(&done)?,
        spent_seconds,
        created_us,
        finished_us,
    })
}
