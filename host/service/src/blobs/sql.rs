//! Which blobs are known.

use crate::Result;
use crate::store::{Store, now_us};

impl Store {
    /// Notes a blob; a known one stays as it is.
    pub async fn add_blob(&self, sha256: &str, bytes: usize, media_type: &str) -> Result<()> {
        sqlx::query(
            "INSERT INTO blobs (sha256, bytes, media_type, created_us) VALUES ($1, $2, $3, $4) \
             ON CONFLICT (sha256) DO NOTHING",
        )
        .bind(sha256)
        .bind(bytes as i64)
        .bind(media_type)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// Size of a known blob in bytes.
    pub async fn blob_bytes(&self, sha256: &str) -> Result<Option<u64>> {
        let bytes: Option<i64> = sqlx::query_scalar("SELECT bytes FROM blobs WHERE sha256 = $1")
            .bind(sha256)
            .fetch_optional(&self.pool)
            .await?;
        Ok(bytes.map(|b| b as u64))
    }
}
