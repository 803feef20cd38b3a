//! Requests for advice and what became of them.

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end, while_current, withdraw};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, Outcome};
use crate::model::AdviceInfo;
use crate::runs::queue::served;
use crate::runs::share::Since;
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
    /// Who asked; nobody: the service itself, while it is idle.
    pub owner: Option<String>,
    /// Reduced objects of A and of B, the coarsest first.
    pub papers: [Vec<StoredPaper>; 2],
    /// So often its work was begun, without what was put back.
    pub attempts: i64,
}

type Columns = (String, Option<String>, String, i64);

impl Store {
    /// Remembers a request, which waits; false when there is one with its id. Without an owner it is the service's own.
    pub async fn add_advice(&self, info: &AdviceInfo, owner: Option<&str>, turn: &str) -> Result<bool> {
        let text = "INSERT INTO advice (id, owner, turn, ended, attempts, info, papers, created_us) \
                    VALUES ($1, $2, $3, 0, 0, $4, '[[],[]]', $5) ON CONFLICT (id) DO NOTHING";
        let insert = sqlx::query(text).bind(&info.id).bind(owner).bind(turn).bind(to_json(info)?).bind(now_us());
        Ok(insert.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// The request that is due: of the visitor who was served longest ago, or the oldest of the service's own.
    pub async fn next_advice(&self, own: bool) -> Result<Option<Since>> {
        let text = concat!(
            "SELECT COALESCE(s.served_us, 0), v.created_us, v.id FROM advice v LEFT JOIN served s ON s.owner = v.turn ",
            "WHERE v.ended = 0 AND CASE WHEN v.owner IS NULL THEN 1 ELSE 0 END = CAST($1 AS BIGINT) AND ",
            at_rest!("advise", "v.id"),
            " ORDER BY COALESCE(s.served_us, 0), v.created_us, v.id LIMIT 1"
        );
        Ok(sqlx::query_as(text).bind(i64::from(own)).fetch_optional(&self.pool).await?)
    }

    /// Begins the request that is due. Its attempts count this one.
    pub async fn begin_advice(&self, own: bool, worker: &Worker) -> Result<Option<(Attempt, AdviceRow)>> {
        // Another worker may take what this one has chosen; then it chooses again.
        while let Some((.., next)) = self.next_advice(own).await? {
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, Kind::Advise, &next, worker).await? else { continue };
            let text = "UPDATE advice SET attempts = attempts + 1 WHERE id = $1 AND ended = 0 RETURNING turn";
            let turn: Option<String> = sqlx::query_scalar(text).bind(&next).fetch_optional(&mut *transaction).await?;
            let Some(turn) = turn else { continue };
            served(&mut transaction, &turn).await?;
            transaction.commit().await?;
            return Ok(self.advice(&next).await?.map(|row| (attempt, row)));
        }
        Ok(None)
    }

    /// Notes how far a machine is; false when the attempt is not the current one.
    pub async fn advice_is_at(&self, attempt: &Attempt, info: &AdviceInfo) -> Result<bool> {
        let text = concat!("UPDATE advice SET info = $1 WHERE id = $2 AND ", while_current!("$3"));
        let done = sqlx::query(text).bind(to_json(info)?).bind(&attempt.job).bind(&attempt.id);
        Ok(done.execute(&self.pool).await?.rows_affected() == 1)
    }

    /// Ends a request that no worker is at; false when one is.
    pub async fn end_waiting_advice(&self, info: &AdviceInfo) -> Result<bool> {
        let text = concat!(
            "UPDATE advice SET ended = 1, info = $1 WHERE id = $2 AND ended = 0 AND ",
            at_rest!("advise", "advice.id")
        );
        let done = sqlx::query(text).bind(to_json(info)?).bind(&info.id).execute(&self.pool).await?;
        Ok(done.rows_affected() == 1)
    }

    /// Keeps what became of a request; false when the attempt is not the current one.
    pub async fn end_advice(
        &self,
        attempt: &Attempt,
        info: &AdviceInfo,
        papers: &[Vec<StoredPaper>; 2],
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        sqlx::query("UPDATE advice SET ended = 1, info = $1, papers = $2 WHERE id = $3")
            .bind(to_json(info)?)
            .bind(to_json(papers)?)
            .bind(&info.id)
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Ends a request that another worker is at; false when none is.
    pub async fn withdraw_advice(&self, info: &AdviceInfo, here: &Worker) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !withdraw(&mut transaction, Kind::Advise, &info.id, here).await? {
            return Ok(false);
        }
        let text = "UPDATE advice SET ended = 1, info = $1 WHERE id = $2";
        sqlx::query(text).bind(to_json(info)?).bind(&info.id).execute(&mut *transaction).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// A request that was stopped for now waits again, and the attempt does not count.
    pub async fn put_back_advice(&self, attempt: &Attempt) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        if end(&mut transaction, attempt, Outcome::PutBack).await? {
            let text = "UPDATE advice SET attempts = attempts - 1 WHERE id = $1";
            sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        }
        Ok(transaction.commit().await?)
    }

    /// A request by its id.
    pub async fn advice(&self, id: &str) -> Result<Option<AdviceRow>> {
        let text = "SELECT info, owner, papers, attempts FROM advice WHERE id = $1";
        let row: Option<Columns> = sqlx::query_as(text).bind(id).fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }

    /// How many requests of visitors have no end, and how many of these are whose.
    pub async fn count_open_advice(&self, turn: &str) -> Result<[usize; 2]> {
        let text = "SELECT COUNT(*), CAST(COALESCE(SUM(CASE WHEN turn = $1 THEN 1 ELSE 0 END), 0) AS BIGINT) \
                    FROM advice WHERE ended = 0 AND owner IS NOT NULL";
        let (all, own): (i64, i64) = sqlx::query_as(text).bind(turn).fetch_one(&self.pool).await?;
        Ok([all as usize, own as usize])
    }
}

fn read((info, owner, papers, attempts): Columns) -> Result<AdviceRow> {
    Ok(AdviceRow { info: from_json(&info)?, owner, papers: from_json(&papers)?, attempts })
}
