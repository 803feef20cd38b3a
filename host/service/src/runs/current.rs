//! Work under way, and how it is stopped.

use std::fs::File;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use crate::Result;
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
    /// Held as long as this process uses the folder.
    lock: File,
    closing: AtomicBool,
    current: Mutex<Option<Current>>,
    /// The attempts that it works on.
    pub holding: Arc<Holding>,
    /// Rung when the queue has something new.
    pub wake: Notify,
    /// Rung when a run was prepared for a measuring machine.
    pub prepared: Notify,
    /// Number of requests for work.
    asked: AtomicU64,
}

impl Work {
    /// Nothing is at work yet in the folder of this lock.
    pub fn new(lock: File, class: &str) -> Result<Self> {
        Ok(Self {
            worker: Worker::of(&lock, class)?,
            lock,
            closing: AtomicBool::default(),
            current: Mutex::default(),
            holding: Arc::default(),
            wake: Notify::new(),
            prepared: Notify::new(),
            asked: AtomicU64::new(0),
        })
    }

    /// The engine shuts down: what is at work is put back, and nothing else begins.
    pub fn close(&self) {
        self.closing.store(true, Ordering::SeqCst);
        self.stop_current(None, None);
        self.wake.notify_one();
        self.holding.closed.notify_one();
    }

    /// The engine is shutting down.
    pub fn closing(&self) -> bool {
        self.closing.load(Ordering::SeqCst)
    }

    /// Nothing works in the folder any more, and another process may open it.
    pub fn leave(&self) {
        // Closing the file does it too; at the latest then it is free.
        let _ = self.lock.unlock();
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

    /// Begins the work on an attempt, and keeps it until what this gives is dropped. The work is put off when another worker has
    /// the job. Idle work gives way to any request after so many.
    pub fn begin(&self, attempt: &Attempt, stop: &Stop, idle: Option<u64>) -> Held {
        let when_lost = stop.clone();
        let held = self.holding.hold(attempt, move || when_lost.stop_for_now());
        self.set_current(&attempt.job, stop, idle);
        // A shutdown that came before found nothing to stop.
        if self.closing() {
            stop.stop();
        }
        held
    }

    /// Notes the work under way and how it is stopped.
    pub fn set_current(&self, id: &str, stop: &Stop, idle: Option<u64>) {
        *self.current() = Some(Current { id: id.to_owned(), stop: stop.clone(), idle: idle.is_some() });
        // A request since then found nothing that could give way.
        if idle.is_some_and(|asked| asked != self.asked()) {
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
