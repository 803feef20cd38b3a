//! Writing a backup.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use sqlx::{Any, Transaction};
use tempfile::NamedTempFile;

use super::rows::{self, TABLES};
use super::{End, FORMAT, Head};
use crate::blobs::Blobs;
use crate::store::Store;
use crate::{EngineError, Result};

/// Blobs of rows that were deleted while the backup was made are gone; then the rows are read again, so often.
const MOMENTS: usize = 3;

struct Writer<'a> {
    blobs: &'a Blobs,
    tar: tar::Builder<BufWriter<File>>,
    /// Those that are in the file.
    written: BTreeSet<String>,
    end: End,
}

/// Writes the file beside its place, and moves it there when it is whole.
pub(super) async fn write(store: &Store, blobs: &Blobs, file: &Path, mut told: impl FnMut(&End)) -> Result<End> {
    let migration = match store.migration().await? {
        Some(migration) if migration == Store::newest_migration() => migration,
        _ => {
            let reason = "The database belongs to another version of OpenCollBench; use the `ocb` that serves it.";
            return Err(EngineError::Invalid(reason.to_owned()));
        }
    };
    if file.exists() {
        return Err(EngineError::Invalid(format!("{} exists already; choose another name.", file.display())));
    }
    let part = NamedTempFile::new_in(folder_of(file)).map_err(|e| unwritten(file, &e))?;
    let copy = part.reopen().map_err(|e| unwritten(file, &e))?;
    let tar = tar::Builder::new(BufWriter::new(copy));
    let mut writer = Writer { blobs, tar, written: BTreeSet::new(), end: End::default() };
    writer.json("backup.json", &Head { format: FORMAT, program: env!("CARGO_PKG_VERSION").to_owned(), migration })?;
    let mut moments = 0;
    loop {
        // Most blobs, before a moment has to be held on to.
        let known: Vec<String> = sqlx::query_scalar("SELECT sha256 FROM blobs").fetch_all(&store.pool).await?;
        writer.copy(known, &mut told).await?;
        moments += 1;
        let mut moment = store.pool.begin_with(store.one_moment).await?;
        let named: Vec<String> = sqlx::query_scalar("SELECT sha256 FROM blobs").fetch_all(&mut *moment).await?;
        writer.copy(named.clone(), &mut told).await?;
        writer.end.unreadable.retain(|blob, _| named.contains(blob));
        if writer.end.unreadable.is_empty() || moments == MOMENTS {
            writer.rows(&mut moment, folder_of(file)).await?;
            break;
        }
    }
    let end = writer.end.clone();
    writer.json("end.json", &end)?;
    let copy = writer.tar.into_inner().map_err(|e| unwritten(file, &e))?;
    let copy = copy.into_inner().map_err(|e| unwritten(file, e.error()))?;
    copy.sync_all().map_err(|e| unwritten(file, &e))?;
    part.persist_noclobber(file).map_err(|e| unwritten(file, &e.error))?;
    Ok(end)
}

impl Writer<'_> {
    /// Adds the blobs that are not in the file yet, and notes those that cannot be read.
    async fn copy(&mut self, names: Vec<String>, told: &mut impl FnMut(&End)) -> Result<()> {
        for sha256 in names {
            if self.written.contains(&sha256) {
                continue;
            }
            match self.blobs.get(&sha256).await {
                Ok(bytes) => {
                    self.add(&format!("blobs/{sha256}"), bytes.len() as u64, bytes.as_slice())?;
                    self.end.blobs += 1;
                    self.end.bytes += bytes.len() as u64;
                    self.end.unreadable.remove(&sha256);
                    self.written.insert(sha256);
                    told(&self.end);
                }
                Err(e) => drop(self.end.unreadable.insert(sha256, e.to_string())),
            }
        }
        Ok(())
    }

    async fn rows(&mut self, moment: &mut Transaction<'_, Any>, folder: PathBuf) -> Result<()> {
        for table in TABLES {
            // A tar file says how long an entry is before it.
            let mut lines = BufWriter::new(tempfile::tempfile_in(&folder).map_err(|e| unwritten(&folder, &e))?);
            let count = rows::read(moment, table, |row| {
                let line = serde_json::to_string(row).map_err(|e| EngineError::fault("Writing a row failed", e))?;
                writeln!(lines, "{line}").map_err(|e| unwritten(&folder, &e))
            });
            self.end.rows.insert(table.to_owned(), count.await?);
            let mut lines = lines.into_inner().map_err(|e| unwritten(&folder, e.error()))?;
            let bytes = lines.stream_position().map_err(|e| unwritten(&folder, &e))?;
            lines.rewind().map_err(|e| unwritten(&folder, &e))?;
            self.add(&format!("rows/{table}.jsonl"), bytes, lines)?;
        }
        Ok(())
    }

    fn json(&mut self, name: &str, value: &impl serde::Serialize) -> Result<()> {
        let text = serde_json::to_vec_pretty(value).map_err(|e| EngineError::fault("Writing JSON failed", e))?;
        self.add(name, text.len() as u64, text.as_slice())
    }

    fn add(&mut self, name: &str, bytes: u64, content: impl std::io::Read) -> Result<()> {
        let mut header = tar::Header::new_gnu();
        header.set_size(bytes);
        // Passwords' hashes and addresses are in it.
        header.set_mode(0o600);
        self.tar.append_data(&mut header, name, content).map_err(|e| unwritten(Path::new(name), &e))
    }
}

fn folder_of(file: &Path) -> PathBuf {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).map_or_else(|| PathBuf::from("."), Path::to_owned)
}

fn unwritten(file: &Path, e: &std::io::Error) -> EngineError {
    EngineError::Fault(format!("The backup cannot be written ({}): {e}.", file.display()))
}
