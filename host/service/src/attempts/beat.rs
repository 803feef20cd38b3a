//! The beat that keeps the attempts of this process, and looks at those of others.

use std::sync::Arc;
use std::time::Duration;

use super::lost;
use crate::engine::Inner;

/// How often leases are renewed: several beats may be late before a lease is over.
const BEAT: Duration = Duration::from_secs(5);

/// Renews the leases of this process and, while it keeps house, takes back attempts of workers that are gone; until the engine
/// closes.
pub async fn beat(inner: Arc<Inner>) {
    while !inner.work.closing() {
        tokio::select! {
            () = tokio::time::sleep(BEAT) => {}
            () = inner.work.holding.look.notified() => {}
            () = inner.work.holding.closed.notified() => return,
        }
        for attempt in inner.work.holding.ids() {
            match inner.store.beat(&attempt).await {
                Ok(true) => {}
                Ok(false) => inner.work.holding.stop(&attempt),
                Err(e) => tracing::warn!("the lease of the attempt {attempt} was not renewed: {e}"),
            }
        }
        if let Err(e) = inner.classes.learn_from(&inner.store).await {
            tracing::warn!("the hardware classes of the measuring machines are not known: {e}");
        }
        if inner.house.is_here()
            && let Err(e) = lost::take_back(&inner, None).await
        {
            tracing::error!("attempts of lost workers could not be taken back: {e}");
        }
    }
}
