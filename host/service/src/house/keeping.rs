//! Becoming the housekeeper, and what it does first.

use std::time::Duration;

use crate::engine::Engine;
use crate::{Result, idle};

/// How often the lock is confirmed, or tried.
const TICK: Duration = Duration::from_secs(1);

impl Engine {
    /// Keeps house from now on if no other service does, and otherwise when that one is gone.
    pub(crate) async fn open_house(&self) -> Result<()> {
        let here = self.inner.house.look(&self.inner.store.locks, &self.inner.work.worker).await?;
        let takes_over = self.inner.house.note(here);
        if self.inner.store.locks.are_shared() {
            self.inner.tasks.spawn(self.clone().keep_house());
        }
        if takes_over { self.take_over().await } else { Ok(()) }
    }

    async fn keep_house(self) {
        let inner = &self.inner;
        while !inner.work.closing() {
            tokio::select! {
                () = tokio::time::sleep(TICK) => {}
                () = inner.house.closing() => return,
            }
            let here = inner.house.look(&inner.store.locks, &inner.work.worker).await.unwrap_or_else(|e| {
                tracing::warn!("it is not known which service keeps house: {e}");
                false
            });
            if inner.house.note(here) {
                tracing::info!("this service keeps house now");
                let engine = self.clone();
                inner.tasks.spawn(async move {
                    if let Err(e) = engine.take_over().await {
                        tracing::error!("what an ended service left could not be taken up: {e}");
                    }
                });
            }
        }
    }

    /// What an ended service may have left behind, and what is planned once.
    async fn take_over(&self) -> Result<()> {
        let inner = &self.inner;
        if !inner.config.idle {
            idle::end_waiting(&inner.store).await?;
        }
        self.feature_a_run().await?;
        self.catch_up_with_the_suite().await?;
        self.take_up_campaigns().await;
        // Lost attempts are looked for, and idle work.
        inner.work.holding.look.notify_one();
        inner.work.wake.notify_one();
        Ok(())
    }
}
