//! Work under way, and how it is stopped.

use std::sync::atomic::Ordering;
use std::sync::{MutexGuard, PoisonError};

use crate::attempts::Attempt;
use crate::attempts::worker::Held;
use crate::engine::{Current, Inner};
use crate::measure::Stop;

impl Inner {
    /// Keeps this attempt, and puts its work off when another worker has the job.
    pub(crate) fn hold(&self, attempt: &Attempt, stop: &Stop) -> Held {
        let stop = stop.clone();
        self.holding.hold(attempt, move || stop.stop_for_now())
    }

    /// Notes the work under way and how it is stopped.
    pub(crate) fn set_current(&self, id: &str, stop: &Stop) {
        *self.current() = Some(Current { id: id.to_owned(), stop: stop.clone(), idle: false });
    }

    /// The same for idle work. A request since then found nothing that could give way.
    pub(crate) fn set_current_idle(&self, id: &str, stop: &Stop, asked: u64) {
        *self.current() = Some(Current { id: id.to_owned(), stop: stop.clone(), idle: true });
        if self.asked.load(Ordering::SeqCst) != asked {
            stop.stop_for_now();
        }
    }

    /// Nothing is at work.
    pub(crate) fn unset_current(&self) {
        *self.current() = None;
    }

    /// Stops idle work for now.
    pub fn give_way(&self) {
        if let Some(Current { stop, idle: true, .. }) = &*self.current() {
            stop.stop_for_now();
        }
    }

    /// Stops the run at work if it is this one, or whichever it is, with a reason for its owner.
    pub fn stop_current(&self, id: Option<&str>, reason: Option<&str>) {
        if let Some(Current { id: running, stop, .. }) = &*self.current()
            && id.is_none_or(|id| id == running)
        {
            stop.stop_because(reason.map(str::to_owned));
        }
    }

    fn current(&self) -> MutexGuard<'_, Option<Current>> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
