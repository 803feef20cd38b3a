//! Asking for advice, looking at it, taking it away.

mod errands;
mod own;
pub mod sql;
pub mod work;

use std::sync::Arc;
use std::time::Duration;

use ocb_advice::Paper;
use ocb_core::mesh::{Mesh, obj};
use ocb_lab::advisor::{Advisor, Found, SHELF};

use crate::advice::sql::{AdviceRow, StoredPaper};
use crate::advice::work::{Advices, Job, extent};
use crate::attempts::{Attempt, MOST_LOST};
use crate::boxed;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::{AdviceInfo, AdviceSpec, Asked, Side, State};
use crate::quotas::{Visitor, turn};
use crate::requests::Made;
use crate::store::Store;
use crate::{EngineError, Result};

/// So many requests of one account, or of the guests of one address, may wait or be at work, and so many in all.
const MOST_OPEN: usize = 3;
const MOST_IN_ALL: usize = 200;
/// Tries to end one whose work begins, and the time between two.
const TRIES: u32 = 100;
const AGAIN: Duration = Duration::from_millis(50);
/// When to ask again: advice takes minutes.
const RETRY_SECONDS: u32 = 120;

impl Engine {
    /// Asks how much of two objects a question needs; the work begins when its turn comes. True when it is new: the same asked
    /// again under the same key gives what there is.
    ///
    /// # Errors
    /// `NotFound` without such an object, `Invalid` for a question that cannot be asked, `TooMuch` when too many wait.
    #[boxed]
    pub async fn ask_advice(
        &self,
        spec: AdviceSpec,
        visitor: &Visitor,
        key: Option<&str>,
    ) -> Result<(AdviceInfo, bool)> {
        let owner = visitor.owner.as_str();
        check(spec.question)?;
        let inner = &self.inner;
        let names = inner.advices.objects_of(&spec, Some(owner)).await?;
        let id = self.id_of_request(owner, Made::Advice, key, &spec).await?;
        if inner.store.advice(&id).await?.is_some() {
            return Ok((self.advice(&id).await?, false));
        }
        let turn = turn(owner, visitor.address.as_deref());
        // Two concurrent requests must not share the last of a quota.
        let _alone = inner.store.locks.alone(Lock::Admission).await?;
        let [all, own] = inner.store.count_open_advice(&turn).await?;
        if own >= MOST_OPEN || all >= MOST_IN_ALL {
            let whose = if own >= MOST_OPEN { format!("{own} of your requests") } else { format!("{all} requests") };
            let message = format!("{whose} for advice are queued or running; try again when one of them has ended.");
            return Err(EngineError::TooMuch { message, retry_seconds: RETRY_SECONDS });
        }
        let info = waiting(id, spec, names);
        // Two that come at once under one key: the first stands.
        let new = inner.store.add_advice(&info, Some(owner), &turn).await?;
        inner.work.call();
        inner.advices.called.notify_one();
        Ok((self.advice(&info.id).await?, new))
    }

    /// How far it is, and the advice when it is done.
    #[boxed]
    pub async fn advice(&self, id: &str) -> Result<AdviceInfo> {
        match self.inner.advices.find(id) {
            Some(job) => Ok(job.info()),
            None => Ok(self.inner.store.advice_row(id).await?.info),
        }
    }

    /// Ends it; only its owner may.
    #[boxed]
    pub async fn cancel_advice(&self, id: &str, caller: Option<&str>) -> Result<AdviceInfo> {
        let (store, here) = (&self.inner.store, &self.inner.work.worker);
        let row = store.advice_row(id).await?;
        if row.owner.as_deref() != caller {
            return Err(EngineError::Forbidden("Only the owner of the advice may cancel it.".to_owned()));
        }
        let mut info = row.info;
        // The work on it may begin at this moment, here or elsewhere.
        for _ in 0..TRIES {
            if !matches!(info.state, State::Queued | State::Running) {
                break;
            }
            if let Some(job) = self.inner.advices.find(id) {
                job.stop();
                return Ok(job.info());
            }
            let ended = AdviceInfo { state: State::Cancelled, ..info };
            if !store.end_waiting_advice(&ended).await? && !store.withdraw_advice(&ended, here).await? {
                tokio::time::sleep(AGAIN).await;
            }
            info = store.advice_row(id).await?.info;
        }
        Ok(info)
    }

    /// A reduced object as OBJ, and the name of its file; `stage` counts from the coarsest.
    #[boxed]
    pub async fn reduced(&self, id: &str, side: Side, stage: usize) -> Result<(Vec<u8>, String)> {
        let paper = self.inner.store.paper(id, side, stage).await?;
        Ok((self.inner.blobs.get(&paper.mesh).await?, paper.file))
    }

    /// The certificate of a reduced object as JSON, and the name of its file.
    #[boxed]
    pub async fn certificate(&self, id: &str, side: Side, stage: usize) -> Result<(Vec<u8>, String)> {
        let paper = self.inner.store.paper(id, side, stage).await?;
        Ok((self.inner.blobs.get(&paper.certificate).await?, paper.file.replace(".obj", ".certificate.json")))
    }
}

impl Store {
    async fn advice_row(&self, id: &str) -> Result<AdviceRow> {
        self.advice(id).await?.ok_or_else(|| no_advice(id))
    }

    async fn paper(&self, id: &str, side: Side, stage: usize) -> Result<StoredPaper> {
        let row = self.advice_row(id).await?;
        let none = || EngineError::NotFound("This advice has no such reduced object.".to_owned());
        row.papers[side as usize].get(stage).cloned().ok_or_else(none)
    }
}

impl Advices {
    /// Names of both objects.
    async fn objects_of(&self, spec: &AdviceSpec, viewer: Option<&str>) -> Result<[String; 2]> {
        let b = spec.object_b.as_deref().unwrap_or(&spec.object_a);
        let (a, b) =
            (self.from.objects.info_for(&spec.object_a, viewer).await?, self.from.objects.info_for(b, viewer).await?);
        Ok([a.name, b.name])
    }

    /// It was lost too often.
    async fn give_up(&self, attempt: &Attempt, info: AdviceInfo) -> Result<()> {
        let message = format!(
            "The service or a measuring machine ended {MOST_LOST} times during this work, so it is not tried again."
        );
        let info = AdviceInfo { state: State::Failed, message: Some(message), ..info };
        self.from.store.end_advice(attempt, &info, &Default::default()).await.map(|_| ())
    }

    /// The meshes of both objects; one is there once.
    async fn meshes_of(&self, spec: &AdviceSpec) -> Result<[Arc<Mesh>; 2]> {
        let a = self.from.objects.mesh(&spec.object_a).await?;
        let b = match &spec.object_b {
            Some(b) if *b != spec.object_a => self.from.objects.mesh(b).await?,
            _ => a.clone(),
        };
        Ok([a, b])
    }

    /// `None` when it was stopped.
    async fn make(&self, job: &Arc<Job>) -> Result<Option<Found>> {
        let AdviceInfo { spec, names, .. } = job.info();
        let meshes = self.meshes_of(&spec).await?;
        let advisor = Advisor::new(&self.from.program, &self.from.machine, &self.from.data.join(SHELF));
        let (job, advisor) = (job.clone(), advisor.waiting_for_the_right());
        let extent = extent(self.from.quick);
        let work = tokio::task::spawn_blocking(move || job.work(&names, meshes, &advisor, extent));
        work.await.unwrap_or_else(|_| Err(EngineError::Fault("Work on advice panicked; see the log.".to_owned())))
    }

    /// Keeps what was found, or why nothing was; false when the attempt is not the current one.
    async fn end(&self, attempt: &Attempt, mut info: AdviceInfo, found: Result<Option<Found>>) -> Result<bool> {
        let mut papers: [Vec<StoredPaper>; 2] = Default::default();
        let _keeping = self.from.store.locks.keeping().await?;
        (info.state, info.message) = match found {
            Ok(Some((advice, found))) => {
                for (side, all) in found.iter().enumerate() {
                    for (paper, mesh) in all {
                        papers[side].push(self.keep_paper(paper, mesh).await?);
                    }
                }
                info.advice = Some(advice);
                (State::Done, None)
            }
            Ok(None) => (State::Cancelled, None),
            Err(e) => (State::Failed, Some(e.for_visitors().to_string())),
        };
        let kept = self.from.store.end_advice(attempt, &info, &papers).await?;
        if !kept {
            tracing::warn!(
                "advice {}: the result of attempt {} comes too late and is not kept",
                info.id,
                attempt.number
            );
        }
        Ok(kept)
    }

    async fn keep_paper(&self, paper: &Paper, mesh: &Mesh) -> Result<StoredPaper> {
        let json = serde_json::to_vec(paper).map_err(|e| EngineError::fault("Writing a certificate failed", e))?;
        let mut kept = Vec::new();
        for (bytes, media_type) in [(obj::write(mesh).into_bytes(), "model/obj"), (json, "application/json")] {
            let length = bytes.len();
            let sha256 = self.from.blobs.put(bytes).await?;
            self.from.store.add_blob(&sha256, length, media_type).await?;
            kept.push(sha256);
        }
        let [mesh, certificate] = kept.try_into().expect("two blobs");
        Ok(StoredPaper { mesh, certificate, file: paper.file.clone() })
    }
}

/// A request that waits.
fn waiting(id: String, spec: AdviceSpec, names: [String; 2]) -> AdviceInfo {
    let (state, step) = (State::Queued, "waiting".to_owned());
    AdviceInfo { id, spec, names, state, step, done: 0, total: 0, message: None, advice: None }
}

/// There is no such advice, or not for who asks: both sound alike.
pub(crate) fn no_advice(id: &str) -> EngineError {
    EngineError::NotFound(format!("There is no advice {id:?}; check the link."))
}

fn check(question: Asked) -> Result<()> {
    // Written so that NaN fails.
    match question {
        Asked::Distance { tolerance } if !(tolerance > 0.0 && tolerance <= 1.0) => Err(EngineError::Invalid(format!(
            "The tolerance must be more than 0 and at most 1 (a share of A's longest side), not {tolerance}."
        ))),
        Asked::Clearance { clearance } if !(0.0..=100.0).contains(&clearance) => Err(EngineError::Invalid(format!(
            "The clearance must be from 0 to 100 (a share of A's longest side), not {clearance}."
        ))),
        Asked::Distance { .. } | Asked::Clearance { .. } => Ok(()),
    }
}
