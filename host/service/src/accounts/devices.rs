//! The browsers that have logged in to an account.

use crate::Result;
use crate::store::{Store, now_us};

impl Store {
    /// Has it logged in to the account of this name?
    pub async fn knows_device(&self, name: &str, sha256: &str) -> Result<bool> {
        let text = "SELECT COUNT(*) FROM devices d JOIN accounts a ON a.id = d.account \
                    WHERE a.folded = $1 AND a.deleted_us IS NULL AND d.sha256 = $2";
        let known: i64 = sqlx::query_scalar(text).bind(name.to_lowercase()).bind(sha256).fetch_one(&self.pool).await?;
        Ok(known > 0)
    }

    /// Records a login, and keeps the newest devices of the account only.
    pub async fn remember_device(&self, account: &str, sha256: &str, most: i64) -> Result<()> {
        sqlx::query(
            "INSERT INTO devices (account, sha256, entered_us) VALUES ($1, $2, $3) \
             ON CONFLICT (account, sha256) DO UPDATE SET entered_us = excluded.entered_us",
        )
        .bind(account)
        .bind(sha256)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        sqlx::query(
            "DELETE FROM devices WHERE account = $1 AND sha256 NOT IN ( \
                 SELECT sha256 FROM devices WHERE account = $1 ORDER BY entered_us DESC, sha256 LIMIT $2)",
        )
        .bind(account)
        .bind(most)
        .execute(&self.pool)
        .await?;
        Ok(())
    }
}
