//! What an owner has, and taking it away with the stored files that nobody else uses.

use ocb_core::configuration::Method;
use sqlx::AnyConnection;

use crate::Result;
use crate::advice::sql::StoredPaper;
use crate::attempts::sql::forget as forget_attempts;
use crate::model::{OwnedItem, RunSpec};
use crate::store::{Store, from_json, now_us};

/// Runs, objects, saved configurations, advice, stability runs, workloads and plugins of one owner.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnedIds {
    /// Newest first.
    pub runs: Vec<OwnedItem>,
    /// Newest first.
    pub objects: Vec<OwnedItem>,
    /// Their ids.
    pub advice: Vec<String>,
    /// Saved configurations, newest first.
    pub configurations: Vec<OwnedItem>,
    /// Ids of stability runs.
    pub stability: Vec<String>,
    /// Ids of workloads.
    pub workloads: Vec<String>,
    /// Theirs, too; only an account that is deleted takes plugins along.
    pub plugins: Vec<String>,
}

/// A stored file that nobody uses any more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unused {
    /// Its name.
    pub sha256: String,
    /// Its size.
    pub bytes: u64,
}

impl Store {
    /// Everything but plugins that this owner has; with an object, only that and what was made with it.
    pub async fn owned_ids(&self, owner: &str, object: Option<&str>) -> Result<OwnedIds> {
        // Ids stand in requests as JSON texts, and hold nothing that LIKE would read otherwise.
        let named = object.map_or_else(|| "%".to_owned(), |id| format!("%\"{id}\"%"));
        let runs: Vec<(String, String, String)> = sqlx::query_as(
            "SELECT id, object_a_name, object_b_name FROM runs WHERE owner = $1 AND spec LIKE $2 \
             ORDER BY created_us DESC, id DESC",
        )
        .bind(owner)
        .bind(&named)
        .fetch_all(&self.pool)
        .await?;
        let objects: Vec<(String, String)> = sqlx::query_as(
            "SELECT id, info FROM objects WHERE owner = $1 AND id LIKE $2 ORDER BY created_us DESC, id DESC",
        )
        .bind(owner)
        .bind(object.unwrap_or("%"))
        .fetch_all(&self.pool)
        .await?;
        let advice: Vec<String> = sqlx::query_scalar("SELECT id FROM advice WHERE owner = $1 AND info LIKE $2")
            .bind(owner)
            .bind(&named)
            .fetch_all(&self.pool)
            .await?;
        // They name no object.
        let (configurations, [stability, workloads]): (Vec<(String, String)>, [Vec<String>; 2]) = match object {
            Some(_) => Default::default(),
            None => {
                let saved =
                    "SELECT id, name FROM saved_configurations WHERE owner = $1 ORDER BY created_us DESC, id DESC";
                let tried = "SELECT id FROM stability_runs WHERE owner = $1 ORDER BY created_us DESC, id DESC";
                let replayed = "SELECT id FROM workloads WHERE owner = $1 ORDER BY created_us DESC, id DESC";
                let saved = sqlx::query_as(saved).bind(owner).fetch_all(&self.pool).await?;
                let tried = sqlx::query_scalar(tried).bind(owner).fetch_all(&self.pool).await?;
                (saved, [tried, sqlx::query_scalar(replayed).bind(owner).fetch_all(&self.pool).await?])
            }
        };
        let run = |(id, a, b): (String, String, String)| OwnedItem { id, name: format!("{a} x {b}") };
        let object = |(id, info): (String, String)| {
            Ok(OwnedItem { id, name: from_json::<crate::model::ObjectInfo>(&info)?.name })
        };
        Ok(OwnedIds {
            runs: runs.into_iter().map(run).collect(),
            objects: objects.into_iter().map(object).collect::<Result<_>>()?,
            advice,
            configurations: configurations.into_iter().map(|(id, name)| OwnedItem { id, name }).collect(),
            stability,
            workloads,
            plugins: Vec::new(),
        })
    }

    /// Takes these away and tells which files nobody uses any more.
    pub async fn take_away(&self, what: &OwnedIds) -> Result<Vec<Unused>> {
        let mut transaction = self.pool.begin().await?;
        let unused = take(&mut transaction, what).await?;
        transaction.commit().await?;
        Ok(unused)
    }

    /// When this owner last made something or asked to have it kept; nothing when they have nothing.
    pub async fn last_wanted(&self, owner: &str) -> Result<Option<i64>> {
        let text = "SELECT MAX(us) FROM (SELECT MAX(created_us) AS us FROM runs WHERE owner = $1 \
                    UNION ALL SELECT MAX(created_us) FROM objects WHERE owner = $2 \
                    UNION ALL SELECT MAX(created_us) FROM advice WHERE owner = $3 \
                    UNION ALL SELECT MAX(created_us) FROM saved_configurations WHERE owner = $4 \
                    UNION ALL SELECT MAX(created_us) FROM stability_runs WHERE owner = $5 \
                    UNION ALL SELECT MAX(created_us) FROM workloads WHERE owner = $6) AS made";
        let made = sqlx::query_scalar(text).bind(owner).bind(owner).bind(owner).bind(owner).bind(owner).bind(owner);
        let made: Option<i64> = made.fetch_one(&self.pool).await?;
        let asked: Option<i64> = sqlx::query_scalar("SELECT asked_us FROM kept WHERE owner = $1")
            .bind(owner)
            .fetch_optional(&self.pool)
            .await?;
        Ok(made.map(|made| made.max(asked.unwrap_or(made))))
    }

    /// Notes that this owner asked to have everything kept longer.
    pub async fn keep_longer(&self, owner: &str) -> Result<()> {
        let text = "INSERT INTO kept (owner, asked_us) VALUES ($1, $2) \
                    ON CONFLICT (owner) DO UPDATE SET asked_us = excluded.asked_us";
        sqlx::query(text).bind(owner).bind(now_us()).execute(&self.pool).await?;
        Ok(())
    }

    /// Whoever has something.
    pub async fn owners(&self) -> Result<Vec<String>> {
        let text = "SELECT owner FROM runs WHERE owner IS NOT NULL UNION SELECT owner FROM objects WHERE owner IS NOT NULL \
                    UNION SELECT owner FROM advice WHERE owner IS NOT NULL \
                    UNION SELECT owner FROM saved_configurations \
                    UNION SELECT owner FROM stability_runs WHERE owner IS NOT NULL \
                    UNION SELECT owner FROM workloads WHERE owner IS NOT NULL";
        Ok(sqlx::query_scalar(text).fetch_all(&self.pool).await?)
    }
}

/// Takes these away within a transaction and tells which files nobody uses any more.
pub(crate) async fn take(connection: &mut AnyConnection, what: &OwnedIds) -> Result<Vec<Unused>> {
    // Every statement writes, also the first: a transaction that has read cannot write any more on SQLite when somebody
    // else has written since.
    let mut files = Vec::new();
    for OwnedItem { id, .. } in &what.runs {
        forget_attempts(&mut *connection, id).await?;
        for text in ["DELETE FROM run_events WHERE run_id = $1", "DELETE FROM run_stages WHERE run_id = $1"] {
            sqlx::query(text).bind(id).execute(&mut *connection).await?;
        }
        let results = "DELETE FROM results WHERE run_id = $1 RETURNING records, triangle_tests";
        let gone: Vec<(Option<String>, Option<String>)> =
            sqlx::query_as(results).bind(id).fetch_all(&mut *connection).await?;
        files.extend(gone.into_iter().flat_map(|(records, tests)| records.into_iter().chain(tests)));
        let runs = "DELETE FROM runs WHERE id = $1 RETURNING set_blob, spec";
        let gone: Vec<(Option<String>, String)> = sqlx::query_as(runs).bind(id).fetch_all(&mut *connection).await?;
        for (set, spec) in gone {
            files.extend(set.into_iter().chain(named_file(&spec)?));
        }
    }
    for OwnedItem { id, .. } in &what.objects {
        leave_hidden(&mut *connection, id).await?;
        files.extend(column(&mut *connection, "DELETE FROM objects WHERE id = $1 RETURNING blob", id).await?);
    }
    for id in &what.advice {
        forget_attempts(&mut *connection, id).await?;
        for papers in column(&mut *connection, "DELETE FROM advice WHERE id = $1 RETURNING papers", id).await? {
            let papers: [Vec<StoredPaper>; 2] = from_json(&papers)?;
            files.extend(papers.into_iter().flatten().flat_map(|paper| [paper.mesh, paper.certificate]));
        }
    }
    for OwnedItem { id, .. } in &what.configurations {
        files.extend(
            column(&mut *connection, "DELETE FROM saved_configurations WHERE id = $1 RETURNING blob", id).await?,
        );
    }
    for id in &what.stability {
        forget_attempts(&mut *connection, id).await?;
        sqlx::query("DELETE FROM stability_runs WHERE id = $1").bind(id).execute(&mut *connection).await?;
    }
    for id in &what.workloads {
        forget_attempts(&mut *connection, id).await?;
        let text = "DELETE FROM workloads WHERE id = $1 RETURNING blob, queries, reduced";
        let gone: Vec<(String, Option<String>, Option<String>)> =
            sqlx::query_as(text).bind(id).fetch_all(&mut *connection).await?;
        files.extend(
            gone.into_iter().flat_map(|(blob, queries, reduced)| queries.into_iter().chain(reduced).chain([blob])),
        );
    }
    for id in &what.plugins {
        // One that was made public meanwhile stays.
        let text = "UPDATE submissions SET attempts = attempts WHERE id = $1 \
                    AND state NOT IN ('public', 'suspended', 'excluded', 'withdrawn') RETURNING blob";
        let blobs = column(&mut *connection, text, id).await?;
        if blobs.is_empty() {
            continue;
        }
        files.extend(blobs);
        forget_attempts(&mut *connection, id).await?;
        for text in ["DELETE FROM submission_lines WHERE submission = $1", "DELETE FROM submissions WHERE id = $1"] {
            sqlx::query(text).bind(id).execute(&mut *connection).await?;
        }
    }
    files.sort();
    files.dedup();
    let mut unused = Vec::new();
    for sha256 in files {
        if let Some(bytes) = forget(&mut *connection, &sha256).await? {
            unused.push(Unused { sha256, bytes });
        }
    }
    Ok(unused)
}

/// The file of configurations that a run was asked to measure on.
pub(crate) fn named_file(spec: &str) -> Result<Option<String>> {
    let spec: RunSpec = from_json(spec)?;
    Ok(if let Method::File { sha256 } = spec.method { Some(sha256) } else { None })
}

/// What an object hid stays hidden without it: a run with it that more people would see takes over who sees the object.
async fn leave_hidden(connection: &mut AnyConnection, object: &str) -> Result<()> {
    let text = "UPDATE runs SET visibility = (SELECT visibility FROM objects WHERE id = $1) WHERE spec LIKE $2 \
                AND EXISTS (SELECT 1 FROM objects o WHERE o.id = $3 AND (runs.visibility = 'public' AND o.visibility <> 'public' \
                OR runs.visibility = 'unlisted' AND o.visibility = 'private'))";
    let named = format!("%\"{object}\"%");
    sqlx::query(text).bind(object).bind(named).bind(object).execute(connection).await?;
    Ok(())
}

async fn column(connection: &mut AnyConnection, text: &'static str, id: &str) -> Result<Vec<String>> {
    let rows: Vec<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_all(connection).await?;
    Ok(rows.into_iter().flatten().collect())
}

/// Forgets a file that nothing names any more, and gives its size. A set that no run has is made again when it is wanted.
async fn forget(connection: &mut AnyConnection, sha256: &str) -> Result<Option<u64>> {
    sqlx::query("DELETE FROM sets WHERE blob = $1 AND NOT EXISTS (SELECT 1 FROM runs WHERE set_blob = $2)")
        .bind(sha256)
        .bind(sha256)
        .execute(&mut *connection)
        .await?;
    let named = format!("%\"{sha256}\"%");
    let bytes: Option<i64> = sqlx::query_scalar(
        "DELETE FROM blobs WHERE sha256 = $1 \
         AND NOT EXISTS (SELECT 1 FROM objects WHERE blob = $2) \
         AND NOT EXISTS (SELECT 1 FROM sets WHERE blob = $3) \
         AND NOT EXISTS (SELECT 1 FROM runs WHERE set_blob = $4 OR spec LIKE $5) \
         AND NOT EXISTS (SELECT 1 FROM results WHERE records = $6 OR triangle_tests = $7) \
         AND NOT EXISTS (SELECT 1 FROM submissions WHERE blob = $8) \
         AND NOT EXISTS (SELECT 1 FROM saved_configurations WHERE blob = $9) \
         AND NOT EXISTS (SELECT 1 FROM workloads WHERE blob = $11 OR queries = $12 OR reduced = $13) \
         AND NOT EXISTS (SELECT 1 FROM advice WHERE papers LIKE $10) RETURNING bytes",
    )
    .bind(sha256)
    .bind(sha256)
    .bind(sha256)
    .bind(sha256)
    .bind(&named)
    .bind(sha256)
    .bind(sha256)
    .bind(sha256)
    .bind(sha256)
    .bind(&named)
    .bind(sha256)
    .bind(sha256)
    .bind(sha256)
    .fetch_optional(&mut *connection)
    .await?;
    Ok(bytes.map(|bytes| bytes as u64))
}
