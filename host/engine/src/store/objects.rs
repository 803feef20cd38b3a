//! Objects that somebody added.

use super::{Store, from_json, to_json};
use crate::Result;
use crate::model::ObjectInfo;

impl Store {
    /// Adds an object whose mesh is in `blob`.
    pub async fn add_object(&self, info: &ObjectInfo, owner: Option<&str>, blob: &str) -> Result<()> {
        sqlx::query(
            "INSERT INTO objects (id, owner, blob, mesh_sha256, info, created_us) VALUES ($1, $2, $3, $4, $5, $6)",
        )
        .bind(&info.id)
        .bind(owner)
        .bind(blob)
        .bind(&info.sha256)
        .bind(to_json(info)?)
        .bind(info.created_us)
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// The object and the blob of its mesh.
    pub async fn object(&self, id: &str) -> Result<Option<(ObjectInfo, String)>> {
        let row: Option<(String, String)> =
            sqlx::query_as("SELECT info, blob FROM objects WHERE id = $1").bind(id).fetch_optional(&self.pool).await?;
        row.map(|(info, blob)| Ok((from_json(&info)?, blob))).transpose()
    }

    /// The owner's object with exactly this mesh.
    pub async fn object_with_mesh(&self, mesh_sha256: &str, owner: Option<&str>) -> Result<Option<ObjectInfo>> {
        let row: Option<String> = sqlx::query_scalar(
            "SELECT info FROM objects WHERE mesh_sha256 = $1 AND COALESCE(owner, '') = $2 ORDER BY created_us LIMIT 1",
        )
        .bind(mesh_sha256)
        .bind(owner.unwrap_or(""))
        .fetch_optional(&self.pool)
        .await?;
        row.map(|info| from_json(&info)).transpose()
    }

    /// The owner's objects, newest first.
    pub async fn objects_of(&self, owner: &str) -> Result<Vec<ObjectInfo>> {
        let rows: Vec<String> =
            sqlx::query_scalar("SELECT info FROM objects WHERE owner = $1 ORDER BY created_us DESC, id DESC")
                .bind(owner)
                .fetch_all(&self.pool)
                .await?;
        rows.iter().map(|info| from_json(info)).collect()
    }
}
