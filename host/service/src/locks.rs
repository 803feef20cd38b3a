//! Locks that hold in all services on one database.
//!
//! With PostgreSQL they are advisory locks, each held by a transaction on a connection of its own; it ends with its guard, its
//! process or its connection. These connections are in a pool of their own, so that those who wait for a lock take no connection
//! from the one who has it. Within a process a mutex comes first, so that a lock takes one connection at most. With SQLite the
//! mutex is all: one process has the file.

use std::fmt;
use std::sync::{Arc, PoisonError, Weak};
use std::time::{Duration, Instant};

use sqlx::any::{AnyConnectOptions, AnyPoolOptions};
use sqlx::{Any, AnyConnection, AnyPool, Executor, Transaction};
use tokio::runtime::Handle;
use tokio::sync::{Mutex, OwnedMutexGuard, OwnedRwLockReadGuard, OwnedRwLockWriteGuard, RwLock};

use crate::Result;

/// Work that only one service does at a time.
#[derive(Clone, Copy, Debug)]
pub enum Lock {
    /// Finding out what is missing of the suite, of a campaign or for an idle service, until that is in the queue.
    Planning,
    /// Publishing a plugin: its ids must still be free then.
    Publishing,
    /// Admitting a run, a stability run or advice: its quota must still be free then.
    Admission,
    /// Ending a campaign and telling those whose runs were repeated.
    Campaigns,
}

const LOCKS: usize = Lock::Campaigns as usize + 1;
/// The first half of the numbers of our advisory locks, which is not zero because other programs may use small ones. The second is
/// the schema, so that services in two schemas do not wait for each other.
const OURS: i32 = 0x6f63_6200;
const FILES: i32 = OURS + LOCKS as i32;
/// The lock of the housekeeper.
pub const HOUSE: i32 = FILES + 1;

/// Enough for every lock, and for those who keep files while others wait to remove some.
const MOST_CONNECTIONS: u32 = 16;
/// What is stored joins those who keep files since at most so long: then whoever waits to remove some has its turn.
pub(crate) const JOINED: Duration = Duration::from_secs(1);

/// A machine that is gone loses its locks after about half a minute; a process that stands still, after ten minutes.
const ON_POSTGRES: &str = "SET tcp_keepalives_idle = 10; SET tcp_keepalives_interval = 5; SET tcp_keepalives_count = 3; \
                           SET idle_in_transaction_session_timeout = '10min'";
const TAKE: &str = "SELECT pg_advisory_xact_lock($1, hashtext(current_schema()))";
const TAKE_SHARED: &str = "SELECT pg_advisory_xact_lock_shared($1, hashtext(current_schema()))";
const TRY: &str = "SELECT pg_try_advisory_xact_lock($1, hashtext(current_schema()))";

/// All of them.
#[derive(Clone)]
pub struct Locks(Arc<All>);

struct All {
    /// None for SQLite.
    database: Option<AnyPool>,
    alone: [Arc<Mutex<()>>; LOCKS],
    files: Arc<RwLock<()>>,
    /// What those have joined who keep files here.
    keeping: Mutex<Weak<Held>>,
}

/// Until it is dropped, the lock is held.
pub struct Guard<T> {
    _database: Option<Arc<Held>>,
    _here: T,
}

impl<T> fmt::Debug for Guard<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Guard").finish_non_exhaustive()
    }
}

/// The lock of one who is alone.
pub type Alone = Guard<OwnedMutexGuard<()>>;
/// Held by those who store files.
pub type Keeping = Guard<OwnedRwLockReadGuard<()>>;
/// Held by one who removes files.
pub type Removing = Guard<OwnedRwLockWriteGuard<()>>;

impl Locks {
    /// Those of one process, or of all on this PostgreSQL.
    pub fn new(postgres: Option<AnyConnectOptions>) -> Self {
        let database = postgres.map(|options| {
            let pool = AnyPoolOptions::new().max_connections(MOST_CONNECTIONS);
            let pool =
                pool.after_connect(|connection, _| Box::pin(async { connection.execute(ON_POSTGRES).await.map(drop) }));
            pool.connect_lazy_with(options)
        });
        Self(Arc::new(All { database, alone: Default::default(), files: Arc::default(), keeping: Mutex::default() }))
    }

    /// Waits until no other has this lock.
    pub async fn alone(&self, lock: Lock) -> Result<Alone> {
        let here = self.0.alone[lock as usize].clone().lock_owned().await;
        Ok(Guard { _database: self.held(OURS + lock as i32, TAKE).await?.map(Arc::new), _here: here })
    }

    /// Nothing when another has this lock.
    pub async fn try_alone(&self, lock: Lock) -> Result<Option<Alone>> {
        let Ok(here) = self.0.alone[lock as usize].clone().try_lock_owned() else { return Ok(None) };
        let mut database = None;
        if let Some(pool) = &self.0.database {
            let mut transaction = pool.begin().await?;
            let query = sqlx::query_scalar(TRY).bind(OURS + lock as i32);
            if !query.fetch_one(&mut *transaction).await? {
                return Ok(None);
            }
            database = Some(Arc::new(Held::by(transaction)));
        }
        Ok(Some(Guard { _database: database, _here: here }))
    }

    /// To be held from storing a file until a row names it.
    pub async fn keeping(&self) -> Result<Keeping> {
        let here = self.0.files.clone().read_owned().await;
        let mut keeping = self.0.keeping.lock().await;
        let mut database = keeping.upgrade().filter(|held| held.since.elapsed() < JOINED);
        if database.is_none() {
            database = self.held(FILES, TAKE_SHARED).await?.map(Arc::new);
            *keeping = database.as_ref().map_or_else(Weak::new, Arc::downgrade);
        }
        Ok(Guard { _database: database, _here: here })
    }

    /// To be held while files are removed that no row names.
    pub async fn removing(&self) -> Result<Removing> {
        let here = self.0.files.clone().write_owned().await;
        Ok(Guard { _database: self.held(FILES, TAKE).await?.map(Arc::new), _here: here })
    }

    /// Other services may have them, too.
    pub fn are_shared(&self) -> bool {
        self.0.database.is_some()
    }

    /// A connection of one's own; none for SQLite.
    pub async fn session(&self) -> Result<Option<AnyConnection>> {
        let Some(pool) = &self.0.database else { return Ok(None) };
        Ok(Some(pool.acquire().await?.detach()))
    }

    /// Closes all connections.
    pub async fn close(&self) {
        if let Some(pool) = &self.0.database {
            pool.close().await;
        }
    }

    async fn held(&self, lock: i32, take: &'static str) -> Result<Option<Held>> {
        let Some(pool) = &self.0.database else { return Ok(None) };
        let mut transaction = pool.begin().await?;
        sqlx::query(take).bind(lock).execute(&mut *transaction).await?;
        Ok(Some(Held::by(transaction)))
    }
}

/// A lock in PostgreSQL.
struct Held {
    /// In a mutex, because several threads may hold the same lock.
    transaction: std::sync::Mutex<Option<Transaction<'static, Any>>>,
    since: Instant,
    runtime: Handle,
}

impl Held {
    fn by(transaction: Transaction<'static, Any>) -> Self {
        Self { transaction: Some(transaction).into(), since: Instant::now(), runtime: Handle::current() }
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        // A task brings the connection back to its pool, and runs keep files on threads outside of the runtime.
        let _runtime = self.runtime.enter();
        drop(self.transaction.get_mut().unwrap_or_else(PoisonError::into_inner).take());
    }
}
