//! Configuration sets by what determines them.

use crate::Result;
use crate::model::SetInfo;
use crate::store::{Store, from_json, now_us, to_json};

/// A set that is stored already.
pub struct StoredSet {
    /// Its numbers.
    pub info: SetInfo,
    /// Blob of its Parquet file.
    pub blob: String,
}

impl Store {
    /// The set with this key, if somebody made it before.
    pub async fn set(&self, key: &str) -> Result<Option<StoredSet>> {
        let row: Option<(String, String)> =
            sqlx::query_as("SELECT info, blob FROM sets WHERE id = $1").bind(key).fetch_optional(&self.pool).await?;
        row.map(|(info, blob)| Ok(StoredSet { info: from_json(&info)?, blob })).transpose()
    }

    /// Keeps a set: `triangles` of both objects and the `seconds` it took feed later estimates.
    pub async fn keep_set(&self, key: &str, info: &SetInfo, blob: &str, triangles: u64, seconds: f64) -> Result<()> {
        sqlx::query(
            "INSERT INTO sets (id, blob, info, configurations, triangles, seconds, created_us) \
             VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (id) DO NOTHING",
        )
        .bind(key)
        .bind(blob)
        .bind(to_json(info)?)
        .bind(i64::from(info.configurations))
        .bind(triangles as i64)
        .bind(seconds)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// Triangles of both objects and seconds per configuration of the newest 50 sets.
    pub async fn set_rates(&self) -> Result<Vec<(u64, f64)>> {
        let rows: Vec<(i64, f64)> = sqlx::query_as(
            "SELECT triangles, seconds / configurations FROM sets WHERE configurations > 0 \
             ORDER BY created_us DESC LIMIT 50",
        )
        .fetch_all(&self.pool)
        .await?;
        Ok(rows.into_iter().map(|(t, s)| (t as u64, s)).collect())
    }
}
