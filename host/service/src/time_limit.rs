//! Time limits of work.

use std::time::Duration;

use crate::measure::Stop;

/// How often it is looked whether the time is over, at most.
const LOOK: Duration = Duration::from_millis(20);

/// Waits for the end of the work, and stops it with this reason when it has taken so long. Waiting for its turn to measure does
/// not count: that is not the work's fault.
pub async fn in_time<T>(work: impl Future<Output = T>, stop: &Stop, limit: Option<(Duration, String)>) -> T {
    tokio::pin!(work);
    let Some((longest, reason)) = limit else { return work.await };
    while stop.worked() < longest {
        let left = longest.saturating_sub(stop.worked()).max(LOOK);
        if let Ok(ended) = tokio::time::timeout(left, &mut work).await {
            return ended;
        }
    }
    stop.stop_because(Some(reason));
    work.await
}
