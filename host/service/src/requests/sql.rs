//! What programs call their requests.

use crate::Result;
use crate::store::{Store, now_us};

/// A request that came under a key.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Who asked.
    pub owner: &'a str,
    /// For what.
    pub resource: &'a str,
    /// What they call it.
    pub key: &'a str,
    /// SHA-256 over what was asked.
    pub digest: &'a str,
}

impl Store {
    /// The id of what the request makes, and the digest of the first request under its key: `id` and its own when it is the first.
    pub async fn request(&self, request: Request<'_>, id: &str) -> Result<(String, String)> {
        let Request { owner, resource, key, digest } = request;
        sqlx::query(
            "INSERT INTO requests (owner, resource, request_key, digest, id, created_us) VALUES ($1, $2, $3, $4, $5, $6) \
             ON CONFLICT (owner, resource, request_key) DO NOTHING",
        )
        .bind(owner)
        .bind(resource)
        .bind(key)
        .bind(digest)
        .bind(id)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        let text = "SELECT id, digest FROM requests WHERE owner = $1 AND resource = $2 AND request_key = $3";
        Ok(sqlx::query_as(text).bind(owner).bind(resource).bind(key).fetch_one(&self.pool).await?)
    }

    /// Forgets what came before this moment.
    pub async fn forget_requests(&self, before_us: i64) -> Result<()> {
        sqlx::query("DELETE FROM requests WHERE created_us < $1").bind(before_us).execute(&self.pool).await?;
        Ok(())
    }
}
