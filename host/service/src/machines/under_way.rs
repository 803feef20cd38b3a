//! The runs that machines measure now, as far as this process knows them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::runtime::Handle;

use crate::attempts::{Attempt, LEASE_US};
use crate::objects::Objects;
use crate::runs::live::LiveRuns;
use crate::runs::log::RunLog;
use crate::runs::preliminary::Shown;
use crate::runs::sql::RunRow;
use crate::suite::Suite;
use crate::{Ceilings, Result};

const LEASE: Duration = Duration::from_micros(LEASE_US as u64);

/// A run that a machine measures.
pub struct Working {
    /// Used by one request at a time.
    pub log: Mutex<RunLog>,
    shown: Shown,
}

impl Working {
    /// Its machine was heard from just now.
    fn heard(self: Arc<Self>) -> Arc<Self> {
        self.shown.heard(LEASE);
        self
    }
}

/// The runs that machines measure for this service.
pub struct Orders {
    pub(super) live: Arc<LiveRuns>,
    pub(super) objects: Arc<Objects>,
    pub(super) suite: Arc<Suite>,
    pub(super) ceilings: Ceilings,
    /// By attempt.
    working: Mutex<HashMap<String, Arc<Working>>>,
}

impl Orders {
    /// None is known yet.
    pub fn new(live: Arc<LiveRuns>, objects: Arc<Objects>, suite: Arc<Suite>, ceilings: Ceilings) -> Self {
        Self { live, objects, suite, ceilings, working: Mutex::default() }
    }

    /// A machine begins this attempt at a prepared run; blocks.
    pub fn begin(&self, attempt: &Attempt, row: &RunRow) -> Result<()> {
        let log = || RunLog::go_on(attempt, &row.spec.algorithms, &self.live, Handle::current());
        self.known(attempt, row, log).map(|_| ())
    }

    /// The run of an attempt that has begun, and was heard from just now; blocks.
    pub fn working(&self, attempt: &Attempt, row: &RunRow) -> Result<Arc<Working>> {
        self.known(attempt, row, || RunLog::resume(attempt, &self.live, Handle::current()))
    }

    /// One that is not known here is made: reading its log may take a while and keeps no other waiting.
    fn known(&self, attempt: &Attempt, row: &RunRow, log: impl FnOnce() -> Result<RunLog>) -> Result<Arc<Working>> {
        let known = self.all().get(&attempt.id).cloned();
        if let Some(working) = known {
            return Ok(working.heard());
        }
        let log = Mutex::new(log()?);
        let mut all = self.all();
        // Of a machine that died nobody says that it has ended.
        all.retain(|_, working| working.shown.is_heard());
        let show = || Arc::new(Working { log, shown: self.live.show(row) });
        Ok(all.entry(attempt.id.clone()).or_insert_with(show).clone().heard())
    }

    /// The machine of this attempt was heard from just now; false when the attempt is not known here.
    pub fn heard(&self, attempt: &str) -> bool {
        self.all().get(attempt).cloned().map(Working::heard).is_some()
    }

    /// The attempt has ended.
    pub fn forget(&self, attempt: &str) {
        self.all().remove(attempt);
    }

    fn all(&self) -> MutexGuard<'_, HashMap<String, Arc<Working>>> {
        self.working.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
