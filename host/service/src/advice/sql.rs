//! Requests for advice and what became of them.

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::model::AdviceInfo;
use crate::store::{Store, from_json, now_us, to_json};

/// Blobs of one reduced object.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StoredPaper {
    /// The mesh, as OBJ.
    pub mesh: String,
    /// Its certificate, as JSON.
    pub certificate: String,
    /// Name of the file with the mesh.
    pub file: String,
}

/// One request.
pub struct AdviceRow {
    /// What everybody may see who knows the id.
    pub info: AdviceInfo,
    /// Who asked.
    pub owner: Option<String>,
    /// Reduced objects of A and of B, the coarsest first.
    pub papers: [Vec<StoredPaper>; 2],
    /// So often its work was begun.
    pub attempts: i64,
}

type Columns = (String, Option<String>, String, i64);

impl Store {
    /// Remembers a request; false when there is one with its id.
    pub async fn add_advice(&self, info: &AdviceInfo, owner: &str) -> Result<bool> {
        let added = sqlx::query(
            "INSERT INTO advice (id, owner, ended, attempts, info, papers, created_us) \
             VALUES ($1, $2, 0, 0, $3, '[[],[]]', $4) ON CONFLICT (id) DO NOTHING",
        )
        .bind(&info.id)
        .bind(owner)
        .bind(to_json(info)?)
        .bind(now_us())
        .execute(&self.pool)
        .await?;
        Ok(added.rows_affected() == 1)
    }

    /// Counts that the work on a request begins.
    pub async fn begin_advice(&self, id: &str) -> Result<()> {
        let text = "UPDATE advice SET attempts = attempts + 1 WHERE id = $1";
        sqlx::query(text).bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// Keeps what became of a request.
    pub async fn end_advice(&self, info: &AdviceInfo, papers: &[Vec<StoredPaper>; 2]) -> Result<()> {
        sqlx::query("UPDATE advice SET ended = 1, info = $1, papers = $2 WHERE id = $3")
            .bind(to_json(info)?)
            .bind(to_json(papers)?)
            .bind(&info.id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// A request by its id.
    pub async fn advice(&self, id: &str) -> Result<Option<AdviceRow>> {
        let text = "SELECT info, owner, papers, attempts FROM advice WHERE id = $1";
        let row: Option<Columns> = sqlx::query_as(text).bind(id).fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }

    /// Requests that have not ended, the oldest first.
    pub async fn open_advice(&self) -> Result<Vec<AdviceRow>> {
        let text = "SELECT info, owner, papers, attempts FROM advice WHERE ended = 0 ORDER BY created_us, id";
        let rows: Vec<Columns> = sqlx::query_as(text).fetch_all(&self.pool).await?;
        rows.into_iter().map(read).collect()
    }
}

fn read((info, owner, papers, attempts): Columns) -> Result<AdviceRow> {
    Ok(AdviceRow { info: from_json(&info)?, owner, papers: from_json(&papers)?, attempts })
}
