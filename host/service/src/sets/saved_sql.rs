//! Saved configurations.

use crate::Result;
use crate::model::{Cursor, SavedConfigurations};
use crate::store::Store;

type Columns = (String, String, String, i64, i64, i64);

impl Store {
    /// Saves configurations for this owner.
    pub async fn add_saved(&self, saved: &SavedConfigurations, owner: &str) -> Result<()> {
        sqlx::query(
            "INSERT INTO saved_configurations (id, owner, blob, name, configurations, straightened, created_us) \
             VALUES ($1, $2, $3, $4, $5, $6, $7)",
        )
        .bind(&saved.id)
        .bind(owner)
        .bind(&saved.sha256)
        .bind(&saved.name)
        .bind(i64::from(saved.configurations))
        .bind(i64::from(saved.straightened))
        .bind(saved.created_us)
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// Those with this id, if they are this owner's.
    pub async fn saved(&self, id: &str, owner: &str) -> Result<Option<SavedConfigurations>> {
        self.one_saved("WHERE id = $1 AND owner = $2", id, owner).await
    }

    /// The owner's from exactly this file.
    pub async fn saved_from(&self, sha256: &str, owner: &str) -> Result<Option<SavedConfigurations>> {
        self.one_saved("WHERE blob = $1 AND owner = $2 ORDER BY created_us LIMIT 1", sha256, owner).await
    }

    async fn one_saved(&self, which: &str, what: &str, owner: &str) -> Result<Option<SavedConfigurations>> {
        let text = format!(
            "SELECT id, blob, name, configurations, straightened, created_us FROM saved_configurations {which}"
        );
        let row: Option<Columns> =
            sqlx::query_as(sqlx::AssertSqlSafe(text)).bind(what).bind(owner).fetch_optional(&self.pool).await?;
        Ok(row.map(read))
    }

    /// The owner's from this place on, newest first, at most `limit`.
    pub async fn saved_of(&self, owner: &str, from: &Cursor, limit: usize) -> Result<Vec<SavedConfigurations>> {
        let rows: Vec<Columns> = sqlx::query_as(
            "SELECT id, blob, name, configurations, straightened, created_us FROM saved_configurations \
             WHERE owner = $1 AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4",
        )
        .bind(owner)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        Ok(rows.into_iter().map(read).collect())
    }
}

fn read((id, sha256, name, configurations, straightened, created_us): Columns) -> SavedConfigurations {
    let (configurations, straightened) = (configurations as u32, straightened as u32);
    SavedConfigurations { id, name, sha256, configurations, straightened, created_us }
}
