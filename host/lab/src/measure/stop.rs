//! Stopping a measurement from another thread, and how long it has taken.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use ocb_sandbox::Killer;

use crate::Result;
use crate::machine::MeasuringRight;

/// Ends the measuring from another thread, and knows for how long it has worked.
#[derive(Clone)]
pub struct Stop {
    begun: Instant,
    inner: Arc<Mutex<Stopping>>,
}

impl Default for Stop {
    /// The work begins now.
    fn default() -> Self {
        Self { begun: Instant::now(), inner: Arc::default() }
    }
}

#[derive(Default)]
struct Stopping {
    asked: bool,
    /// Shown to the owner of the run.
    reason: Option<String>,
    for_now: bool,
    killer: Option<Killer>,
    waited: Duration,
    waiting_since: Option<Instant>,
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
        let mut inner = self.lock();
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
        self.lock().for_now
    }

    /// Why it was asked for.
    pub fn reason(&self) -> Option<String> {
        self.lock().reason.clone()
    }

    /// Was it asked for?
    pub fn asked(&self) -> bool {
        self.lock().asked
    }

    /// From now on a stop kills this runner.
    pub(crate) fn watch(&self, killer: Option<Killer>) {
        let mut inner = self.lock();
        if let (true, Some(killer)) = (inner.asked, &killer) {
            killer.kill();
        }
        inner.killer = killer;
    }

    /// Waits until no other process measures on this machine; `None` when stopped. `waits` is called once if it has to wait.
    pub fn right_to_measure(&self, waits: impl FnOnce()) -> Result<Option<MeasuringRight>> {
        self.lock().waiting_since = Some(Instant::now());
        let right = MeasuringRight::wait(|| self.asked(), waits);
        let mut inner = self.lock();
        let waited = inner.waiting_since.take().map(|since| since.elapsed());
        inner.waited += waited.unwrap_or_default();
        right
    }

    /// Time since the work began, without that in which others measured.
    pub fn worked(&self) -> Duration {
        let inner = self.lock();
        let waits = inner.waiting_since.map(|since| since.elapsed());
        self.begun.elapsed().saturating_sub(inner.waited + waits.unwrap_or_default())
    }

    fn lock(&self) -> MutexGuard<'_, Stopping> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
