//! Advice about levels of detail: worked on one at a time, kept in the store, taken up again after a restart.
//!
//! Such work is no run: no plugin is loaded and nothing is ranked. Its times are taken while this process holds the machine's
//! right to measure, so nothing is measured beside them; the rest of the work is kept off a run's CPU as all threads of this
//! process are. The work itself is done in the jail, by the lab's advisor.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ocb_advice::{CONFIGURATIONS, HELD_OUT, Watch};
use ocb_core::mesh::Mesh;
use ocb_lab::advisor::{Advisor, Found, Request};
use tokio::sync::{Notify, Semaphore};

use crate::Result;
use crate::blobs::Blobs;
use crate::machine::Machine;
use crate::measure::Stop;
use crate::model::{AdviceInfo, State};
use crate::objects::Objects;
use crate::runs::current::Work;
use crate::store::Store;
use crate::tasks::Tasks;

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

/// The requests that wait or are at work, by id.
pub struct Advices {
    pub from: Sources,
    pub work: Arc<Work>,
    pub tasks: Arc<Tasks>,
    jobs: Mutex<HashMap<String, Arc<Job>>>,
    /// Whose turn it is, first come, first served.
    pub turn: Semaphore,
}

/// One request under way.
pub struct Job {
    /// Ends it soon, or puts it off.
    pub stop: Stop,
    /// Rung when it is stopped, for one that waits.
    changed: Notify,
    info: Mutex<AdviceInfo>,
}

/// Configurations of an advice, and held out; where it is to be quick, fewer.
pub fn extent(quick: bool) -> [u32; 2] {
    if quick { [48, 96] } else { [CONFIGURATIONS, HELD_OUT] }
}

impl Advices {
    /// Nothing waits yet.
    pub fn new(from: Sources, work: Arc<Work>, tasks: Arc<Tasks>) -> Self {
        Self { from, work, tasks, jobs: Mutex::default(), turn: Semaphore::new(1) }
    }

    /// A request that waits from now on.
    pub fn add(&self, info: AdviceInfo) -> Arc<Job> {
        let id = info.id.clone();
        let job = Arc::new(Job { stop: Stop::default(), changed: Notify::new(), info: Mutex::new(info) });
        locked(&self.jobs).insert(id, job.clone());
        job
    }

    /// Nothing waits or is at work.
    pub fn is_empty(&self) -> bool {
        locked(&self.jobs).is_empty()
    }

    /// One of them.
    pub fn find(&self, id: &str) -> Option<Arc<Job>> {
        locked(&self.jobs).get(id).cloned()
    }

    /// It has ended.
    pub fn remove(&self, id: &str) {
        locked(&self.jobs).remove(id);
    }

    /// Ends all of them soon.
    pub fn stop_all(&self) {
        locked(&self.jobs).values().for_each(|job| job.stop());
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
        self.changed.notify_one();
    }

    /// Returns when it was stopped.
    pub async fn ended(&self) {
        self.changed.notified().await;
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
