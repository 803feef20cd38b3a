//! Restoring a backup.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use sqlx::{Any, Transaction};
use tar::{Archive, Entry};

use super::rows::{self, TABLES};
use super::{End, FORMAT, Head};
use crate::blobs::Blobs;
use crate::store::Store;
use crate::{EngineError, Result};

type Part<'a> = Entry<'a, BufReader<File>>;

/// Restores the file into an empty database.
pub(super) async fn read(store: &Store, blobs: &Blobs, file: &Path, mut told: impl FnMut(&End)) -> Result<End> {
    let reader = File::open(file)
        .map_err(|e| EngineError::Invalid(format!("The backup {} cannot be read: {e}.", file.display())))?;
    let mut archive = Archive::new(BufReader::new(reader));
    let mut parts = archive.entries().map_err(|_| damaged("it is no tar file"))?.map(|part| {
        let part = part.map_err(|_| damaged("it is no tar file, or was cut off"))?;
        let name = part.path().ok().and_then(|path| path.to_str().map(str::to_owned));
        Ok::<_, EngineError>((name.ok_or_else(|| damaged("an entry has no name"))?, part))
    });
    let head: Head = match parts.next().transpose()? {
        Some((name, part)) if name == "backup.json" => json(part)?,
        _ => return Err(damaged("it does not begin with backup.json")),
    };
    if head.format != FORMAT || head.migration > Store::newest_migration() {
        let reason = format!("The backup was made by a newer version ({}); use that one to restore it.", head.program);
        return Err(EngineError::Invalid(reason));
    }
    store.migrate_to(head.migration).await?;
    let mut transaction = store.pool.begin().await?;
    if rows::any(&mut transaction).await? {
        let reason = "There are data already; restore into a data folder and a database that hold none.";
        return Err(EngineError::Invalid(reason.to_owned()));
    }
    let (mut found, mut stored, mut end) = (End::default(), BTreeSet::new(), None);
    for part in parts {
        let (name, part) = part?;
        if let Some(sha256) = name.strip_prefix("blobs/") {
            add_blob(blobs, sha256, part, &mut found).await?;
            stored.insert(sha256.to_owned());
            told(&found);
        } else if let Some(table) = TABLES.into_iter().find(|table| name == format!("rows/{table}.jsonl")) {
            let count = add_rows(&mut transaction, table, part).await?;
            found.rows.insert(table.to_owned(), count);
        } else if name == "end.json" {
            end = Some(json::<End>(part)?);
        } else {
            return Err(damaged(&format!("it has an entry {name:?}")));
        }
    }
    let end = end.ok_or_else(|| damaged("it was cut off"))?;
    found.unreadable = end.unreadable.clone();
    let named: Vec<String> = sqlx::query_scalar("SELECT sha256 FROM blobs").fetch_all(&mut *transaction).await?;
    let whole = named.iter().all(|blob| stored.contains(blob) || end.unreadable.contains_key(blob));
    if found != end || !whole {
        return Err(damaged("rows or files are missing"));
    }
    transaction.commit().await?;
    store.migrate_to(Store::newest_migration()).await?;
    Ok(end)
}

async fn add_blob(blobs: &Blobs, sha256: &str, mut part: Part<'_>, found: &mut End) -> Result<()> {
    let mut bytes = Vec::new();
    part.read_to_end(&mut bytes).map_err(|_| damaged("it was cut off"))?;
    found.blobs += 1;
    found.bytes += bytes.len() as u64;
    if blobs.put(bytes).await? == sha256 { Ok(()) } else { Err(damaged("the content of a file was changed")) }
}

async fn add_rows(transaction: &mut Transaction<'_, Any>, table: &str, part: Part<'_>) -> Result<u64> {
    let mut count = 0;
    for line in BufReader::new(part).lines() {
        let line = line.map_err(|_| damaged("it was cut off"))?;
        let row = serde_json::from_str(&line).map_err(|e| damaged(&format!("row {count} of {table}: {e}")))?;
        rows::add(transaction, table, &row).await?;
        count += 1;
    }
    Ok(count)
}

fn json<T: serde::de::DeserializeOwned>(part: Part<'_>) -> Result<T> {
    serde_json::from_reader(part).map_err(|e| damaged(&e.to_string()))
}

fn damaged(what: &str) -> EngineError {
    EngineError::Invalid(format!("This file is no whole backup of OpenCollBench ({what}); nothing was restored."))
}
