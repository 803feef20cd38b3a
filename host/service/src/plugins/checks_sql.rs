//! Attempts at the checks of plugins.

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end, while_current};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, MOST_LOST, Outcome};
use crate::audit::{Note, append};
use crate::model::{AlgorithmInfo, CheckLine, PluginState};
use crate::notices::sql::{NewNotice, tell};
use crate::plugins::sql::{PluginRow, move_from, plugin, read_plugin, select_plugins};
use crate::store::{Store, now_us, to_json};

/// How a check ended.
#[derive(Clone, Copy)]
pub struct CheckEnd<'a> {
    /// What the plugin describes.
    pub algorithms: &'a [AlgorithmInfo],
    /// The hardware class of the check.
    pub class: &'a str,
    pub state: PluginState,
    pub new_notice: NewNotice<'a>,
    /// Its detail is the reason.
    pub note: Note<'a>,
}

impl Store {
    /// Begins the next check and forgets the lines of an earlier attempt; what was lost too often is not begun again. Authors take
    /// turns, so that who sends many holds up nobody's first: next is the one whose latest check was begun longest ago.
    pub async fn begin_check(&self, worker: &Worker) -> Result<Option<(Attempt, PluginRow)>> {
        // Another worker may take what this one has chosen; then it chooses again.
        loop {
            let next: Option<String> = sqlx::query_scalar(concat!(
                "SELECT waiting.id FROM submissions waiting ",
                "WHERE waiting.state = 'uploaded' AND waiting.attempts < $1 AND ",
                at_rest!("check", "waiting.id"),
                " ORDER BY (SELECT MAX(other.begun_us) FROM submissions other WHERE other.account = waiting.account), ",
                "waiting.created_us, waiting.id LIMIT 1"
            ))
            .bind(MOST_LOST)
            .fetch_optional(&self.pool)
            .await?;
            let Some(next) = next else { return Ok(None) };
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, Kind::Check, &next, worker).await? else { continue };
            let text =
                "UPDATE submissions SET attempts = attempts + 1, begun_us = $1 WHERE id = $2 AND state = 'uploaded'";
            let done = sqlx::query(text).bind(now_us()).bind(&next).execute(&mut *transaction).await?;
            if done.rows_affected() == 0 {
                continue;
            }
            let text = "DELETE FROM submission_lines WHERE submission = $1";
            sqlx::query(text).bind(&next).execute(&mut *transaction).await?;
            let row = plugin(&mut *transaction, &next).await?;
            transaction.commit().await?;
            return Ok(row.map(|row| (attempt, row)));
        }
    }

    /// Keeps a line of the report, which may have been told before; false when the attempt is not the current one.
    pub async fn add_line(&self, attempt: &Attempt, seq: i64, line: &CheckLine) -> Result<bool> {
        let text = concat!(
            "INSERT INTO submission_lines (submission, seq, line) SELECT id, $1, $2 FROM submissions WHERE id = $3 AND ",
            while_current!("$4"),
            // Whatever stands there is written again, so that one row is affected if the attempt is the current one.
            " ON CONFLICT (submission, seq) DO UPDATE SET line = excluded.line"
        );
        let added = sqlx::query(text).bind(seq).bind(to_json(line)?).bind(&attempt.job).bind(&attempt.id);
        Ok(added.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// Notes that the plugin was let through the gate; false when the attempt is not the current one.
    pub async fn note_vetted(&self, attempt: &Attempt) -> Result<bool> {
        let text = concat!(
            "UPDATE submissions SET state = CASE state WHEN 'uploaded' THEN 'vetted' ELSE state END, changed_us = $1 ",
            "WHERE id = $2 AND ",
            while_current!("$3")
        );
        let done = sqlx::query(text).bind(now_us()).bind(&attempt.job).bind(&attempt.id);
        Ok(done.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// Ends a check with what it found, tells its author and notes it; false, and nothing is kept, when the attempt is not the
    /// current one, or somebody has ended the check.
    pub async fn accept_check(&self, attempt: &Attempt, check: CheckEnd<'_>) -> Result<bool> {
        let (id, reason) = (attempt.job.as_str(), check.note.detail);
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        let mut moved = false;
        for from in [PluginState::Uploaded, PluginState::Vetted] {
            moved = moved || move_from(&mut transaction, id, from, check.state, reason).await?;
        }
        if moved {
            sqlx::query("UPDATE submissions SET algorithms = $1, hardware_class = $2 WHERE id = $3")
                .bind(to_json(&check.algorithms)?)
                .bind(check.class)
                .bind(id)
                .execute(&mut *transaction)
                .await?;
            tell(&mut transaction, check.new_notice).await?;
            append(&mut transaction, check.note).await?;
        }
        transaction.commit().await?;
        Ok(moved)
    }

    /// A check that was stopped waits again, and this was no attempt; one that somebody ended stays so. False when the attempt is
    /// not the current one.
    pub async fn put_back_check(&self, attempt: &Attempt) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::PutBack).await? {
            return Ok(false);
        }
        let text = "UPDATE submissions SET state = 'uploaded', attempts = attempts - 1 \
                    WHERE id = $1 AND state IN ('uploaded', 'vetted')";
        sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Checks that were lost too often.
    pub async fn checks_to_give_up(&self) -> Result<Vec<PluginRow>> {
        let text = select_plugins!(
            "WHERE state = 'uploaded' AND attempts >= $1 AND NOT EXISTS \
            (SELECT 1 FROM attempts a WHERE a.kind = 'check' AND a.job = submissions.id AND a.ended_us IS NULL)"
        );
        let rows = sqlx::query(text).bind(MOST_LOST).fetch_all(&self.pool).await?;
        rows.iter().map(read_plugin).collect()
    }
}
