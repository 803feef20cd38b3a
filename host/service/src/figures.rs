//! Figures by which an operator watches the service.

use crate::boxed;
use crate::engine::Engine;
use crate::runs::priority::{BACKGROUND, INTERACTIVE};
use crate::store::{Store, now_us};
use crate::{Result, model::Status};

/// How much is stored, waits and is under way.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Version, hardware class, queue, algorithms and problems.
    pub status: Status,
    /// Number of runs in each state that there is one in.
    pub runs: Vec<(String, u64)>,
    /// Number of submitted plugins in each state that there is one in.
    pub plugins: Vec<(String, u64)>,
    /// Bytes of all blobs.
    pub blob_bytes: u64,
}

impl Engine {
    /// The figures of this moment.
    #[boxed]
    pub async fn figures(&self) -> Result<Figures> {
        let store = &self.inner.store;
        Ok(Figures {
            status: self.status().await?,
            runs: store.counts("SELECT state, COUNT(*) FROM runs GROUP BY state ORDER BY state").await?,
            plugins: store.counts("SELECT state, COUNT(*) FROM submissions GROUP BY state ORDER BY state").await?,
            blob_bytes: store.blob_total().await?,
        })
    }
}

impl Store {
    async fn counts(&self, text: &'static str) -> Result<Vec<(String, u64)>> {
        let rows: Vec<(String, i64)> = sqlx::query_as(text).fetch_all(&self.pool).await?;
        Ok(rows.into_iter().map(|(state, count)| (state, count as u64)).collect())
    }

    /// How long the oldest waiting run has waited; 0 when none waits.
    pub(crate) async fn oldest_seconds(&self) -> Result<f64> {
        // Of each priority, the oldest is the first in an index; of both at once, all would be read.
        let text = "SELECT MIN(created_us) FROM runs WHERE state = 'queued' AND priority = $1";
        let mut oldest: Option<i64> = None;
        for priority in [INTERACTIVE, BACKGROUND] {
            let first: Option<i64> = sqlx::query_scalar(text).bind(priority).fetch_one(&self.pool).await?;
            oldest = oldest.into_iter().chain(first).min();
        }
        Ok(oldest.map_or(0.0, |oldest_us| (now_us() - oldest_us).max(0) as f64 / 1e6))
    }

    async fn blob_total(&self) -> Result<u64> {
        // PostgreSQL adds integers up to a type of its own.
        let text = "SELECT CAST(COALESCE(SUM(bytes), 0) AS BIGINT) FROM blobs";
        let bytes: i64 = sqlx::query_scalar(text).fetch_one(&self.pool).await?;
        Ok(bytes as u64)
    }
}
