//! The events of runs, numbered from one without gaps.

use sqlx::AnyConnection;

use crate::Result;
use crate::attempts::Attempt;
use crate::attempts::sql::while_current;
use crate::model::{RunEvent, Stage};
use crate::store::{Store, from_json, now_us, to_json};

impl Store {
    /// Appends an event and gives it its number; a run that was taken away meanwhile has no events.
    pub async fn add_event(&self, id: &str, event: &mut RunEvent) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        append_event(&mut transaction, id, event).await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Writes stages and the event that tells of them; false, and nothing is written, when the attempt is not the current one.
    pub async fn tell(&self, attempt: &Attempt, stages: &[(usize, &Stage)], event: &mut RunEvent) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let text = concat!(
            "UPDATE runs SET last_event = last_event + 1 WHERE id = $1 AND ",
            while_current!("$2"),
            " RETURNING last_event"
        );
        let seq = sqlx::query_scalar(text).bind(&attempt.job).bind(&attempt.id);
        let seq: Option<i64> = seq.fetch_optional(&mut *transaction).await?;
        let Some(seq) = seq else { return Ok(false) };
        for (position, stage) in stages {
            sqlx::query("UPDATE run_stages SET stage = $1 WHERE run_id = $2 AND position = $3")
                .bind(to_json(stage)?)
                .bind(&attempt.job)
                .bind(*position as i64)
                .execute(&mut *transaction)
                .await?;
        }
        keep_event(&mut transaction, &attempt.job, seq, event).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// The events behind `after_seq`, oldest first.
    pub async fn events(&self, id: &str, after_seq: i64) -> Result<Vec<RunEvent>> {
        let rows: Vec<(i64, String)> =
            sqlx::query_as("SELECT seq, event FROM run_events WHERE run_id = $1 AND seq > $2 ORDER BY seq")
                .bind(id)
                .bind(after_seq)
                .fetch_all(&self.pool)
                .await?;
        rows.iter().map(|(seq, event)| Ok(RunEvent { seq: *seq, ..from_json(event)? })).collect()
    }
}

/// Appends an event within a transaction. Other writers wait at the run's row until it ends, so a larger number is never visible
/// before a smaller one, and a reader who asks for what is behind the last number misses none.
pub(crate) async fn append_event(connection: &mut AnyConnection, id: &str, event: &mut RunEvent) -> Result<()> {
    let text = "UPDATE runs SET last_event = last_event + 1 WHERE id = $1 RETURNING last_event";
    let seq: Option<i64> = sqlx::query_scalar(text).bind(id).fetch_optional(&mut *connection).await?;
    let Some(seq) = seq else { return Ok(()) };
    keep_event(connection, id, seq, event).await
}

/// Keeps an event under this number, with the time.
async fn keep_event(connection: &mut AnyConnection, id: &str, seq: i64, event: &mut RunEvent) -> Result<()> {
    (event.seq, event.at_us) = (seq, now_us());
    sqlx::query("INSERT INTO run_events (run_id, seq, event) VALUES ($1, $2, $3)")
        .bind(id)
        .bind(seq)
        .bind(to_json(event)?)
        .execute(connection)
        .await?;
    Ok(())
}
