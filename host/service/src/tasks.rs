//! What runs in the background until the engine closes.

use std::sync::{Mutex, PoisonError};

use tokio::task::{AbortHandle, JoinHandle};

/// The tasks of one engine.
#[derive(Default)]
pub struct Tasks {
    /// What closing waits for.
    awaited: Mutex<Vec<JoinHandle<()>>>,
    /// What closing breaks off.
    listening: Mutex<Option<AbortHandle>>,
}

impl Tasks {
    /// Work that closing waits for.
    pub fn spawn(&self, work: impl Future<Output = ()> + Send + 'static) {
        let mut tasks = self.awaited.lock().unwrap_or_else(PoisonError::into_inner);
        tasks.retain(|task| !task.is_finished());
        tasks.push(tokio::spawn(work));
    }

    /// Hears of other services on the same database; closing breaks it off.
    #[cfg(feature = "postgres")]
    pub fn listen(&self, listening: impl Future<Output = ()> + Send + 'static) {
        let task = tokio::spawn(listening);
        *self.listening.lock().unwrap_or_else(PoisonError::into_inner) = Some(task.abort_handle());
    }

    /// Breaks off listening, and waits for the end of all others.
    pub async fn ended(&self) {
        if let Some(task) = self.listening.lock().unwrap_or_else(PoisonError::into_inner).take() {
            task.abort();
        }
        let tasks = std::mem::take(&mut *self.awaited.lock().unwrap_or_else(PoisonError::into_inner));
        for task in tasks {
            let _ = task.await;
        }
    }
}
