//! The runs that machines measure now, as far as this process knows them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::Result;
use crate::attempts::LEASE_US;
use crate::runs::log::RunLog;
use crate::runs::preliminary::Shown;

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

/// These runs by attempt.
#[derive(Default)]
pub struct Orders {
    working: Mutex<HashMap<String, Arc<Working>>>,
}

impl Orders {
    /// The run of this attempt. One that is not known here is made: reading its log may take a while and keeps no other waiting.
    pub fn working(
        &self,
        attempt: &str,
        log: impl FnOnce() -> Result<RunLog>,
        show: impl FnOnce() -> Shown,
    ) -> Result<Arc<Working>> {
        let known = self.all().get(attempt).cloned();
        if let Some(working) = known {
            return Ok(working.heard());
        }
        let log = Mutex::new(log()?);
        let mut all = self.all();
        // Of a machine that died nobody says that it has ended.
        all.retain(|_, working| working.shown.is_heard());
        let working = all.entry(attempt.to_owned()).or_insert_with(|| Arc::new(Working { log, shown: show() }));
        Ok(working.clone().heard())
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
