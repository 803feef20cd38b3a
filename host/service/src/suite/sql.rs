//! Suites that were measured here, and their runs.

use crate::Result;
use crate::runs::sql::RunRow;
use crate::runs::sql::read_run;
use crate::store::{Store, now_us};
use crate::suite::Suite;

impl Store {
    /// Keeps a suite; false when another one of this version is there.
    pub async fn keep_suite(&self, suite: &Suite) -> Result<bool> {
        sqlx::query(
            "INSERT INTO suites (sha256, version, document, created_us) VALUES ($1, $2, $3, $4) ON CONFLICT DO NOTHING",
        )
        .bind(&suite.sha256)
        .bind(i64::from(suite.document.version))
        .bind(&suite.text)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        let kept: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM suites WHERE sha256 = $1")
            .bind(&suite.sha256)
            .fetch_one(&self.pool)
            .await?;
        Ok(kept == 1)
    }

    /// The suites that were measured here.
    pub async fn suites(&self) -> Result<Vec<Suite>> {
        let rows: Vec<String> =
            sqlx::query_scalar("SELECT document FROM suites ORDER BY version").fetch_all(&self.pool).await?;
        rows.iter().map(|text| Suite::read(text)).collect()
    }

    /// Runs of suites that wait, are at work or have results; the newest first.
    pub async fn suite_runs(&self) -> Result<Vec<RunRow>> {
        let rows = sqlx::query(crate::runs::sql::select_runs!(
            "WHERE suite IS NOT NULL AND state IN ('queued', 'running', 'done') ORDER BY created_us DESC, id DESC"
        ))
        .fetch_all(&self.pool)
        .await?;
        rows.iter().map(read_run).collect()
    }
}
