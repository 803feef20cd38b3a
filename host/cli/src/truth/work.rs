//! Long work on all CPUs, with its progress on stderr, until it ends or is stopped.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget};
use ocb_service::truth::{Gauge, Machine, MakingWay};

use crate::failure::{Failure, Result};
use crate::serve;

/// Between two looks at the gauge.
const LOOK_EVERY: Duration = Duration::from_millis(100);
/// Between two plain lines.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Does the work; `None` when Ctrl-C stopped it.
pub async fn watch<T: Send + 'static>(
    what: &str,
    total: usize,
    work: impl FnOnce(&Gauge) -> Option<T> + Send + 'static,
) -> Result<Option<T>> {
    let machine = Machine::observe()?;
    let mut way = MakingWay::begin(&machine);
    let gauge = Arc::new(Gauge::default());
    let for_work = gauge.clone();
    let mut working = tokio::task::spawn_blocking(move || work(&for_work));
    let mut stop = std::pin::pin!(serve::stop_signal()?);
    let bars = std::io::stderr().is_terminal();
    let bar = ProgressBar::with_draw_target(
        Some(total as u64),
        if bars { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() },
    );
    let mut said = Instant::now();
    let mut look = tokio::time::interval(LOOK_EVERY);
    let done = loop {
        tokio::select! {
            done = &mut working => break done,
            () = &mut stop, if !gauge.stop.load(Ordering::Relaxed) => gauge.stop.store(true, Ordering::Relaxed),
            _ = look.tick() => {
                way.look();
                let done = gauge.done.load(Ordering::Relaxed);
                bar.set_position(done);
                if !bars && said.elapsed() >= LINE_EVERY {
                    said = Instant::now();
                    eprintln!("{what}: {done}/{total}");
                }
            }
        }
    };
    bar.finish_and_clear();
    let done = done.map_err(|_| Failure::Fault("the oracle crashed.".to_owned()))?;
    if done.is_none() {
        eprintln!("ocb: Stopped after {} of {total} {what}; nothing was written.", gauge.done.load(Ordering::Relaxed));
    }
    Ok(done)
}
