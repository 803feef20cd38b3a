//! Work for threads of its own.

use crate::{EngineError, Result};

/// Work that would block the runtime's threads.
pub async fn blocking<T: Send + 'static>(work: impl FnOnce() -> Result<T> + Send + 'static) -> Result<T> {
    tokio::task::spawn_blocking(work).await.map_err(|e| EngineError::fault("A worker thread ended", e))?
}
