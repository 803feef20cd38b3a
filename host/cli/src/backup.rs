//! `ocb backup` and `ocb restore`: everything that a service has stored, as one file.

use std::path::Path;
use std::process::ExitCode;

use indicatif::ProgressBar;
use ocb_service::backup::{self, End, Stored};

use crate::args::Store;
use crate::failure::Result;
use crate::{open, output, units};

/// Writes a backup.
pub async fn back_up(store: &Store, file: &Path, json: bool) -> Result<ExitCode> {
    let end = backup::back_up(&stored(store)?, file, progress()).await?;
    for (blob, reason) in &end.unreadable {
        eprintln!("ocb: WARNING: The file {blob} is not in the backup: {reason}");
    }
    let code = if end.unreadable.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    show("Backed up", &end, json)?;
    Ok(code)
}

/// Restores one.
pub async fn restore(store: &Store, file: &Path, json: bool) -> Result<ExitCode> {
    let end = backup::restore(&stored(store)?, file, progress()).await?;
    show("Restored", &end, json)?;
    Ok(ExitCode::SUCCESS)
}

fn stored(store: &Store) -> Result<Stored> {
    Ok(Stored { data: open::data(store)?, database_url: store.database.clone(), blob_url: store.blobs.clone() })
}

/// Shows on a terminal how far it is.
fn progress() -> impl FnMut(&End) + Send + 'static {
    let bar = ProgressBar::new_spinner();
    move |end| {
        bar.set_message(format!("{} files, {}", end.blobs, units::bytes(end.bytes)));
        bar.tick();
    }
}

fn show(what: &str, end: &End, json: bool) -> Result<()> {
    if json {
        return output::print_json(end);
    }
    let rows: u64 = end.rows.values().sum();
    output::print(&format!("{what}: {rows} rows, {} files of {}.", end.blobs, units::bytes(end.bytes)))
}
