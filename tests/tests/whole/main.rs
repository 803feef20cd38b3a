//! The service as a whole: what its API says of itself, many visitors at once and what they leave unchanged, slow and hostile
//! ones, and SIGKILL.

mod api;
mod hostile;
mod kills;
mod load;
mod slow;
mod unchanged;

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Tests that keep the machine busy go one after the other: side by side they would measure each other's patience.
static BUSY: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    BUSY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// An empty data folder.
fn empty(name: &str) -> PathBuf {
    let data = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if data.exists() {
        std::fs::remove_dir_all(&data).expect("the folder of the last time goes");
    }
    data
}

/// How often or how long, as the environment says.
fn asked(variable: &str, otherwise: u64) -> u64 {
    let text = std::env::var(variable).unwrap_or_default();
    if text.is_empty() { otherwise } else { text.parse().unwrap_or_else(|_| panic!("{variable}={text} is no number")) }
}
