//! The idle work that was tried.

use std::collections::HashSet;

use crate::Result;
use crate::model::AlgorithmInfo;
use crate::runs::priority::IDLE;
use crate::store::{Store, now_us};

/// A piece of idle work that was tried, and the plugin file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tried {
    what: String,
    algorithm: String,
    plugin_sha256: String,
}

/// All of it.
pub type TriedSet = HashSet<Tried>;

impl Tried {
    /// Work that is tried once, independently of the plugin files.
    pub fn apart(what: &str) -> Self {
        Self { what: what.to_owned(), algorithm: String::new(), plugin_sha256: String::new() }
    }

    /// This, of this algorithm as it is now.
    pub fn of(what: &str, algorithm: &AlgorithmInfo) -> Self {
        Self { what: what.to_owned(), algorithm: algorithm.id.clone(), plugin_sha256: algorithm.plugin_sha256.clone() }
    }
}

impl Store {
    /// Everything that was tried while idle.
    pub async fn tried(&self) -> Result<TriedSet> {
        let rows: Vec<(String, String, String)> =
            sqlx::query_as("SELECT what, algorithm, plugin_sha256 FROM idle_tried").fetch_all(&self.pool).await?;
        let tried = |(what, algorithm, plugin_sha256)| Tried { what, algorithm, plugin_sha256 };
        Ok(rows.into_iter().map(tried).collect())
    }

    /// Notes that this run tries it.
    pub async fn note_tried(&self, tried: &Tried, run: &str) -> Result<()> {
        let text = "INSERT INTO idle_tried (what, algorithm, plugin_sha256, run) VALUES ($1, $2, $3, $4) \
                    ON CONFLICT DO NOTHING";
        let Tried { what, algorithm, plugin_sha256 } = tried;
        sqlx::query(text).bind(what).bind(algorithm).bind(plugin_sha256).bind(run).execute(&self.pool).await?;
        Ok(())
    }

    /// The run that tried it.
    pub async fn run_that_tried(&self, tried: &Tried) -> Result<Option<String>> {
        let text = "SELECT run FROM idle_tried WHERE what = $1 AND algorithm = $2 AND plugin_sha256 = $3";
        let Tried { what, algorithm, plugin_sha256 } = tried;
        let run = sqlx::query_scalar(text).bind(what).bind(algorithm).bind(plugin_sha256);
        Ok(run.fetch_optional(&self.pool).await?)
    }

    /// The work of this run counts as not tried.
    pub async fn forget_tried(&self, run: &str) -> Result<()> {
        sqlx::query("DELETE FROM idle_tried WHERE run = $1").bind(run).execute(&self.pool).await?;
        Ok(())
    }

    /// Ends runs that wait for an idle service, and gives their ids.
    pub async fn end_idle_runs(&self, message: &str) -> Result<Vec<String>> {
        let text = "UPDATE runs SET state = 'cancelled', message = $1, finished_us = $2 \
                    WHERE state = 'queued' AND priority = $3 RETURNING id";
        let ended = sqlx::query_scalar(text).bind(message).bind(now_us()).bind(IDLE).fetch_all(&self.pool).await?;
        Ok(ended)
    }
}
