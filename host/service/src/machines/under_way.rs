//! The runs that machines measure now, as far as this process knows them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use crate::Result;
use crate::runs::log::RunLog;

/// The logs of these runs by attempt, each used by one request at a time.
#[derive(Default)]
pub struct Orders {
    logs: Mutex<HashMap<String, Arc<Mutex<RunLog>>>>,
    /// Rung when a run was prepared.
    pub prepared: Notify,
}

impl Orders {
    /// The log of this attempt; one that is not known here is made, which may take a while and keeps no other waiting.
    pub fn log(&self, attempt: &str, make: impl FnOnce() -> Result<RunLog>) -> Result<Arc<Mutex<RunLog>>> {
        let known = self.logs().get(attempt).cloned();
        if let Some(log) = known {
            return Ok(log);
        }
        let log = Arc::new(Mutex::new(make()?));
        Ok(self.logs().entry(attempt.to_owned()).or_insert(log).clone())
    }

    /// The attempt has ended.
    pub fn forget(&self, attempt: &str) {
        self.logs().remove(attempt);
    }

    fn logs(&self) -> MutexGuard<'_, HashMap<String, Arc<Mutex<RunLog>>>> {
        self.logs.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
