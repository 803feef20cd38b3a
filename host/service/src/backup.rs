//! Backups: all rows and blobs of a service in one file, and restoring them.
//!
//! A backup is a tar file: first `backup.json` (its format and versions), then `blobs/<sha256>` for each blob, then
//! `rows/<table>.jsonl` with one JSON object for each row, and last `end.json` (the [`End`]); without it, the file was cut off. Rows
//! hold only texts, 64-bit integers and floats, so a backup of SQLite can be restored into PostgreSQL and the other way round.

mod reader;
pub(crate) mod rows;
mod writer;

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::machine::lock_data_folder;
use crate::store::Store;
use crate::{EngineError, Result};

/// Raised when files of this kind cannot be read by older programs.
const FORMAT: u32 = 1;

/// Where a service stores its data.
#[derive(Clone, Debug)]
pub struct Stored {
    /// The data folder.
    pub data: std::path::PathBuf,
    /// As in [`crate::EngineConfig`].
    pub database_url: Option<String>,
    /// As in [`crate::EngineConfig`].
    pub blob_url: Option<String>,
}

/// The first entry of a backup.
#[derive(Debug, Deserialize, Serialize)]
struct Head {
    format: u32,
    /// The version of the program that wrote it.
    program: String,
    /// The newest migration of the database; rows are restored under it, and migrated from there.
    migration: i64,
}

/// The last entry of a backup.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct End {
    /// Number of rows of each table.
    pub rows: BTreeMap<String, u64>,
    /// Number of blobs.
    pub blobs: u64,
    /// Bytes of all blobs.
    pub bytes: u64,
    /// Blobs that the database names, but that could not be read when the backup was made, with the reason.
    pub unreadable: BTreeMap<String, String>,
}

/// Writes a backup to a new file; the service may be running. The rows are those of one moment, and all blobs that they name are
/// included. `told` is called after each blob.
///
/// # Errors
/// `Invalid` when there is nothing to back up or the database belongs to another version; `Fault` when something cannot be read or
/// written. Then there is no file.
pub async fn back_up(stored: &Stored, file: &Path, told: impl FnMut(&End) + Send + 'static) -> Result<End> {
    if stored.database_url.is_none() && !stored.data.join("opencollbench.sqlite").is_file() {
        return Err(EngineError::Invalid(format!("There is no database in {}.", stored.data.display())));
    }
    let store = Store::connect(&stored.data, stored.database_url.as_deref()).await?;
    let blobs = Blobs::open(&stored.data, stored.blob_url.as_deref())?;
    let (file, handle) = (file.to_owned(), tokio::runtime::Handle::current());
    let done = blocking({
        let store = store.clone();
        move || handle.block_on(writer::write(&store, &blobs, &file, told))
    });
    let done = done.await;
    store.close().await;
    done
}

/// Restores a backup into a folder and a database that hold nothing yet. All rows are added in one transaction, at the end.
///
/// # Errors
/// `Invalid` when the file is no whole backup, or when there are data already; `Busy` when a service is running on the folder.
pub async fn restore(stored: &Stored, file: &Path, told: impl FnMut(&End) + Send + 'static) -> Result<End> {
    let data = &stored.data;
    std::fs::create_dir_all(data)
        .map_err(|e| EngineError::Fault(format!("The data folder {} cannot be created: {e}.", data.display())))?;
    let lock = lock_data_folder(data)?;
    let store = Store::connect(data, stored.database_url.as_deref()).await?;
    let blobs = Blobs::open(data, stored.blob_url.as_deref())?;
    let (file, handle) = (file.to_owned(), tokio::runtime::Handle::current());
    let done = blocking({
        let store = store.clone();
        move || handle.block_on(reader::read(&store, &blobs, &file, told))
    });
    let done = done.await;
    store.close().await;
    drop(lock);
    done
}

#[cfg(test)]
mod tests;
