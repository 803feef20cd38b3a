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
        self.from.store.add_advice(&info, None, "").await?;
        Ok(info.id)
    }

    /// Works on the oldest that has no end; false when none waits here, or visitors' advice is at work.
    pub(crate) async fn next_own(&self, asked: u64) -> Result<bool> {
        if self.from.elsewhere {
            return Ok(false);
        }
        let Ok(_one) = self.one.try_lock() else { return Ok(false) };
        let Some((attempt, info)) = self.begin(true, &self.work.worker).await? else { return Ok(false) };
        let job = self.add(info);
        self.work.set_current(&attempt.job, &job.stop, Some(asked));
        let ended = self.carry_out(&attempt, job).await;
        self.work.unset_current();
        ended.map(|()| true)
    }
}
