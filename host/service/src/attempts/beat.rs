//! The beat that keeps the attempts of this process, and looks at those of others.

use std::sync::Arc;
use std::time::Duration;

use crate::classes::Classes;
use crate::house::House;
use crate::mail::outbox::Outbox;
use crate::runs::current::Work;
use crate::runs::ends::RunEnds;
use crate::store::Store;

/// How often leases are renewed: several beats may be late before a lease is over.
const BEAT: Duration = Duration::from_secs(5);

/// The leases of attempts: those of this process, and those of workers that may be gone.
pub struct Leases {
    pub store: Store,
    pub work: Arc<Work>,
    pub classes: Arc<Classes>,
    pub house: Arc<House>,
    /// Who hears of attempts that were lost.
    pub run_ends: Arc<RunEnds>,
    pub outbox: Arc<Outbox>,
}

impl Leases {
    /// Renews the leases of this process and, while it keeps house, takes back attempts of workers that are gone; until the engine
    /// closes.
    pub async fn beat(self) {
        while !self.work.closing() {
            tokio::select! {
                () = tokio::time::sleep(BEAT) => {}
                () = self.work.holding.look.notified() => {}
                () = self.work.holding.closed.notified() => return,
            }
            for attempt in self.work.holding.ids() {
                match self.store.beat(&attempt).await {
                    Ok(true) => {}
                    Ok(false) => self.work.holding.stop(&attempt),
                    Err(e) => tracing::warn!("the lease of the attempt {attempt} was not renewed: {e}"),
                }
            }
            if let Err(e) = self.classes.learn_from(&self.store).await {
                tracing::warn!("the hardware classes of the measuring machines are not known: {e}");
            }
            if self.house.is_here()
                && let Err(e) = self.take_back(None).await
            {
                tracing::error!("attempts of lost workers could not be taken back: {e}");
            }
        }
    }
}
