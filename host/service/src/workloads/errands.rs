//! Replays for measuring machines.

use std::path::Path;

use ocb_lab::workload::{Found, stretch};

use super::recordings::parsed;
use super::replay::{Replays, seed_of};
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::blocking::blocking;
use crate::machines::orders::ordered;
use crate::model::{Errand, OrderedAlgorithm, Stretch, Told, Wanted, WorkloadResult, WorkloadSpec};
use crate::{EngineError, Result};

impl Replays {
    /// The next replay for a machine. What cannot be replayed ends here.
    pub async fn errand(&self, worker: &Worker) -> Result<Option<Errand>> {
        while let Some((attempt, row)) = self.begin(worker).await? {
            let order = match self.order(&row).await {
                Ok(order) => order,
                Err(e) => {
                    self.settle(&attempt, &row, Err(e)).await?;
                    continue;
                }
            };
            let wanted = Wanted::Replay {
                recording: Box::new(row.recording.clone()),
                spec: Box::new(WorkloadSpec { seed: Some(seed_of(&order.spec)), ..order.spec }),
                algorithms: order.algorithms.iter().map(|it| ordered(it)).collect(),
            };
            let most_seconds = self.limit(&row).map(|(longest, _)| longest.as_secs_f64());
            return Ok(Some(Errand { attempt: attempt.id, job: attempt.job, wanted, most_seconds }));
        }
        Ok(None)
    }

    /// Keeps how far a machine is.
    pub async fn told(&self, attempt: &Attempt, told: &Told) -> Result<()> {
        match told {
            Told::Replaying { done, doing } => self.store.replay_is_at(&attempt.job, *done, doing.as_deref()).await,
            _ => Ok(()),
        }
    }

    /// Takes what a machine has found with these algorithms, with its files; false when the attempt is not the current one.
    pub async fn take(
        &self,
        attempt: &Attempt,
        algorithms: Vec<OrderedAlgorithm>,
        result: WorkloadResult,
        files: Vec<Vec<u8>>,
    ) -> Result<bool> {
        let Some(row) = self.store.workload(&attempt.job).await? else { return Ok(false) };
        let (told, folder) = (row.recording.clone(), self.data.clone());
        let found = blocking(move || {
            let mut files = files.into_iter();
            let (queries, reduced) = (files.next(), files.next());
            let queries = queries.ok_or_else(|| wrong("the file of the queries is missing"))?;
            let found = Found { result, queries, reduced };
            if files.next().is_some() || found.reduced.is_some() != found.result.reduced.is_some() {
                return Err(wrong("there is a file too many or too few"));
            }
            checked(&found, &algorithms, told.queries, &folder)?;
            Ok(found)
        });
        self.accept(attempt, &row, found.await?).await
    }

    /// Notes that a machine did not come to the end.
    pub async fn not_done(&self, attempt: &Attempt, why: EngineError) -> Result<()> {
        let Some(row) = self.store.workload(&attempt.job).await? else { return Ok(()) };
        self.settle(attempt, &row, Err(why)).await
    }

    /// Notes that the time of a replay was over on a machine.
    pub async fn too_long(&self, attempt: &Attempt) -> Result<()> {
        let Some(row) = self.store.workload(&attempt.job).await? else { return Ok(()) };
        let reason = self.limit(&row).map(|(_, reason)| reason);
        self.stopped(attempt, reason.as_deref()).await
    }
}

/// Is this of what was ordered, and can its files be read?
fn checked(found: &Found, algorithms: &[OrderedAlgorithm], queries: u64, folder: &Path) -> Result<()> {
    let known = |name: &str| algorithms.iter().any(|it| it.info.id == name);
    let measured = found.result.tracks.iter().flat_map(|track| &track.algorithms);
    if measured.map(|it| &it.algorithm).any(|name| !known(name)) {
        return Err(wrong("an algorithm was not ordered"));
    }
    if found.result.queries > queries {
        return Err(wrong("it has more queries than the recording"));
    }
    let table = stretch(&found.queries, Stretch { from: None, to: None }).map_err(|e| wrong(&e.to_string()))?;
    if table.algorithms.iter().any(|it| !known(&it.algorithm)) {
        return Err(wrong("the file of the queries names an algorithm that was not ordered"));
    }
    if let Some(file) = &found.reduced {
        parsed("the reduced scene", file, folder).map_err(|e| wrong(&e.to_string()))?;
    }
    Ok(())
}

fn wrong(what: &str) -> EngineError {
    EngineError::Invalid(format!("This is not the replay that was ordered: {what}."))
}
