//! Two services on one PostgreSQL and one S3 bucket work as one.

mod keeper;
mod one_service;

use std::time::{Duration, Instant};

use sqlx::AnyPool;
use tempfile::TempDir;

use crate::EngineConfig;
use crate::blobs::tests::from_harness;
use crate::engine::Engine;
use crate::mail::MailServer;
use crate::model::{AccountInfo, AlgorithmInfo, PluginState, Role};
use crate::plugins::sql::PluginRow;
use crate::store::tests::people::{NOTE, account};
use crate::store::tests::plugins::plugin;
use crate::store::tests::postgres_url;

/// Two services, and the database to look into and to disturb.
struct Pair {
    first: Engine,
    second: Engine,
    database: AnyPool,
    /// What PostgreSQL knows the connections of these services by.
    name: String,
    _folders: [TempDir; 2],
}

impl Pair {
    /// Services that work on nothing.
    async fn open() -> Self {
        Self::open_with(false, None).await
    }

    async fn open_with(dispatch: bool, mail: Option<MailServer>) -> Self {
        let name = format!("ocb-test-{}", uuid::Uuid::new_v4().simple());
        let plain = postgres_url("").await;
        let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let open = async |folder: &TempDir| {
            Engine::open(EngineConfig {
                database_url: Some(format!("{plain}&application_name={name}")),
                blob_url: Some(from_harness("OCB_TEST_S3")),
                plugins: Vec::new(),
                dispatch,
                mail: mail.clone(),
                ..EngineConfig::beside_executable(folder.path())
            })
            .await
            .unwrap()
        };
        let (first, second) = (open(&folders[0]).await, open(&folders[1]).await);
        Self { first, second, database: AnyPool::connect(&plain).await.unwrap(), name, _folders: folders }
    }

    /// Ends the connections that this condition on `pg_stat_activity` finds.
    async fn terminate(&self, which: &'static str, name: &str) {
        let text =
            format!("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = $1 {which}");
        sqlx::query(sqlx::AssertSqlSafe(text)).bind(name).execute(&self.database).await.unwrap();
    }

    /// A developer and a curator, and a plugin of the developer in this state with an algorithm that answers everything.
    async fn plugin(&self, id: &str, algorithm: &str, state: PluginState) -> AccountInfo {
        let inner = &self.first.inner;
        let author = AccountInfo { role: Role::Developer, ..account(&format!("author of {id}"), &format!("a-{id}")) };
        let curator = AccountInfo { role: Role::Curator, ..account(&format!("curator of {id}"), &format!("c-{id}")) };
        for person in [&author, &curator] {
            assert!(inner.store.add_account(person, "hash").await.unwrap());
        }
        let bytes = format!("the plugin {id} of {}", self.name).into_bytes();
        let length = bytes.len();
        let blob = inner.blobs.put(bytes).await.unwrap();
        inner.store.add_blob(&blob, length, "x").await.unwrap();
        let algorithms = vec![described(algorithm, &blob)];
        let row = PluginRow { state, algorithms, ..plugin(id, &author.id, &blob) };
        assert!(inner.store.add_plugin(&row, NOTE).await.unwrap());
        curator
    }

    async fn close(self) {
        self.first.shutdown().await;
        self.second.shutdown().await;
        self.database.close().await;
    }
}

fn described(id: &str, file: &str) -> AlgorithmInfo {
    serde_json::from_value(serde_json::json!({
        "id": id, "name": id, "version": "1", "authors": "a", "license": "MIT", "url": "", "paper": "",
        "queries": ["collision_first", "proximity"], "counters": false, "witness_points": false, "single_precision": false,
        "solid": false, "coherent": false, "threads": false, "usual": true, "parameters": [], "plugin_sha256": file,
    }))
    .unwrap()
}

/// Waits for a state, generously.
async fn until(what: &str, there: impl AsyncFn() -> bool) {
    let begun = Instant::now();
    while !there().await {
        assert!(begun.elapsed() < Duration::from_secs(60), "{what}");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

fn offers(engine: &Engine, algorithm: &str) -> bool {
    engine.inner.registry.algorithms(None).iter().any(|known| known.id == algorithm)
}
