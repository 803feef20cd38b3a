//! A share of the queue: what one participant, an account or all guests of one address, has waiting.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::Mutex;

/// The shares at one priority of one hardware class as they were a moment ago, if they were many.
pub type Known = Arc<Mutex<Option<(Instant, (i64, OfClass), Arc<Vec<QueueShare>>)>>>;

/// What waited a moment ago, if it was much.
pub type Counted = Arc<Mutex<Option<(Instant, Arc<Vec<WaitingRuns>>)>>>;

/// Runs that wait at one priority and name one hardware class, or none.
pub struct WaitingRuns {
    pub priority: i64,
    pub hardware_class: Option<String>,
    pub runs: i64,
    /// That they were expected to take.
    pub seconds: f64,
}

/// What one participant has waiting.
#[derive(Clone, Debug)]
pub struct QueueShare {
    /// The participant, as in the column `turn`.
    pub of: String,
    /// So many runs.
    pub waiting: i64,
    pub since: Since,
}

/// The share with the smallest is next: when it was served last, then what it waits with.
pub type Since = (i64, i64, String);

/// The class for which runs wait in the queue, and the usual one, which is that of runs that name none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OfClass {
    pub class: String,
    pub usual: String,
}
