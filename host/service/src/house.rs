//! The housekeeper: the one service on a database that does the work which is done once for all of them. It sends mails, deletes
//! what has expired, completes campaigns, plans the suite and idle work, and takes back the attempts of lost workers.
//!
//! With PostgreSQL it holds an advisory lock on a connection of its own, which it uses every second. The lock ends with the
//! connection: at once when the service ends or the connection is terminated, and soon when its machine is gone or its process
//! stands still, because PostgreSQL then ends the idle session. The others try every second to get it. With SQLite one process
//! has the file, and is the housekeeper.
//!
//! A service notices within a second that it lost the lock, and until then two may believe that they have it. So the lock saves
//! work, and correctness does not depend on it: each of these tasks also takes what it works on in the database.

mod keeping;
#[cfg(test)]
mod tests;

use std::time::Duration;

use sqlx::{AnyConnection, Connection};
use tokio::sync::{Mutex, watch};

use crate::attempts::worker::Worker;
use crate::locks::{HOUSE, Locks};
use crate::{EngineError, Result};

/// A connection that does not answer for so long is given up, before PostgreSQL may give the lock to another.
const PATIENCE: Duration = Duration::from_secs(4);
/// PostgreSQL gives up a session that asks nothing for so long.
const SESSION: &str =
    "SELECT set_config('idle_session_timeout', '10s', false), set_config('application_name', $1, false)";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keeper {
    Another,
    Here,
    /// The engine shuts down.
    Closing,
}

/// Who keeps house.
pub struct House {
    keeper: watch::Sender<Keeper>,
    door: Mutex<Option<Door>>,
}

impl Default for House {
    fn default() -> Self {
        Self { keeper: watch::Sender::new(Keeper::Another), door: Mutex::default() }
    }
}

impl House {
    /// Does this service keep house?
    pub fn is_here(&self) -> bool {
        *self.keeper.borrow() == Keeper::Here
    }

    /// Waits until this service keeps house; false when the engine shuts down first.
    pub async fn here(&self) -> bool {
        self.until(|keeper| keeper != Keeper::Another).await == Keeper::Here
    }

    /// Waits until it does not any more.
    pub async fn gone(&self) {
        self.until(|keeper| keeper != Keeper::Here).await;
    }

    /// Waits until the engine shuts down.
    pub async fn closing(&self) {
        self.until(|keeper| keeper == Keeper::Closing).await;
    }

    /// The engine shuts down.
    pub fn close(&self) {
        self.keeper.send_replace(Keeper::Closing);
    }

    /// Confirms the lock, or tries to get it: is it held?
    pub async fn look(&self, locks: &Locks, worker: &Worker) -> Result<bool> {
        let mut door = self.door.lock().await;
        let looked = tokio::time::timeout(PATIENCE, async {
            // Whatever goes wrong, the connection is not used again.
            let mut here = match door.take() {
                Some(here) => here,
                None => match locks.session().await? {
                    Some(session) => Door::of(session, worker).await?,
                    None => return Ok(true),
                },
            };
            let held = here.look().await?;
            *door = Some(here);
            Ok(held)
        });
        looked.await.unwrap_or_else(|_| Err(EngineError::Fault("The database does not answer.".into())))
    }

    /// Leaves it to another; when nothing is done here any more.
    pub async fn leave(&self) {
        if let Some(door) = self.door.lock().await.take() {
            let _ = door.session.close().await;
        }
    }

    async fn until(&self, there: impl Fn(Keeper) -> bool) -> Keeper {
        let found = self.keeper.subscribe().wait_for(|keeper| there(*keeper)).await.map(|keeper| *keeper);
        found.unwrap_or(Keeper::Closing)
    }

    /// Notes whether the lock is held; true when this service keeps house from now on.
    pub fn note(&self, here: bool) -> bool {
        let now = if here { Keeper::Here } else { Keeper::Another };
        let changed = self.keeper.send_if_modified(|keeper| {
            let changed = !matches!(*keeper, Keeper::Closing) && *keeper != now;
            if changed {
                *keeper = now;
            }
            changed
        });
        changed && here
    }
}

/// The connection on which the lock is held, or tried.
struct Door {
    session: AnyConnection,
    held: bool,
}

impl Door {
    async fn of(mut session: AnyConnection, worker: &Worker) -> Result<Self> {
        // So that operators see in pg_stat_activity who it is.
        let name = format!("ocb {}", worker.machine);
        sqlx::query(SESSION).bind(name).execute(&mut session).await?;
        Ok(Self { session, held: false })
    }

    /// Is the lock held?
    async fn look(&mut self) -> Result<bool> {
        if self.held {
            sqlx::query("SELECT 1").execute(&mut self.session).await?;
        } else {
            let take = "SELECT pg_try_advisory_lock($1, hashtext(current_schema()))";
            self.held = sqlx::query_scalar(take).bind(HOUSE).fetch_one(&mut self.session).await?;
        }
        Ok(self.held)
    }
}
