//! Advice about levels of detail: one at a time, each when its visitor's turn comes; it waits in the store.
//!
//! Such work is no run: no plugin is loaded and nothing is ranked. Its times are taken while this process holds the machine's
//! right to measure, so nothing is measured beside them; the rest of the work is kept off a run's CPU as all threads of this
//! process are. The work itself is done in the jail, by the lab's advisor.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use ocb_advice::{CONFIGURATIONS, HELD_OUT, Watch};
use ocb_core::mesh::Mesh;
use ocb_lab::advisor::{Advisor, Found, Request};
use tokio::sync::{Mutex as Turn, Notify};

use crate::Result;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, BACK_OFF, Kind, MOST_LOST};
use crate::blobs::Blobs;
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::{AdviceInfo, State};
use crate::objects::Objects;
use crate::runs::current::Work;
use crate::store::Store;

/// What advice is made from.
pub struct Sources {
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Arc<Objects>,
    pub machine: Machine,
    /// The advisor's program.
    pub program: PathBuf,
    /// The data folder.
    pub data: PathBuf,
    /// Advice is to be quick: see [`extent`].
    pub quick: bool,
    /// Measuring machines make it.
    pub elsewhere: bool,
}

/// While a request waits, its turn is looked for this often: runs that begin or end may bring it.
const LOOK: Duration = Duration::from_secs(1);
/// While none waits, this often, even if nobody rings.
const IDLE: Duration = Duration::from_secs(10);

/// The requests at work, by id, and what makes advice.
pub struct Advices {
    pub from: Sources,
    pub work: Arc<Work>,
    jobs: Mutex<HashMap<String, Arc<Job>>>,
    /// One is at work at a time.
    pub one: Turn<()>,
    /// Rung when a request was added, or the service closes.
    pub called: Notify,
}

/// One request at work.
pub struct Job {
    /// Ends it soon, or puts it off.
    pub stop: Stop,
    info: Mutex<AdviceInfo>,
}

/// Configurations of an advice, and held out; where it is to be quick, fewer.
pub fn extent(quick: bool) -> [u32; 2] {
    if quick { [48, 96] } else { [CONFIGURATIONS, HELD_OUT] }
}

impl Advices {
    /// Nothing is at work yet.
    pub fn new(from: Sources, work: Arc<Work>) -> Self {
        Self { from, work, jobs: Mutex::default(), one: Turn::default(), called: Notify::new() }
    }

    /// Makes what visitors ask for until the service closes.
    pub async fn work(self: Arc<Self>) {
        while !self.work.closing() {
            let pause = self.make_next().await.unwrap_or_else(|e| {
                tracing::error!("advice: {e}");
                Some(BACK_OFF)
            });
            if let Some(pause) = pause {
                let _ = tokio::time::timeout(pause, self.called.notified()).await;
            }
        }
    }

    /// Makes the advice that is due, if that is what is due first; otherwise, how long to wait before the next look.
    async fn make_next(&self) -> Result<Option<Duration>> {
        let (store, worker) = (&self.from.store, &self.work.worker);
        let due = store.in_turn(worker, None).await?;
        if due.first() != Some(&Kind::Advise) {
            return Ok(Some(if due.contains(&Kind::Advise) { LOOK } else { IDLE }));
        }
        let _one = self.one.lock().await;
        if let Some((attempt, info)) = self.begin(false, worker).await? {
            self.carry_out(&attempt, self.add(info)).await?;
            // Idle work waits for it.
            self.work.wake.notify_one();
        }
        Ok(None)
    }

    /// Begins the request that is due: of visitors, or of the service itself. One that was lost too often is given up.
    pub async fn begin(&self, own: bool, worker: &Worker) -> Result<Option<(Attempt, AdviceInfo)>> {
        while let Some((attempt, row)) = self.from.store.begin_advice(own, worker).await? {
            if row.attempts <= MOST_LOST {
                return Ok(Some((attempt, row.info)));
            }
            self.give_up(&attempt, row.info).await?;
        }
        Ok(None)
    }

    /// Makes advice, and keeps what became of it. What closing interrupted, or was stopped for now, waits again.
    pub async fn carry_out(&self, attempt: &Attempt, job: Arc<Job>) -> Result<()> {
        let lost = job.clone();
        let _held = self.work.holding.hold(attempt, move || lost.stop());
        // A shutdown that came before found nothing to stop.
        if self.work.closing() {
            job.stop();
        }
        let found = self.make(&job).await;
        let ended = match self.work.closing() || (job.stop.for_now() && matches!(found, Ok(None))) {
            true => self.from.store.put_back_advice(attempt).await,
            false => self.end(attempt, job.info(), found).await.map(|_| ()),
        };
        locked(&self.jobs).remove(&attempt.job);
        ended
    }

    /// A request that is at work from now on.
    pub fn add(&self, info: AdviceInfo) -> Arc<Job> {
        let id = info.id.clone();
        let job = Arc::new(Job { stop: Stop::default(), info: Mutex::new(info) });
        locked(&self.jobs).insert(id, job.clone());
        job
    }

    /// One that is at work here.
    pub fn find(&self, id: &str) -> Option<Arc<Job>> {
        locked(&self.jobs).get(id).cloned()
    }

    /// Ends all of them soon; the service closes.
    pub fn stop_all(&self) {
        locked(&self.jobs).values().for_each(|job| job.stop());
        self.called.notify_one();
    }
}

impl Job {
    /// How far it is.
    pub fn info(&self) -> AdviceInfo {
        locked(&self.info).clone()
    }

    /// Ends it soon.
    pub fn stop(&self) {
        self.stop.stop();
    }

    /// Over so many configurations, and so many held out; `None` when it was stopped.
    pub fn work(
        &self,
        names: &[String; 2],
        meshes: [Arc<Mesh>; 2],
        advisor: &Advisor,
        counts: [u32; 2],
    ) -> Result<Option<Found>> {
        let question = {
            let mut info = locked(&self.info);
            info.state = State::Running;
            info.spec.question
        };
        let request = Request::of(question, names.clone(), meshes, counts);
        Ok(advisor.advise(&request, self)?.map(|advised| advised.found(names)))
    }
}

impl Watch for Job {
    fn step(&self, what: &str, done: u64, total: u64) {
        // Nobody who works waits for somebody who looks.
        if let Ok(mut info) = self.info.try_lock() {
            if info.step != what {
                what.clone_into(&mut info.step);
            }
            (info.done, info.total) = (done, total);
        }
    }

    fn stopped(&self) -> bool {
        self.stop.asked()
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
