//! Plugins as the jailed runner described them.

use crate::Result;
use crate::model::AlgorithmInfo;
use crate::store::{Store, from_json, now_us, to_json};

impl Store {
    /// What the plugin described that is known by this hash, when it was described before.
    pub async fn described(&self, known_as: &str) -> Result<Option<Vec<AlgorithmInfo>>> {
        let row: Option<String> = sqlx::query_scalar("SELECT algorithms FROM plugins WHERE sha256 = $1")
            .bind(known_as)
            .fetch_optional(&self.pool)
            .await?;
        row.map(|text| from_json(&text)).transpose()
    }

    /// Keeps what a plugin file described.
    pub async fn keep_description(&self, known_as: &str, algorithms: &[AlgorithmInfo]) -> Result<()> {
        sqlx::query(
            "INSERT INTO plugins (sha256, algorithms, created_us) VALUES ($1, $2, $3) \
             ON CONFLICT (sha256) DO UPDATE SET algorithms = excluded.algorithms",
        )
        .bind(known_as)
        .bind(to_json(&algorithms)?)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        Ok(())
    }
}
