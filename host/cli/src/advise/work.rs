//! The advisor at work: what it does on stderr, until it ends or Ctrl-C stops it.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget};
use ocb_advice::Watch;
use ocb_service::truth::{Machine, MakingWay};

use crate::failure::{Failure, Result};
use crate::serve;

/// Between two looks.
const LOOK_EVERY: Duration = Duration::from_millis(100);
/// Between two plain lines.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// What is done now.
#[derive(Debug, Default)]
pub struct Progress {
    stop: AtomicBool,
    now: Mutex<(String, u64, u64)>,
}

impl Watch for Progress {
    fn step(&self, what: &str, done: u64, total: u64) {
        // Who is waited for does not wait to be looked at.
        if let Ok(mut now) = self.now.try_lock() {
            if now.0 != what {
                what.clone_into(&mut now.0);
            }
            (now.1, now.2) = (done, total);
        }
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Does the work beside the command's other threads.
pub async fn watch<T: Send + 'static>(work: impl FnOnce(&Progress) -> T + Send + 'static) -> Result<T> {
    let machine = Machine::observe()?;
    let mut way = MakingWay::begin(&machine);
    let progress = Arc::new(Progress::default());
    let for_work = progress.clone();
    let mut working = tokio::task::spawn_blocking(move || work(&for_work));
    let mut stop = std::pin::pin!(serve::stop_signal()?);
    let bars = std::io::stderr().is_terminal();
    let target = if bars { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(1), target);
    let mut said = Instant::now();
    let mut look = tokio::time::interval(LOOK_EVERY);
    let done = loop {
        tokio::select! {
            done = &mut working => break done,
            () = &mut stop, if !progress.stopped() => progress.stop.store(true, Ordering::Relaxed),
            _ = look.tick() => {
                way.look();
                let (what, done, total) = progress.now.lock().map(|now| now.clone()).unwrap_or_default();
                bar.set_length(total);
                bar.set_position(done);
                bar.set_message(what.clone());
                if !bars && said.elapsed() >= LINE_EVERY {
                    said = Instant::now();
                    eprintln!("{what}: {done}/{total}");
                }
            }
        }
    };
    bar.finish_and_clear();
    done.map_err(|_| Failure::Fault("the advisor crashed.".to_owned()))
}
