//! A turn in the queue, and the turns as they were counted last.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::Mutex;

/// The turns at one priority as they were a moment ago, if they were many.
pub type Known = Arc<Mutex<Option<(Instant, i64, Arc<Vec<Turn>>)>>>;

/// Who waits for a turn.
#[derive(Clone, Debug)]
pub struct Turn {
    pub turn: String,
    /// So many runs.
    pub waiting: i64,
    pub since: Since,
}

/// The turn with the smallest is next: when it was served last, then what it waits with.
pub type Since = (i64, i64, String);
