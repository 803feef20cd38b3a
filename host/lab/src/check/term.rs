//! How long a check may take, and how it is ended before: by its limit, or because the service or somebody stops it.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use ocb_sandbox::Killer;

use crate::measure::Stop;
use crate::{LabError, Result};

/// Time of a whole check. A plugin whose questions take milliseconds needs two minutes for each algorithm at most; the
/// others who wait for theirs are held up no longer than this.
pub const CHECK_LIMIT: Duration = Duration::from_secs(600);
/// How often the watcher looks: well below the second within which a stop is obeyed, and too seldom to disturb a clock.
const LOOK: Duration = Duration::from_millis(50);

/// The limit of a check under way, and its stop.
pub struct Term<'c> {
    stop: &'c Stop,
    limit: Duration,
    ends: Instant,
    /// The runner under way, and when its part of the limit ends.
    runner: Mutex<Option<(Instant, Killer)>>,
}

impl<'c> Term<'c> {
    /// From now on.
    pub fn new(stop: &'c Stop, limit: Duration) -> Self {
        Self { stop, limit, ends: Instant::now() + limit, runner: Mutex::new(None) }
    }

    /// When it ends.
    pub fn ends(&self) -> Instant {
        self.ends
    }

    /// Nobody wants the report any more.
    pub fn is_stopped(&self) -> bool {
        self.stop.asked()
    }

    /// Ends the next runner at this moment, or with the check. At most one runner is at work.
    pub fn killer(&self, until: Instant) -> Killer {
        let killer = Killer::default();
        *self.runner.lock().unwrap_or_else(PoisonError::into_inner) = Some((until.min(self.ends), killer.clone()));
        killer
    }

    /// Does the work while the runners that it starts are watched.
    pub fn watch<T>(&self, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let (working, done) = channel::<()>();
        thread::scope(|scope| {
            let watcher = thread::Builder::new().name("check's watcher".into()).spawn_scoped(scope, move || {
                while done.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                    self.look();
                }
            });
            watcher.map_err(|e| LabError::fault("Starting the check's watcher failed", e))?;
            // Dropped when the work ends, also by a panic.
            let _working = working;
            work()
        })
    }

    fn look(&self) {
        let runner = self.runner.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((until, killer)) = &*runner
            && (self.stop.asked() || Instant::now() >= *until)
        {
            killer.kill();
        }
    }

    /// The limit in words.
    pub fn words(&self) -> String {
        match self.limit.as_secs() {
            seconds if seconds >= 60 && seconds % 60 == 0 => format!("{} minutes", seconds / 60),
            _ => format!("{} seconds", self.limit.as_secs_f64()),
        }
    }
}

/// The end of an equal share for each of those that are left.
pub fn share(ends: Instant, left: usize) -> Instant {
    let now = Instant::now();
    now + ends.saturating_duration_since(now) / u32::try_from(left.max(1)).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_shared_equally() {
        let ends = Instant::now() + Duration::from_secs(64);
        let first = share(ends, 64).saturating_duration_since(Instant::now());
        assert!(first > Duration::from_millis(900) && first <= Duration::from_secs(1), "{first:?}");
        assert!(share(Instant::now(), 3) <= Instant::now());
        assert!(share(ends, 0) <= ends);
    }

    #[test]
    fn the_limit_is_said_in_words() {
        let stop = Stop::default();
        assert_eq!(Term::new(&stop, CHECK_LIMIT).words(), "10 minutes");
        assert_eq!(Term::new(&stop, Duration::from_millis(1500)).words(), "1.5 seconds");
    }
}
