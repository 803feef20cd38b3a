//! Summaries per algorithm, and what earlier ones say about the cost of a run.

use crate::Result;
use crate::model::AlgorithmResult;
use crate::runs::share::OfClass;
use crate::store::{Store, from_json, now_us, to_json};
use ocb_core::query::Query;
use sqlx::AnyConnection;

/// The result of one algorithm in one run.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredResult {
    /// Its numbers.
    pub result: AlgorithmResult,
    /// Blob of its records; absent when nothing was measured.
    pub records: Option<String>,
    /// Blob of its tests per triangle; absent when they were not counted.
    pub triangle_tests: Option<String>,
    /// SHA-256 of the plugin file that was measured.
    pub plugin_sha256: String,
    /// Wall seconds of one query with everything around it, for estimates.
    pub seconds_per_query: Option<f64>,
}

/// Result, records, tests per triangle, plugin file and seconds of a query, as they are stored.
type ResultRow = (String, Option<String>, Option<String>, String, Option<f64>);

impl Store {
    /// The results of a run in the order of its algorithms.
    pub async fn results(&self, run: &str) -> Result<Vec<StoredResult>> {
        let rows: Vec<ResultRow> = sqlx::query_as(
            "SELECT result, records, triangle_tests, plugin_sha256, seconds_per_query FROM results WHERE run_id = $1 \
             ORDER BY position",
        )
        .bind(run)
        .fetch_all(&self.pool)
        .await?;
        rows.into_iter()
            .map(|(result, records, triangle_tests, plugin_sha256, seconds_per_query)| {
                let result = from_json::<AlgorithmResult>(&result)?.renamed();
                Ok(StoredResult { result, records, triangle_tests, plugin_sha256, seconds_per_query })
            })
            .collect()
    }

    /// Triangles of both objects and wall seconds per query of this algorithm's newest 50 results on machines of this class,
    /// or on any while there is none.
    pub async fn result_rates(&self, algorithm: &str, query: Query, on: &OfClass) -> Result<Vec<(u64, f64)>> {
        let query = to_json(&query)?;
        for class in [Some(&on.class), None] {
            let rows: Vec<(i64, f64)> = sqlx::query_as(
                "SELECT triangles, seconds_per_query FROM results JOIN runs ON runs.id = run_id \
                 WHERE algorithm = $1 AND query = $2 AND seconds_per_query IS NOT NULL \
                 AND (CAST($4 AS TEXT) IS NULL OR COALESCE(runs.hardware_class, $3) = $4) \
                 ORDER BY results.created_us DESC LIMIT 50",
            )
            .bind(algorithm)
            .bind(&query)
            .bind(&on.usual)
            .bind(class)
            .fetch_all(&self.pool)
            .await?;
            if !rows.is_empty() {
                return Ok(rows.into_iter().map(|(triangles, seconds)| (triangles as u64, seconds)).collect());
            }
        }
        Ok(Vec::new())
    }
}

/// Keeps the result of one algorithm within a transaction; it replaces an earlier one.
pub(crate) async fn keep_result(
    connection: &mut AnyConnection,
    run: &str,
    position: usize,
    stored: &StoredResult,
    triangles: u64,
    query: Query,
) -> Result<()> {
    sqlx::query(
        "INSERT INTO results (run_id, algorithm, position, plugin_sha256, result, records, \
         triangle_tests, seconds_per_query, triangles, query, created_us) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11) \
         ON CONFLICT (run_id, algorithm) DO UPDATE SET plugin_sha256 = excluded.plugin_sha256, \
         result = excluded.result, records = excluded.records, triangle_tests = excluded.triangle_tests, \
         seconds_per_query = excluded.seconds_per_query, created_us = excluded.created_us",
    )
    .bind(run)
    .bind(&stored.result.algorithm)
    .bind(position as i64)
    .bind(&stored.plugin_sha256)
    .bind(to_json(&stored.result)?)
    .bind(stored.records.as_deref())
    .bind(stored.triangle_tests.as_deref())
    .bind(stored.seconds_per_query)
    .bind(triangles as i64)
    .bind(to_json(&query)?)
    .bind(now_us())
    .execute(connection)
    .await?;
    Ok(())
}
