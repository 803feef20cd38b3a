//! The database: one SQL text for SQLite and PostgreSQL.
//!
//! `sqlx::Any` checks nothing at compile time; the contract tests run every function here on both databases instead.
//! The subset that works on both: `$1` placeholders, TEXT, BIGINT, DOUBLE PRECISION, `ON CONFLICT`, `RETURNING`.

#[cfg(test)]
pub(crate) mod tests;

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::any::{AnyConnectOptions, AnyPoolOptions};
use sqlx::migrate::{Migration, MigrationType, Migrator};
use sqlx::{AnyPool, Executor, SqlSafeStr};
use tokio::sync::OnceCell;

use crate::locks::Locks;
use crate::{EngineError, Result};

/// All tables of one data folder.
#[derive(Clone)]
pub struct Store {
    pub(crate) pool: AnyPool,
    /// Begins a transaction whose reads all see the same moment.
    pub(crate) one_moment: &'static str,
    sqlite: bool,
    /// Read once: see [`crate::rate_limits`].
    pub(crate) rate_limit_key: Arc<OnceCell<String>>,
    pub(crate) shares: crate::runs::share::Known,
    pub(crate) counted: crate::runs::share::Counted,
    pub(crate) locks: Locks,
}

impl Store {
    /// Connects and migrates. Without a URL the database is `opencollbench.sqlite` in the data folder.
    pub async fn open(data: &Path, url: Option<&str>) -> Result<Self> {
        let store = Self::connect(data, url).await?;
        store.migrate_to(Self::newest_migration()).await?;
        Ok(store)
    }

    /// Connects, and leaves the tables as they are.
    pub(crate) async fn connect(data: &Path, url: Option<&str>) -> Result<Self> {
        sqlx::any::install_default_drivers();
        let options = match url {
            Some(url) => url.parse::<AnyConnectOptions>()?,
            None => sqlite_url(data)?,
        };
        let sqlite = options.database_url.scheme() == "sqlite";
        if !sqlite && cfg!(not(feature = "postgres")) {
            return Err(EngineError::left_out("PostgreSQL"));
        }
        let locks = Locks::new((!sqlite).then(|| options.clone()));
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
        // SQLite's transactions see one moment anyway, PostgreSQL's have to ask for it.
        let one_moment = if sqlite { "BEGIN" } else { "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY" };
        let (shares, counted) = Default::default();
        Ok(Self { pool, one_moment, sqlite, rate_limit_key: Arc::default(), shares, counted, locks })
    }

    /// Makes the tables what they are after this migration.
    pub(crate) async fn migrate_to(&self, migration: i64) -> Result<()> {
        let wanted = migrations(self.sqlite).into_iter().filter(|one| one.version <= migration).collect();
        let migrator = Migrator::with_migrations(wanted);
        migrator.run(&self.pool).await.map_err(|e| EngineError::fault("Migrating the database failed", e))
    }

    /// The newest migration that this program knows.
    pub(crate) fn newest_migration() -> i64 {
        migrations(true).last().map_or(0, |one| one.version)
    }

    /// The newest migration of the tables that are there; none when there are no tables.
    pub(crate) async fn migration(&self) -> Result<Option<i64>> {
        let newest = sqlx::query_scalar("SELECT MAX(version) FROM _sqlx_migrations").fetch_one(&self.pool).await;
        match newest {
            Ok(newest) => Ok(newest),
            Err(sqlx::Error::Database(_)) => Ok(None),
            Err(e) => Err(e.into()),
        }
    }

    /// May other services be on this database?
    pub fn is_shared(&self) -> bool {
        !self.sqlite
    }

    /// Closes all connections; what was written is on disk.
    pub async fn close(&self) {
        self.locks.close().await;
        self.pool.close().await;
    }
}

const ATTEMPTS_ON_SQLITE: &str = concat!(
    include_str!("../migrations/0032_attempts.sql"),
    "CREATE VIEW database_clock AS SELECT CAST((julianday('now') - 2440587.5) * 86400000000.0 AS BIGINT) AS now_us;"
);
const ATTEMPTS_ON_POSTGRES: &str = concat!(
    include_str!("../migrations/0032_attempts.sql"),
    "CREATE VIEW database_clock AS SELECT CAST(EXTRACT(EPOCH FROM clock_timestamp()) * 1000000 AS BIGINT) AS now_us;"
);

/// The SQL files, compiled in. Only what time it is each database says in its own words.
fn migrations(sqlite: bool) -> Vec<Migration> {
    let one = |version, name: &'static str, text: &'static str| {
        Migration::new(version, name.into(), MigrationType::Simple, text.into_sql_str(), false)
    };
    vec![
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
        one(31, "event numbers", include_str!("../migrations/0031_event_numbers.sql")),
        one(32, "attempts", if sqlite { ATTEMPTS_ON_SQLITE } else { ATTEMPTS_ON_POSTGRES }),
        one(33, "notify", if sqlite { "" } else { include_str!("../migrations/0033_notify.sql") }),
        one(37, "house", if sqlite { "" } else { include_str!("../migrations/0037_house.sql") }),
        one(38, "advice turn", include_str!("../migrations/0038_advice_turn.sql")),
        one(39, "workloads", include_str!("../migrations/0039_workloads.sql")),
        one(40, "machines", include_str!("../migrations/0040_machines.sql")),
        one(41, "sentinels", include_str!("../migrations/0041_sentinels.sql")),
        one(42, "rate limits", include_str!("../migrations/0042_rate_limits.sql")),
        one(43, "run classes", include_str!("../migrations/0043_run_classes.sql")),
        one(44, "reduced scenes", include_str!("../migrations/0044_reduced_scenes.sql")),
        one(45, "seen", if sqlite { "" } else { include_str!("../migrations/0045_seen.sql") }),
        one(46, "attempts of machines", include_str!("../migrations/0046_attempts_of_machines.sql")),
        one(47, "looking", include_str!("../migrations/0047_looking.sql")),
    ]
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
