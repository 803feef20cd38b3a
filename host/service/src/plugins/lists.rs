//! Lists of submitted plugins, cut by the database: no page reads more rows than it shows.

use crate::Result;
use crate::model::Cursor;
use crate::plugins::sql::{PluginRow, read_plugin, select_plugins};
use crate::store::Store;

impl Store {
    /// What everybody may look at, and all that this account has sent, from this place on, newest first, at most `limit`.
    pub async fn plugins_for(&self, account: Option<&str>, from: &Cursor, limit: usize) -> Result<Vec<PluginRow>> {
        let rows = sqlx::query(select_plugins!(
            "WHERE (state IN ('public', 'suspended', 'excluded', 'withdrawn') OR account = $1) \
             AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4"
        ))
        .bind(account)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_plugin).collect()
    }

    /// What waits for a curator from this place on, oldest first, at most `limit`. In its places times count backwards, so
    /// that it is a list like the others.
    pub async fn waiting_plugins(&self, from: &Cursor, limit: usize) -> Result<Vec<PluginRow>> {
        let rows = sqlx::query(select_plugins!(
            "WHERE state IN ('awaiting', 'asked') AND (-changed_us, id) < ($1, $2) \
             ORDER BY changed_us, id DESC LIMIT $3"
        ))
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_plugin).collect()
    }

    /// What the account has published, newest first.
    pub async fn published_by(&self, account: &str) -> Result<Vec<PluginRow>> {
        let rows = sqlx::query(select_plugins!(
            "WHERE account = $1 AND state IN ('public', 'suspended', 'excluded', 'withdrawn') \
             ORDER BY created_us DESC, id DESC"
        ))
        .bind(account)
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_plugin).collect()
    }

    /// How many other accounts have sent this file.
    pub async fn twins(&self, blob: &str, account: &str) -> Result<usize> {
        let count: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM submissions WHERE blob = $1 AND account <> $2")
            .bind(blob)
            .bind(account)
            .fetch_one(&self.pool)
            .await?;
        Ok(count as usize)
    }
}
