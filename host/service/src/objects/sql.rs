//! Objects that somebody added.

use crate::Result;
use crate::model::{Cursor, ObjectInfo, Visibility};
use crate::store::{Store, from_json, to_json};
use crate::visibility::sql::visibility;

/// One row of the table of objects.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectRow {
    /// As lists show it, with who sees it.
    pub info: ObjectInfo,
    /// Who added it.
    pub owner: Option<String>,
    /// The blob of its mesh.
    pub blob: String,
}

impl ObjectRow {
    /// Is it there for this viewer?
    pub fn is_for(&self, viewer: Option<&str>) -> bool {
        self.info.visibility != Visibility::Private || self.is_of(viewer)
    }

    /// Does it belong to this viewer?
    pub fn is_of(&self, viewer: Option<&str>) -> bool {
        viewer.is_some() && self.owner.as_deref() == viewer
    }

    /// As this viewer is shown it.
    pub fn shown_to(self, viewer: Option<&str>) -> ObjectInfo {
        ObjectInfo { mine: self.is_of(viewer), ..self.info }
    }
}

type Columns = (String, Option<String>, String, String);

impl Store {
    /// Adds an object whose mesh is in `blob`.
    pub async fn add_object(&self, info: &ObjectInfo, owner: Option<&str>, blob: &str) -> Result<()> {
        sqlx::query(
            "INSERT INTO objects (id, owner, blob, mesh_sha256, info, created_us, visibility) \
             VALUES ($1, $2, $3, $4, $5, $6, $7)",
        )
        .bind(&info.id)
        .bind(owner)
        .bind(blob)
        .bind(&info.sha256)
        .bind(to_json(info)?)
        .bind(info.created_us)
        .bind(info.visibility.name())
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// One object.
    pub async fn object(&self, id: &str) -> Result<Option<ObjectRow>> {
        let text = "SELECT info, owner, blob, visibility FROM objects WHERE id = $1";
        let row: Option<Columns> = sqlx::query_as(text).bind(id).fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }

    /// The owner's object with exactly this mesh.
    pub async fn object_with_mesh(&self, mesh_sha256: &str, owner: Option<&str>) -> Result<Option<ObjectRow>> {
        let row: Option<Columns> = sqlx::query_as(
            "SELECT info, owner, blob, visibility FROM objects WHERE mesh_sha256 = $1 AND COALESCE(owner, '') = $2 \
             ORDER BY created_us LIMIT 1",
        )
        .bind(mesh_sha256)
        .bind(owner.unwrap_or(""))
        .fetch_optional(&self.pool)
        .await?;
        row.map(read).transpose()
    }

    /// Bytes of all meshes, saved configurations and recordings of this owner.
    pub async fn uploaded_bytes(&self, owner: &str) -> Result<u64> {
        let bytes: i64 = sqlx::query_scalar(
            "SELECT CAST(COALESCE(SUM(b.bytes), 0) AS BIGINT) FROM (SELECT blob FROM objects WHERE owner = $1 \
             UNION ALL SELECT blob FROM saved_configurations WHERE owner = $1 \
             UNION SELECT blob FROM workloads WHERE owner = $1) o JOIN blobs b ON b.sha256 = o.blob",
        )
        .bind(owner)
        .fetch_one(&self.pool)
        .await?;
        Ok(bytes as u64)
    }

    /// The viewer's objects and the public ones of others from this place on, newest first, at most `limit`.
    pub async fn objects_for(&self, viewer: Option<&str>, from: &Cursor, limit: usize) -> Result<Vec<ObjectRow>> {
        let rows: Vec<Columns> = sqlx::query_as(
            "SELECT info, owner, blob, visibility FROM objects WHERE (visibility = 'public' OR owner = $1) \
             AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4",
        )
        .bind(viewer)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.into_iter().map(read).collect()
    }
}

/// Who sees it stands in its own column; what the JSON says of that is from the day it was added.
fn read((info, owner, blob, seen_by): Columns) -> Result<ObjectRow> {
    let info = ObjectInfo { visibility: visibility(&seen_by)?, mine: false, ..from_json(&info)? };
    Ok(ObjectRow { info, owner, blob })
}
