//! Where methods fail, one row per algorithm.

use crate::Result;
use crate::model::Stability;
use crate::store::{Store, from_json, to_json};

impl Store {
    /// The newest result of each algorithm, by id.
    pub async fn stability(&self) -> Result<Vec<Stability>> {
        let rows: Vec<String> =
            sqlx::query_scalar("SELECT result FROM stability ORDER BY algorithm").fetch_all(&self.pool).await?;
        rows.iter().map(|text| from_json(text)).collect()
    }

    /// Keeps a result in place of the one before.
    pub async fn keep_stability(&self, result: &Stability) -> Result<()> {
        sqlx::query(
            "INSERT INTO stability (algorithm, result, created_us) VALUES ($1, $2, $3) \
             ON CONFLICT (algorithm) DO UPDATE SET result = excluded.result, created_us = excluded.created_us",
        )
        .bind(&result.algorithm)
        .bind(to_json(result)?)
        .bind(result.created_us)
        .execute(&self.pool)
        .await?;
        Ok(())
    }
}
