//! Work under way, and how it is stopped.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use crate::attempts::Attempt;
use crate::attempts::worker::{Held, Holding, Worker};
use crate::measure::Stop;

/// The one job that the dispatcher works on.
struct Current {
    id: String,
    stop: Stop,
    /// It gives way to any request.
    idle: bool,
}

/// What this process works on, and what calls for more work.
pub struct Work {
    /// Who this process is to others on the same database.
    pub worker: Worker,
    current: Mutex<Option<Current>>,
    /// The attempts that it works on.
    pub holding: Arc<Holding>,
    /// Rung when the queue has something new.
    pub wake: Notify,
    /// Number of requests for work.
    asked: AtomicU64,
}

impl Work {
    /// Nothing is at work yet.
    pub fn of(worker: Worker) -> Self {
        Self {
            worker,
            current: Mutex::default(),
            holding: Arc::default(),
            wake: Notify::new(),
            asked: AtomicU64::new(0),
        }
    }

    /// How often more work was asked for.
    pub fn asked(&self) -> u64 {
        self.asked.load(Ordering::SeqCst)
    }

    /// There is new work: the dispatcher looks at the queue, and idle work gives way.
    pub fn call(&self) {
        self.asked.fetch_add(1, Ordering::SeqCst);
        self.give_way();
        self.wake.notify_one();
    }

    /// Keeps this attempt, and puts its work off when another worker has the job.
    pub fn hold(&self, attempt: &Attempt, stop: &Stop) -> Held {
        let stop = stop.clone();
        self.holding.hold(attempt, move || stop.stop_for_now())
    }

    /// Notes the work under way and how it is stopped.
    pub fn set_current(&self, id: &str, stop: &Stop) {
        *self.current() = Some(Current { id: id.to_owned(), stop: stop.clone(), idle: false });
    }

    /// The same for idle work. A request since then found nothing that could give way.
    pub fn set_current_idle(&self, id: &str, stop: &Stop, asked: u64) {
        *self.current() = Some(Current { id: id.to_owned(), stop: stop.clone(), idle: true });
        if self.asked() != asked {
            stop.stop_for_now();
        }
    }

    /// Nothing is at work.
    pub fn unset_current(&self) {
        *self.current() = None;
    }

    /// Stops the run at work if it is this one, or whichever it is, with a reason for its owner.
    pub fn stop_current(&self, id: Option<&str>, reason: Option<&str>) {
        if let Some(Current { id: running, stop, .. }) = &*self.current()
            && id.is_none_or(|id| id == running)
        {
            stop.stop_because(reason.map(str::to_owned));
        }
    }

    /// Stops idle work for now.
    fn give_way(&self) {
        if let Some(Current { stop, idle: true, .. }) = &*self.current() {
            stop.stop_for_now();
        }
    }

    fn current(&self) -> MutexGuard<'_, Option<Current>> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
