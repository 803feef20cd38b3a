//! Parts of stability runs for measuring machines.

use ocb_lab::LabError;

use super::work::{Next, StabilityRuns};
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::machines::orders::ordered;
use crate::model::{Errand, Stability, Wanted};
use crate::{EngineError, Result};

impl StabilityRuns {
    /// The next part for a machine. What needs none, or cannot be tried, ends here.
    pub async fn errand(&self, priority: i64, worker: &Worker) -> Result<Option<Errand>> {
        while let Some((attempt, row)) = self.begin(priority, worker).await? {
            let next = match self.next_part(&row).await {
                Ok(next) => next,
                Err(e) => {
                    self.settle(&attempt, &row, Err(e), None).await?;
                    continue;
                }
            };
            let Some(part) = next.part else {
                self.accept(&attempt, &row, next, 0.0).await?;
                continue;
            };
            let most_seconds = self.limit(&row).map(|(left, _)| left.as_secs_f64());
            let wanted = Wanted::Stability {
                algorithm: Box::new(ordered(&next.algorithm)),
                spec: row.spec,
                part: part.to_owned(),
                found: Box::new(next.found),
            };
            return Ok(Some(Errand { attempt: attempt.id, job: attempt.job, wanted, most_seconds }));
        }
        Ok(None)
    }

    /// Takes what a machine has found with this part; false when the attempt is not the current one.
    pub async fn take(&self, attempt: &Attempt, part: &str, found: Stability, seconds: f64) -> Result<bool> {
        let Some(row) = self.store.stability_run(&attempt.job).await? else { return Ok(false) };
        let next = match self.next_part(&row).await {
            Ok(next) => next,
            // Its plugin was taken away meanwhile, which is no fault of the machine.
            Err(e) => return self.settle(attempt, &row, Err(e), None).await.map(|()| true),
        };
        let as_ordered = (&found.algorithm, &found.plugin_sha256) == (&next.found.algorithm, &next.found.plugin_sha256);
        if !as_ordered || next.part != Some(part) || !(seconds.is_finite() && seconds >= 0.0) {
            return Err(EngineError::Invalid("This is of another algorithm, or of another part.".into()));
        }
        self.accept(attempt, &row, Next { found, ..next }, seconds).await
    }

    /// Notes that a machine did not come to the end of a part, or why it could not try it.
    pub async fn not_done(&self, attempt: &Attempt, why: LabError, too_long: bool) -> Result<()> {
        let Some(row) = self.store.stability_run(&attempt.job).await? else { return Ok(()) };
        let reason = self.limit(&row).filter(|_| too_long).map(|(_, reason)| reason);
        self.settle(attempt, &row, Err(why), reason.as_deref()).await
    }
}
