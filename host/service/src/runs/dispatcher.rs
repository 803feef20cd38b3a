//! The local dispatcher: one job of the queue is at work at a time, each on a thread of its own.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::Result;
use crate::attempts::{BACK_OFF, Kind};
use crate::idle::IdleWork;
use crate::plugins::checks::Checks;
use crate::runs::benchmarks::Benchmarks;
use crate::runs::current::Work;
use crate::stability::work::StabilityRuns;
use crate::workloads::replay::Replays;

/// The queue is looked at this often even if nobody rings.
const IDLE: Duration = Duration::from_secs(30);
/// After several of checks in succession at most.
const LONGEST_BACK_OFF: Duration = Duration::from_secs(60);

/// Every kind of job of the queue.
pub struct Dispatcher {
    pub work: Arc<Work>,
    pub checks: Arc<Checks>,
    pub stability: Arc<StabilityRuns>,
    pub replays: Arc<Replays>,
    pub benchmarks: Arc<Benchmarks>,
    pub idle: IdleWork,
}

impl Dispatcher {
    /// Works on the queue until the engine closes.
    pub async fn work(mut self) {
        let (mut faults, mut next_check) = (0, Instant::now());
        while !self.work.closing() {
            let asked = self.work.asked();
            // Checks are in turn with all else.
            let mut checked = false;
            if Instant::now() >= next_check {
                match self.checks.next().await {
                    Ok(done) => (checked, faults) = (done, 0),
                    Err(e) => {
                        let pause = back_off(faults);
                        (faults, next_check) = (faults + 1, Instant::now() + pause);
                        tracing::error!("checking a plugin, again in {} s: {e}", pause.as_secs());
                    }
                }
            }
            let worked = self.work_in_turn().await;
            if !worked && !checked && !self.idle.work(asked).await {
                let idle = if faults > 0 { next_check.saturating_duration_since(Instant::now()) } else { IDLE };
                let _ = tokio::time::timeout(idle, self.work.wake.notified()).await;
            }
        }
    }

    /// Works on the job that is due first; false when none waits for this service.
    async fn work_in_turn(&self) -> bool {
        let kinds = match self.due().await {
            Ok(kinds) => kinds,
            Err(e) => {
                tracing::error!("reading the queue: {e}");
                tokio::time::sleep(BACK_OFF).await;
                return true;
            }
        };
        for kind in kinds {
            match self.next_of(kind).await {
                Ok(false) => {}
                Ok(true) => return true,
                Err(e) => {
                    tracing::error!("{}: {e}", kind.name());
                    tokio::time::sleep(BACK_OFF).await;
                    // It is tried again, whoever else comes.
                    return true;
                }
            }
        }
        false
    }

    async fn due(&self) -> Result<Vec<Kind>> {
        let Benchmarks { store, elsewhere, .. } = &*self.benchmarks;
        if *elsewhere { Ok(vec![Kind::Measure]) } else { store.in_turn(&self.work.worker, None).await }
    }

    /// Works on the next job of a kind; false when there is none. Advice is made beside the queue.
    async fn next_of(&self, kind: Kind) -> Result<bool> {
        match kind {
            Kind::Stability => self.stability.next(None).await,
            Kind::Replay => self.replays.next().await,
            Kind::Measure => {
                let Some(attempt) = self.benchmarks.next(false).await? else { return Ok(false) };
                let done = self.benchmarks.carry_out(&attempt, None).await;
                done.map(|()| true).inspect_err(|_| tracing::error!("run {}, attempt {}", attempt.job, attempt.number))
            }
            Kind::Prepare | Kind::Check | Kind::Advise => Ok(false),
        }
    }
}

/// How long checks wait after so many faults before this one.
fn back_off(faults: u32) -> Duration {
    BACK_OFF.saturating_mul(2_u32.saturating_pow(faults)).min(LONGEST_BACK_OFF)
}

#[test]
fn faults_in_succession_are_further_and_further_apart() {
    assert_eq!([0, 1, 2, 4, 5, 900].map(|faults| back_off(faults).as_secs()), [2, 4, 8, 32, 60, 60]);
}
