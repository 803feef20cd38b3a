//! Plugins that developers bring, and their reports.

use sqlx::any::AnyRow;
use sqlx::{Any, Executor, Row};

use crate::audit::Note;
use crate::audit::{append, notes_on};
use crate::model::{AlgorithmInfo, AuditEntry, CheckLine, Manifest, PluginState};
use crate::notices::sql::NewNotice;
use crate::notices::sql::tell;
use crate::store::{Store, from_json, now_us, to_json};
use crate::{EngineError, Result};

/// Who acts when nobody does.
pub const THE_SERVICE: &str = "the service";

/// One row of the table of submissions.
#[derive(Clone, Debug, PartialEq)]
pub struct SubmissionRow {
    /// UUIDv7.
    pub id: String,
    /// Id of the account that sent it.
    pub account: String,
    /// SHA-256 of the file.
    pub blob: String,
    /// Name of the file.
    pub file: String,
    /// Size of the file.
    pub bytes: u64,
    /// What its author says of it.
    pub manifest: Manifest,
    /// The key that it was signed with.
    pub signed_by: Option<String>,
    /// Where it is on its way.
    pub state: PluginState,
    /// Why.
    pub reason: String,
    /// The hardware class on which it was checked.
    pub hardware_class: Option<String>,
    /// The hardware class on which it was taken out, where that is not the one of its check.
    pub excluded_on: Option<String>,
    /// What it describes.
    pub algorithms: Vec<AlgorithmInfo>,
    /// When it was sent.
    pub created_us: i64,
    /// When its state changed last.
    pub changed_us: i64,
}

macro_rules! select_submissions {
    ($rest:literal) => {
        concat!(
            "SELECT id, account, blob, file, bytes, manifest, signed_by, state, reason, hardware_class, excluded_on, ",
            "algorithms, created_us, changed_us FROM submissions ",
            $rest
        )
    };
}
pub(crate) use select_submissions;

impl Store {
    /// Adds a submission, and notes it; false when the account has sent these bytes before.
    pub async fn add_submission(&self, row: &SubmissionRow, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let added = sqlx::query(
            "INSERT INTO submissions (id, account, blob, file, bytes, manifest, state, reason, algorithms, attempts, \
             created_us, changed_us, signed_by) SELECT $1, id, $2, $3, $4, $5, $6, $7, $8, 0, $9, $10, $11 FROM accounts \
             WHERE id = $12 AND deleted_us IS NULL ON CONFLICT (account, blob) DO NOTHING",
        )
        .bind(&row.id)
        .bind(&row.blob)
        .bind(&row.file)
        .bind(row.bytes as i64)
        .bind(to_json(&row.manifest)?)
        .bind(row.state.name())
        .bind(&row.reason)
        .bind(to_json(&row.algorithms)?)
        .bind(row.created_us)
        .bind(row.changed_us)
        .bind(row.signed_by.as_deref())
        .bind(&row.account)
        .execute(&mut *transaction)
        .await?;
        let new = added.rows_affected() == 1;
        if new {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(new)
    }

    /// Notes that the author has signed what was sent before.
    pub async fn sign_submission(&self, id: &str, key: &str, note: Note<'_>) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        sqlx::query("UPDATE submissions SET signed_by = $1 WHERE id = $2")
            .bind(key)
            .bind(id)
            .execute(&mut *transaction)
            .await?;
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(())
    }

    /// One submission.
    pub async fn submission(&self, id: &str) -> Result<Option<SubmissionRow>> {
        submission(&self.pool, id).await
    }

    /// One submission with its report and its history, all of one moment: a state that its history does not tell of yet, or
    /// no longer, would look half done.
    pub async fn whole_submission(&self, id: &str) -> Result<Option<(SubmissionRow, Vec<CheckLine>, Vec<AuditEntry>)>> {
        let mut moment = self.pool.begin_with(self.one_moment).await?;
        let row = submission(&mut *moment, id).await?;
        let lines = lines(&mut *moment, id).await?;
        let history = notes_on(&mut *moment, id).await?;
        moment.commit().await?;
        Ok(row.map(|row| (row, lines, history)))
    }

    /// The account's submission of these bytes.
    pub async fn submission_of(&self, account: &str, blob: &str) -> Result<Option<SubmissionRow>> {
        let row = sqlx::query(select_submissions!("WHERE account = $1 AND blob = $2"))
            .bind(account)
            .bind(blob)
            .fetch_optional(&self.pool)
            .await?;
        row.as_ref().map(read_submission).transpose()
    }

    /// All submissions, newest first.
    pub async fn submissions(&self) -> Result<Vec<SubmissionRow>> {
        let rows = sqlx::query(select_submissions!("ORDER BY created_us DESC, id DESC")).fetch_all(&self.pool).await?;
        rows.iter().map(read_submission).collect()
    }

    /// Moves a submission from one state to another, tells its author and notes it; false when it was not in the first.
    pub async fn move_submission(
        &self,
        id: &str,
        from: PluginState,
        to: PluginState,
        reason: &str,
        new_notice: Option<NewNotice<'_>>,
        note: Option<Note<'_>>,
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let done = sqlx::query(
            "UPDATE submissions SET state = $1, reason = $2, changed_us = $3, excluded_on = NULL \
                 WHERE id = $4 AND state = $5",
        )
        .bind(to.name())
        .bind(reason)
        .bind(now_us())
        .bind(id)
        .bind(from.name())
        .execute(&mut *transaction)
        .await?;
        let moved = done.rows_affected() == 1;
        if let Some(new_notice) = new_notice.filter(|_| moved) {
            tell(&mut transaction, new_notice).await?;
        }
        if let Some(note) = note.filter(|_| moved) {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(moved)
    }

    /// Takes a public submission out on this hardware class, tells its author and notes it; false when it is not public any more,
    /// or has changed since it failed.
    pub async fn exclude_submission(
        &self,
        id: &str,
        class: &str,
        failed_us: i64,
        new_notice: Option<NewNotice<'_>>,
        note: Note<'_>,
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let done = sqlx::query(
            "UPDATE submissions SET state = 'excluded', reason = $1, changed_us = $2, excluded_on = $3 \
             WHERE id = $4 AND state = 'public' AND changed_us < $5",
        )
        .bind(note.detail)
        .bind(now_us())
        .bind(class)
        .bind(id)
        .bind(failed_us)
        .execute(&mut *transaction)
        .await?;
        let moved = done.rows_affected() == 1;
        if let Some(new_notice) = new_notice.filter(|_| moved) {
            tell(&mut transaction, new_notice).await?;
        }
        if moved {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(moved)
    }

    /// Notes what a check found out beside its lines.
    pub async fn describe_submission(&self, id: &str, algorithms: &[AlgorithmInfo], class: &str) -> Result<()> {
        sqlx::query("UPDATE submissions SET algorithms = $1, hardware_class = $2 WHERE id = $3")
            .bind(to_json(&algorithms)?)
            .bind(class)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// Takes the next submission to be checked and forgets the lines of an earlier attempt; one that was begun `most` times
    /// is not begun again. Authors take turns, so that who sends many holds up nobody's first: next is the one whose latest
    /// check was begun longest ago.
    pub async fn claim_check(&self, most: i64) -> Result<Option<SubmissionRow>> {
        let mut transaction = self.pool.begin().await?;
        let id: Option<String> = sqlx::query_scalar(
            "UPDATE submissions SET attempts = attempts + 1, begun_us = $1 WHERE id = (SELECT waiting.id \
             FROM submissions waiting WHERE waiting.state = 'uploaded' AND waiting.attempts < $2 ORDER BY \
             (SELECT MAX(other.begun_us) FROM submissions other WHERE other.account = waiting.account), \
             waiting.created_us, waiting.id LIMIT 1) RETURNING id",
        )
        .bind(now_us())
        .bind(most)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(id) = id else { return Ok(None) };
        sqlx::query("DELETE FROM submission_lines WHERE submission = $1").bind(&id).execute(&mut *transaction).await?;
        transaction.commit().await?;
        self.submission(&id).await
    }

    /// Checks that an ended process left behind wait again; those begun `most` times already are given.
    pub async fn recover_checks(&self, most: i64) -> Result<Vec<SubmissionRow>> {
        sqlx::query("UPDATE submissions SET state = 'uploaded' WHERE state = 'vetted'").execute(&self.pool).await?;
        let rows = sqlx::query(select_submissions!("WHERE state = 'uploaded' AND attempts >= $1"))
            .bind(most)
            .fetch_all(&self.pool)
            .await?;
        rows.iter().map(read_submission).collect()
    }

    /// A check that was stopped with the service counts as no attempt; one that somebody ended stays so.
    pub async fn put_back_check(&self, id: &str) -> Result<()> {
        sqlx::query(
            "UPDATE submissions SET state = 'uploaded', attempts = attempts - 1 \
             WHERE id = $1 AND state IN ('uploaded', 'vetted')",
        )
        .bind(id)
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// Adds a line to the report.
    pub async fn add_line(&self, id: &str, seq: i64, line: &CheckLine) -> Result<()> {
        sqlx::query("INSERT INTO submission_lines (submission, seq, line) VALUES ($1, $2, $3)")
            .bind(id)
            .bind(seq)
            .bind(to_json(line)?)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// The report so far.
    pub async fn lines(&self, id: &str) -> Result<Vec<CheckLine>> {
        lines(&self.pool, id).await
    }
}

async fn submission(from: impl Executor<'_, Database = Any>, id: &str) -> Result<Option<SubmissionRow>> {
    let row = sqlx::query(select_submissions!("WHERE id = $1")).bind(id).fetch_optional(from).await?;
    row.as_ref().map(read_submission).transpose()
}

async fn lines(from: impl Executor<'_, Database = Any>, id: &str) -> Result<Vec<CheckLine>> {
    let rows: Vec<String> = sqlx::query_scalar("SELECT line FROM submission_lines WHERE submission = $1 ORDER BY seq")
        .bind(id)
        .fetch_all(from)
        .await?;
    rows.iter().map(|line| from_json(line)).collect()
}

pub(crate) fn read_submission(row: &AnyRow) -> Result<SubmissionRow> {
    let state: &str = row.try_get("state")?;
    let unknown = || EngineError::Fault(format!("The database holds a plugin in the unknown state {state:?}."));
    Ok(SubmissionRow {
        id: row.try_get("id")?,
        account: row.try_get("account")?,
        blob: row.try_get("blob")?,
        file: row.try_get("file")?,
        bytes: row.try_get::<i64, _>("bytes")? as u64,
        manifest: from_json(row.try_get("manifest")?)?,
        signed_by: row.try_get("signed_by")?,
        state: PluginState::named(state).ok_or_else(unknown)?,
        reason: row.try_get("reason")?,
        hardware_class: row.try_get("hardware_class")?,
        excluded_on: row.try_get("excluded_on")?,
        algorithms: from_json(row.try_get("algorithms")?)?,
        created_us: row.try_get("created_us")?,
        changed_us: row.try_get("changed_us")?,
    })
}
