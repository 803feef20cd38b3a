//! Stopping a measurement from another thread.

use std::sync::{Arc, Mutex, PoisonError};

use ocb_sandbox::Killer;

/// Ends the measuring from another thread.
#[derive(Clone, Default)]
pub struct Stop {
    inner: Arc<Mutex<Stopping>>,
}

#[derive(Default)]
struct Stopping {
    asked: bool,
    /// Shown to the owner of the run.
    reason: Option<String>,
    for_now: bool,
    killer: Option<Killer>,
}

impl Stop {
    /// No further question is asked, and the runner under way is killed.
    pub fn stop(&self) {
        self.stop_because(None);
    }

    /// The same, with a reason for the owner of the run; the first reason is kept.
    pub fn stop_because(&self, reason: Option<String>) {
        self.end(reason, false);
    }

    /// The same for work that gives way to other work and begins again later.
    pub fn stop_for_now(&self) {
        self.end(None, true);
    }

    fn end(&self, reason: Option<String>, for_now: bool) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if !inner.asked {
            inner.reason = reason;
        }
        // A final stop wins over one for now, in either order.
        inner.for_now = for_now && (inner.for_now || !inner.asked);
        inner.asked = true;
        if let Some(killer) = &inner.killer {
            killer.kill();
        }
    }

    /// It was asked for, and the work begins again later.
    pub fn for_now(&self) -> bool {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).for_now
    }

    /// Why it was asked for.
    pub fn reason(&self) -> Option<String> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).reason.clone()
    }

    /// Was it asked for?
    pub fn asked(&self) -> bool {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).asked
    }

    /// From now on a stop kills this runner.
    pub(super) fn watch(&self, killer: Option<Killer>) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if let (true, Some(killer)) = (inner.asked, &killer) {
            killer.kill();
        }
        inner.killer = killer;
    }
}
