//! This process as a worker: its name, and the attempts that it works on.

use std::collections::HashMap;
use std::fs::File;
use std::io::{Read, Seek, Write};
use std::os::unix::fs::MetadataExt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use super::Attempt;
use crate::{EngineError, Result};

/// Who works here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Worker {
    /// The data folder. Only one process can have it open, so when it is opened, all earlier attempts of this name are dead.
    pub machine: String,
    /// The hardware class.
    pub class: String,
}

impl Worker {
    /// The worker of the folder whose lock this process holds.
    pub fn of(lock: &File, class: &str) -> Result<Self> {
        let machine = name_of(lock).map_err(|e| EngineError::fault("Naming the data folder failed", e))?;
        Ok(Self { machine, class: class.to_owned() })
    }
}

/// The name of a data folder: what stands in its lock file, written once, and the number of that file, which a copy of the folder
/// does not have.
fn name_of(mut lock: &File) -> std::io::Result<String> {
    let mut written = Vec::new();
    lock.rewind()?;
    lock.take(64).read_to_end(&mut written)?;
    let mut name = String::from_utf8(written).unwrap_or_default();
    if uuid::Uuid::try_parse(&name).is_err() {
        name = uuid::Uuid::new_v4().to_string();
        lock.set_len(0)?;
        lock.rewind()?;
        lock.write_all(name.as_bytes())?;
        lock.sync_all()?;
    }
    Ok(format!("{name}-{}", lock.metadata()?.ino()))
}

/// Called when an attempt turns out to be lost.
type WhenLost = Box<dyn Fn() + Send>;

/// The attempts that this process works on.
#[derive(Default)]
pub struct Holding {
    held: Mutex<HashMap<String, WhenLost>>,
    /// Rung when the engine shuts down.
    pub closed: Notify,
    /// Rung when one of them may have been ended at another service.
    pub look: Notify,
}

/// Until it is dropped, the lease of this attempt is renewed.
pub struct Held {
    holding: Arc<Holding>,
    attempt: String,
}

impl Drop for Held {
    fn drop(&mut self) {
        self.holding.held().remove(&self.attempt);
    }
}

impl Holding {
    /// Renews the lease of this attempt from now on; `when_lost` stops the work on it.
    pub fn hold(self: &Arc<Self>, attempt: &Attempt, when_lost: impl Fn() + Send + 'static) -> Held {
        self.held().insert(attempt.id.clone(), Box::new(when_lost));
        Held { holding: self.clone(), attempt: attempt.id.clone() }
    }

    /// Ids of all of them.
    pub fn ids(&self) -> Vec<String> {
        self.held().keys().cloned().collect()
    }

    /// Stops the work on one that is not the current attempt any more.
    pub fn stop(&self, attempt: &str) {
        if let Some(when_lost) = self.held().get(attempt) {
            when_lost();
        }
    }

    /// Does this process work on it?
    pub fn has(&self, attempt: &Attempt) -> bool {
        self.held().contains_key(&attempt.id)
    }

    fn held(&self) -> MutexGuard<'_, HashMap<String, WhenLost>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::lock_data_folder;

    #[test]
    fn a_folder_keeps_its_name_and_a_copy_has_another() {
        let [folder, copied] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let name = |folder: &std::path::Path| Worker::of(&lock_data_folder(folder).unwrap(), "c").unwrap().machine;
        let first = name(folder.path());
        assert_eq!(name(folder.path()), first);
        std::fs::copy(folder.path().join("lock"), copied.path().join("lock")).unwrap();
        assert_ne!(name(copied.path()), first);
        // Written halfway before a power failure.
        std::fs::write(folder.path().join("lock"), &first[..9]).unwrap();
        let next = name(folder.path());
        assert_ne!(next, first);
        assert_eq!(name(folder.path()), next);
    }
}
