//! Plugins that developers bring, and their reports.

use sqlx::any::AnyRow;
use sqlx::{Any, AnyConnection, Executor, Row};

use crate::audit::Note;
use crate::audit::{append, notes_on};
use crate::model::{AlgorithmInfo, AuditEntry, CheckLine, Manifest, PluginState};
use crate::notices::sql::NewNotice;
use crate::notices::sql::tell;
use crate::store::{Store, from_json, now_us, to_json};
use crate::{EngineError, Result};

/// Who acts when nobody does.
pub const THE_SERVICE: &str = "the service";

/// One submitted plugin, as in the table `submissions`.
#[derive(Clone, Debug, PartialEq)]
pub struct PluginRow {
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

macro_rules! select_plugins {
    ($rest:literal) => {
        concat!(
            "SELECT id, account, blob, file, bytes, manifest, signed_by, state, reason, hardware_class, excluded_on, ",
            "algorithms, created_us, changed_us FROM submissions ",
            $rest
        )
    };
}
pub(crate) use select_plugins;

impl Store {
    /// Adds a submitted plugin, and notes it; false when the account has sent these bytes before.
    pub async fn add_plugin(&self, row: &PluginRow, note: Note<'_>) -> Result<bool> {
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
    pub async fn sign_plugin(&self, id: &str, key: &str, note: Note<'_>) -> Result<()> {
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

    /// One submitted plugin.
    pub async fn plugin(&self, id: &str) -> Result<Option<PluginRow>> {
        plugin(&self.pool, id).await
    }

    /// One submitted plugin with its report and its history, all of one moment: a state that its history does not tell of yet, or
    /// no longer, would look half done.
    pub async fn whole_plugin(&self, id: &str) -> Result<Option<(PluginRow, Vec<CheckLine>, Vec<AuditEntry>)>> {
        let mut moment = self.pool.begin_with(self.one_moment).await?;
        let row = plugin(&mut *moment, id).await?;
        let lines = lines(&mut *moment, id).await?;
        let history = notes_on(&mut *moment, id).await?;
        moment.commit().await?;
        Ok(row.map(|row| (row, lines, history)))
    }

    /// The account's plugin of these bytes.
    pub async fn plugin_of(&self, account: &str, blob: &str) -> Result<Option<PluginRow>> {
        let row = sqlx::query(select_plugins!("WHERE account = $1 AND blob = $2"))
            .bind(account)
            .bind(blob)
            .fetch_optional(&self.pool)
            .await?;
        row.as_ref().map(read_plugin).transpose()
    }

    /// All submitted plugins, newest first.
    pub async fn plugins(&self) -> Result<Vec<PluginRow>> {
        let rows = sqlx::query(select_plugins!("ORDER BY created_us DESC, id DESC")).fetch_all(&self.pool).await?;
        rows.iter().map(read_plugin).collect()
    }

    /// Moves a plugin from one state to another, tells its author and notes it; false when it was not in the first.
    pub async fn move_plugin(
        &self,
        id: &str,
        from: PluginState,
        to: PluginState,
        reason: &str,
        new_notice: Option<NewNotice<'_>>,
        note: Option<Note<'_>>,
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let moved = move_from(&mut transaction, id, from, to, reason).await?;
        if let Some(new_notice) = new_notice.filter(|_| moved) {
            tell(&mut transaction, new_notice).await?;
        }
        if let Some(note) = note.filter(|_| moved) {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(moved)
    }

    /// Takes a public plugin out on this hardware class, tells its author and notes it; false when it is not public any more,
    /// or has changed since it failed.
    pub async fn exclude_plugin(
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

    /// The report so far.
    pub async fn lines(&self, id: &str) -> Result<Vec<CheckLine>> {
        lines(&self.pool, id).await
    }
}

/// Moves a plugin from one state to another within a transaction; false when it was not in the first.
pub(crate) async fn move_from(
    connection: &mut AnyConnection,
    id: &str,
    from: PluginState,
    to: PluginState,
    reason: &str,
) -> Result<bool> {
    let done = sqlx::query(
        "UPDATE submissions SET state = $1, reason = $2, changed_us = $3, excluded_on = NULL \
         WHERE id = $4 AND state = $5",
    )
    .bind(to.name())
    .bind(reason)
    .bind(now_us())
    .bind(id)
    .bind(from.name())
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}

pub(crate) async fn plugin(from: impl Executor<'_, Database = Any>, id: &str) -> Result<Option<PluginRow>> {
    let row = sqlx::query(select_plugins!("WHERE id = $1")).bind(id).fetch_optional(from).await?;
    row.as_ref().map(read_plugin).transpose()
}

async fn lines(from: impl Executor<'_, Database = Any>, id: &str) -> Result<Vec<CheckLine>> {
    let rows: Vec<String> = sqlx::query_scalar("SELECT line FROM submission_lines WHERE submission = $1 ORDER BY seq")
        .bind(id)
        .fetch_all(from)
        .await?;
    rows.iter().map(|line| from_json(line)).collect()
}

pub(crate) fn read_plugin(row: &AnyRow) -> Result<PluginRow> {
    let state: &str = row.try_get("state")?;
    let unknown = || EngineError::Fault(format!("The database holds a plugin in the unknown state {state:?}."));
    Ok(PluginRow {
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
