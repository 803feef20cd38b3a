//! The database: one SQL text for SQLite and PostgreSQL.
//!
//! `sqlx::Any` checks nothing at compile time; the contract tests run every function here on both databases instead.
//! The subset that works on both: `$1` placeholders, TEXT, BIGINT, DOUBLE PRECISION, `ON CONFLICT`, `RETURNING`.

#[cfg(test)]
pub(crate) mod tests;

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::any::{AnyConnectOptions, AnyPoolOptions};
use sqlx::migrate::{Migration, MigrationType, Migrator};
use sqlx::{AnyPool, Executor, SqlSafeStr};

use crate::{EngineError, Result};

/// All tables of one data folder.
#[derive(Clone)]
pub struct Store {
    pub(crate) pool: AnyPool,
    /// Begins a transaction whose reads all see the same moment.
    pub(crate) one_moment: &'static str,
    pub(crate) turns: crate::runs::turn::Known,
}

impl Store {
    /// Connects and migrates. Without a URL the database is `opencollbench.sqlite` in the data folder.
    pub async fn open(data: &Path, url: Option<&str>) -> Result<Self> {
        sqlx::any::install_default_drivers();
        let options = match url {
            Some(url) => url.parse::<AnyConnectOptions>()?,
            None => sqlite_url(data)?,
        };
        let sqlite = options.database_url.scheme() == "sqlite";
        if !sqlite && cfg!(not(feature = "postgres")) {
            return Err(EngineError::left_out("PostgreSQL"));
        }
        let pool = AnyPoolOptions::new()
            // One process owns the file and SQLite has one writer anyway; more connections only wait for each other.
            .max_connections(if sqlite { 4 } else { 8 })
            .after_connect(move |connection, _| {
                Box::pin(async move {
                    if sqlite {
                        // Write-ahead logging survives SIGKILL at any point; FULL syncs with every commit.
                        connection
                            .execute(
                                "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; \
                                 PRAGMA foreign_keys = ON; PRAGMA busy_timeout = 10000",
                            )
                            .await?;
                    }
                    Ok(())
                })
            })
            .connect_with(options)
            .await
            .map_err(|e| EngineError::fault("Opening the database failed", e))?;
        migrations().run(&pool).await.map_err(|e| EngineError::fault("Migrating the database failed", e))?;
        // SQLite's transactions see one moment anyway, PostgreSQL's have to ask for it.
        let one_moment = if sqlite { "BEGIN" } else { "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY" };
        Ok(Self { pool, one_moment, turns: crate::runs::turn::Known::default() })
    }

    /// Closes all connections; what was written is on disk.
    pub async fn close(&self) {
        self.pool.close().await;
    }
}

/// The SQL files, compiled in.
fn migrations() -> Migrator {
    let one = |version, name: &'static str, text: &'static str| {
        Migration::new(version, name.into(), MigrationType::Simple, text.into_sql_str(), false)
    };
    Migrator::with_migrations(vec![
        one(1, "first", include_str!("../migrations/0001_first.sql")),
        one(2, "secret", include_str!("../migrations/0002_secret.sql")),
        one(3, "people", include_str!("../migrations/0003_people.sql")),
        one(4, "plugins", include_str!("../migrations/0004_plugins.sql")),
        one(5, "stability", include_str!("../migrations/0005_stability.sql")),
        one(6, "advice", include_str!("../migrations/0006_advice.sql")),
        one(7, "previews", include_str!("../migrations/0007_previews.sql")),
        one(8, "signatures", include_str!("../migrations/0008_signatures.sql")),
        one(9, "request keys", include_str!("../migrations/0009_request_keys.sql")),
        one(10, "visibility", include_str!("../migrations/0010_visibility.sql")),
        one(11, "retention", include_str!("../migrations/0011_retention.sql")),
        one(12, "suite", include_str!("../migrations/0012_suite.sql")),
        one(13, "invitations", include_str!("../migrations/0013_invitations.sql")),
        one(14, "requests", include_str!("../migrations/0014_requests.sql")),
        one(15, "notices", include_str!("../migrations/0015_notices.sql")),
        one(16, "campaigns", include_str!("../migrations/0016_campaigns.sql")),
        one(17, "plugin lists", include_str!("../migrations/0017_plugin_lists.sql")),
        one(18, "off links", include_str!("../migrations/0018_off_links.sql")),
        one(19, "farewells", include_str!("../migrations/0019_farewells.sql")),
        one(20, "check turns", include_str!("../migrations/0020_check_turns.sql")),
        one(21, "turns", include_str!("../migrations/0021_turns.sql")),
        one(22, "grants", include_str!("../migrations/0022_grants.sql")),
        one(23, "devices", include_str!("../migrations/0023_devices.sql")),
        one(24, "waiting", include_str!("../migrations/0024_waiting.sql")),
        one(25, "triangle_tests", include_str!("../migrations/0025_triangle_tests.sql")),
        one(26, "saved configurations", include_str!("../migrations/0026_saved_configurations.sql")),
        one(27, "stability runs", include_str!("../migrations/0027_stability_runs.sql")),
        one(29, "idle", include_str!("../migrations/0029_idle.sql")),
    ])
}

/// Any path works as SQLite URL when its bytes are percent-encoded.
fn sqlite_url(data: &Path) -> Result<AnyConnectOptions> {
    let file = std::path::absolute(data.join("opencollbench.sqlite"))
        .map_err(|e| EngineError::fault("Resolving the data folder failed", e))?;
    let mut url = String::from("sqlite://");
    for byte in file.to_string_lossy().bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' => url.push(byte as char),
            _ => url.push_str(&format!("%{byte:02X}")),
        }
    }
    url.push_str("?mode=rwc");
    url.parse().map_err(|e| EngineError::fault("Naming the database failed", e))
}

pub use ocb_lab::now_us;

/// To a JSON column.
pub fn to_json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string(value).map_err(|e| EngineError::fault("Writing a JSON column failed", e))
}

/// From a JSON column. Rows are written by this program only; a row that does not parse is damage, not input.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T> {
    serde_json::from_str(text).map_err(|e| EngineError::fault("Reading a JSON column failed", e))
}
