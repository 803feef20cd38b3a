//! Workloads in the queue.

use sqlx::AnyConnection;

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, Outcome};
use crate::model::{Cursor, RecordingInfo, State, WorkloadResult, WorkloadSpec};
use crate::runs::places::{Waiting, before};
use crate::runs::queue::served;
use crate::runs::share::Since;
use crate::runs::sql::{named_state, state_name};
use crate::store::{Store, from_json, now_us, to_json};

/// One workload.
#[derive(Clone, Debug)]
pub struct WorkloadRow {
    pub id: String,
    pub owner: Option<String>,
    /// Whose turn it takes.
    pub turn: String,
    pub state: State,
    /// How often its replay was begun.
    pub attempts: i64,
    pub message: Option<String>,
    pub spec: WorkloadSpec,
    pub recording: RecordingInfo,
    /// Queries that are done.
    pub done: u64,
    pub created_us: i64,
    pub finished_us: Option<i64>,
}

type Columns = (String, Option<String>, String, String, i64, Option<String>, String, String, i64, i64, Option<i64>);

macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT id, owner, turn, state, attempts, message, spec, recording, done, created_us, finished_us FROM workloads ",
            $rest
        )
    };
}

impl Store {
    /// Keeps one, queued or ended; false when there is one with its id.
    pub async fn add_workload(&self, row: &WorkloadRow) -> Result<bool> {
        let added = sqlx::query(
            "INSERT INTO workloads (id, owner, turn, state, attempts, spec, recording, blob, done, created_us, finished_us) \
             VALUES ($1, $2, $3, $8, 0, $4, $5, $6, 0, $7, $9) ON CONFLICT (id) DO NOTHING",
        )
        .bind(&row.id)
        .bind(&row.owner)
        .bind(&row.turn)
        .bind(to_json(&row.spec)?)
        .bind(to_json(&row.recording)?)
        .bind(&row.recording.sha256)
        .bind(row.created_us)
        .bind(state_name(row.state))
        .bind(row.finished_us)
        .execute(&self.pool)
        .await?;
        Ok(added.rows_affected() == 1)
    }

    /// Begins the replay that is due: those that were lost first, then of the visitor who was served longest ago.
    pub async fn begin_replay(&self, worker: &Worker) -> Result<Option<(Attempt, WorkloadRow)>> {
        // Another worker may take what this one has chosen; then it chooses again.
        while let Some((.., next)) = self.next_replay().await? {
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, Kind::Replay, &next, worker).await? else { continue };
            let text = "UPDATE workloads SET state = 'running', attempts = attempts + 1, done = 0, message = NULL \
                        WHERE id = $1 AND state IN ('queued', 'running') RETURNING turn";
            let turn: Option<String> = sqlx::query_scalar(text).bind(&next).fetch_optional(&mut *transaction).await?;
            let Some(turn) = turn else { continue };
            served(&mut transaction, &turn).await?;
            transaction.commit().await?;
            return Ok(self.workload(&next).await?.map(|row| (attempt, row)));
        }
        Ok(None)
    }

    /// The replay that is due.
    pub async fn next_replay(&self) -> Result<Option<Since>> {
        let text = concat!(
            "SELECT COALESCE(s.served_us, 0), w.created_us, w.id FROM workloads w LEFT JOIN served s ON s.owner = w.turn ",
            "WHERE w.state IN ('queued', 'running') AND ",
            at_rest!("replay", "w.id"),
            " ORDER BY CASE w.state WHEN 'running' THEN 0 ELSE 1 END, COALESCE(s.served_us, 0), w.created_us, w.id LIMIT 1"
        );
        Ok(sqlx::query_as(text).fetch_optional(&self.pool).await?)
    }

    /// Notes how far it is, and what else it does.
    pub async fn replay_is_at(&self, id: &str, done: u64, message: Option<&str>) -> Result<()> {
        let text = "UPDATE workloads SET done = $1, message = $2 WHERE id = $3 AND state = 'running'";
        sqlx::query(text).bind(done as i64).bind(message).bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// Keeps what was found, once, from the current attempt; one that was cancelled meanwhile stays as it is.
    pub async fn accept_replay(
        &self,
        attempt: &Attempt,
        result: &WorkloadResult,
        queries: &str,
        reduced: Option<&str>,
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        let text = "UPDATE workloads SET result = $1, queries = $2, done = $3, reduced = $4, message = NULL \
                    WHERE id = $5 AND state = 'running'";
        let query = sqlx::query(text).bind(to_json(result)?).bind(queries).bind(result.queries as i64).bind(reduced);
        query.bind(&attempt.job).execute(&mut *transaction).await?;
        let done = end_open(&mut transaction, &attempt.job, State::Done, None).await?;
        transaction.commit().await?;
        Ok(done)
    }

    /// Ends the workload of an attempt, for a reason that this came upon; false when the attempt is not the current one.
    pub async fn give_up_replay(&self, attempt: &Attempt, state: State, message: Option<&str>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        end_open(&mut transaction, &attempt.job, state, message).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// It was not finished, and by no fault of its own: the attempt does not count.
    pub async fn put_back_replay(&self, attempt: &Attempt) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        if end(&mut transaction, attempt, Outcome::PutBack).await? {
            let text = "UPDATE workloads SET attempts = attempts - 1 WHERE id = $1 AND state = 'running'";
            sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        }
        transaction.commit().await?;
        Ok(())
    }

    /// Ends one that has not ended; false when it had.
    pub async fn end_workload(&self, id: &str, state: State, message: Option<&str>) -> Result<bool> {
        let mut connection = self.pool.acquire().await?;
        end_open(&mut connection, id, state, message).await
    }

    /// One by its id.
    pub async fn workload(&self, id: &str) -> Result<Option<WorkloadRow>> {
        let row: Option<Columns> = sqlx::query_as(select!("WHERE id = $1")).bind(id).fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }

    /// What was found.
    pub async fn workload_result(&self, id: &str) -> Result<Option<WorkloadResult>> {
        let text = "SELECT result FROM workloads WHERE id = $1";
        let found: Option<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_optional(&self.pool).await?;
        found.flatten().map(|text| from_json(&text)).transpose()
    }

    /// The blob with the table of its queries.
    pub async fn workload_table(&self, id: &str) -> Result<Option<String>> {
        let text = "SELECT queries FROM workloads WHERE id = $1";
        let blob: Option<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_optional(&self.pool).await?;
        Ok(blob.flatten())
    }

    /// The blob with the recording about its reduced scene.
    pub async fn reduced_recording(&self, id: &str) -> Result<Option<String>> {
        let text = "SELECT reduced FROM workloads WHERE id = $1";
        let blob: Option<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_optional(&self.pool).await?;
        Ok(blob.flatten())
    }

    /// Those of an owner, newest first, behind a place in the list.
    pub async fn workloads_of(&self, owner: &str, from: &Cursor, limit: usize) -> Result<Vec<WorkloadRow>> {
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

    /// How many have not ended: all, and those of this turn.
    pub async fn open_workloads_of(&self, turn: &str) -> Result<[i64; 2]> {
        let text = "SELECT COUNT(*), COUNT(CASE WHEN turn = $1 THEN 1 END) FROM workloads \
                    WHERE state IN ('queued', 'running')";
        let (all, own): (i64, i64) = sqlx::query_as(text).bind(turn).fetch_one(&self.pool).await?;
        Ok([all, own])
    }

    /// How many are under way, or are carried out before this one, which waits. Few wait, so all are looked at.
    pub async fn workloads_before(&self, row: &WorkloadRow) -> Result<u32> {
        let waiting: Vec<Waiting> = sqlx::query_as(
            "SELECT w.state, w.turn, COALESCE(s.served_us, 0), w.created_us, w.id \
             FROM workloads w LEFT JOIN served s ON s.owner = w.turn \
             WHERE w.state IN ('queued', 'running') ORDER BY w.created_us, w.id",
        )
        .fetch_all(&self.pool)
        .await?;
        before(waiting, &row.turn, row.created_us, &row.id)
    }
}

async fn end_open(connection: &mut AnyConnection, id: &str, state: State, message: Option<&str>) -> Result<bool> {
    let text = "UPDATE workloads SET state = $1, message = $2, finished_us = $3 \
                WHERE id = $4 AND state IN ('queued', 'running')";
    let query = sqlx::query(text).bind(state_name(state)).bind(message).bind(now_us()).bind(id);
    Ok(query.execute(connection).await?.rows_affected() == 1)
}

fn read(columns: Columns) -> Result<WorkloadRow> {
    let (id, owner, turn, state, attempts, message, spec, recording, done, created_us, finished_us) = columns;
    Ok(WorkloadRow {
        id,
        owner,
        turn,
        state: named_state(&state)?,
        attempts,
        message,
        spec: from_json(&spec)?,
        recording: from_json(&recording)?,
        done: done as u64,
        created_us,
        finished_us,
    })
}
