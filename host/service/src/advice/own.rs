//! Advice that the service makes by itself while it is idle, for an example of the start page.
//!
//! It gives way to any request and begins anew when the service is idle again; the certificates that it found are kept.

use super::waiting;
use crate::Result;
use crate::advice::work::Advices;
use crate::model::AdviceSpec;

impl Advices {
    /// Asks for it, and gives its id; the work begins when the service is idle.
    pub(crate) async fn ask_own(&self, spec: AdviceSpec) -> Result<String> {
        let names = self.objects_of(&spec, None).await?;
        let info = waiting(uuid::Uuid::now_v7().to_string(), spec, names);
        self.from.store.add_waiting_advice(&info, None, "").await?;
        Ok(info.id)
    }

    /// Works on the oldest that has no end; false when none waits here, or visitors' advice is at work.
    pub(crate) async fn next_own(&self, asked: u64) -> Result<bool> {
        if self.from.elsewhere {
            return Ok(false);
        }
        let Ok(_turn) = self.turn.try_acquire() else { return Ok(false) };
        let Some(row) = self.from.store.open_own_advice().await?.into_iter().next() else { return Ok(false) };
        // Another service may be quicker.
        let Some(attempt) = self.from.store.take_up(&row.info.id, &self.work.worker).await? else { return Ok(false) };
        let job = self.add(row.info);
        let lost = job.clone();
        let _held = self.work.holding.hold(&attempt, move || lost.stop());
        self.work.set_current(&attempt.job, &job.stop, Some(asked));
        let found = self.make(&attempt, &job).await;
        self.work.unset_current();
        let ended = match self.work.closing() || (job.stop.for_now() && matches!(found, Ok(None))) {
            true => self.from.store.put_back_advice(&attempt).await,
            false => self.end(&attempt, job.info(), found).await.map(|_| ()),
        };
        self.remove(&attempt.job);
        ended.map(|()| true)
    }
}
