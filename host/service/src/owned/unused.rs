//! Which stored files would be left without a user; nothing is written.

use std::collections::{BTreeSet, HashSet};

use crate::Result;
use crate::advice::sql::StoredPaper;
use crate::owned::sql::{OwnedIds, Unused, named_file};
use crate::store::{Store, from_json};

/// Plugins that stay whatever goes.
const GOING_PLUGIN: &str = "SELECT blob FROM submissions WHERE id = $1 \
                            AND state NOT IN ('public', 'suspended', 'excluded', 'withdrawn')";

impl Store {
    /// The files that nobody would use any more without these.
    pub async fn unused_without(&self, what: &OwnedIds) -> Result<Vec<Unused>> {
        let mut going: HashSet<&str> = what.advice.iter().map(String::as_str).collect();
        going.extend(what.runs.iter().chain(&what.objects).chain(&what.configurations).map(|thing| thing.id.as_str()));
        let mut files = BTreeSet::new();
        for thing in &what.runs {
            files.extend(self.texts("SELECT records FROM results WHERE run_id = $1", &thing.id).await?);
            files.extend(self.texts("SELECT triangle_tests FROM results WHERE run_id = $1", &thing.id).await?);
            files.extend(self.texts("SELECT set_blob FROM runs WHERE id = $1", &thing.id).await?);
            for spec in self.texts("SELECT spec FROM runs WHERE id = $1", &thing.id).await? {
                files.extend(named_file(&spec)?);
            }
        }
        for thing in &what.objects {
            files.extend(self.texts("SELECT blob FROM objects WHERE id = $1", &thing.id).await?);
        }
        for saved in &what.configurations {
            files.extend(self.texts("SELECT blob FROM saved_configurations WHERE id = $1", &saved.id).await?);
        }
        for id in &what.advice {
            for papers in self.texts("SELECT papers FROM advice WHERE id = $1", id).await? {
                let papers: [Vec<StoredPaper>; 2] = from_json(&papers)?;
                files.extend(papers.into_iter().flatten().flat_map(|paper| [paper.mesh, paper.certificate]));
            }
        }
        for id in &what.plugins {
            let blobs = self.texts(GOING_PLUGIN, id).await?;
            if !blobs.is_empty() {
                going.insert(id);
            }
            files.extend(blobs);
        }
        for id in &what.workloads {
            going.insert(id);
            files.extend(self.texts("SELECT blob FROM workloads WHERE id = $1", id).await?);
            files.extend(self.texts("SELECT queries FROM workloads WHERE id = $1", id).await?);
            files.extend(self.texts("SELECT reduced FROM workloads WHERE id = $1 AND reduced IS NOT NULL", id).await?);
        }
        let mut unused = Vec::new();
        for sha256 in files {
            if self.users_of(&sha256).await?.iter().all(|id| going.contains(id.as_str())) {
                let bytes: Option<i64> = sqlx::query_scalar("SELECT bytes FROM blobs WHERE sha256 = $1")
                    .bind(&sha256)
                    .fetch_optional(&self.pool)
                    .await?;
                unused.extend(bytes.map(|bytes| Unused { sha256, bytes: bytes as u64 }));
            }
        }
        Ok(unused)
    }

    /// Ids of the runs, objects, saved configurations, advice, workloads and plugins that use this file.
    async fn users_of(&self, sha256: &str) -> Result<Vec<String>> {
        let named = format!("%\"{sha256}\"%");
        let users = "SELECT id FROM objects WHERE blob = $1 \
                     UNION SELECT id FROM runs WHERE set_blob = $2 OR spec LIKE $3 \
                     UNION SELECT run_id FROM results WHERE records = $4 OR triangle_tests = $5 \
                     UNION SELECT id FROM submissions WHERE blob = $6 \
                     UNION SELECT id FROM saved_configurations WHERE blob = $7 \
                     UNION SELECT id FROM advice WHERE papers LIKE $8 \
                     UNION SELECT id FROM workloads WHERE blob = $9 OR queries = $10 OR reduced = $11";
        let query = sqlx::query_scalar(users).bind(sha256).bind(sha256).bind(&named);
        let query = query.bind(sha256).bind(sha256).bind(sha256).bind(sha256);
        Ok(query.bind(&named).bind(sha256).bind(sha256).bind(sha256).fetch_all(&self.pool).await?)
    }

    async fn texts(&self, text: &'static str, id: &str) -> Result<Vec<String>> {
        let rows: Vec<Option<String>> = sqlx::query_scalar(text).bind(id).fetch_all(&self.pool).await?;
        Ok(rows.into_iter().flatten().collect())
    }
}
