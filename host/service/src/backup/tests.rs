//! Backing up and restoring, with both kinds of database.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::rows::TABLES;
use super::*;
use crate::model::State;
use crate::store::tests::deletion::somebody;
use crate::store::tests::fixtures::{add, begin, end, handed, run};
use crate::store::tests::{postgres_url, row_counts};

fn in_folder(data: PathBuf) -> Stored {
    Stored { data, database_url: None, blob_url: None }
}

async fn open(stored: &Stored) -> Store {
    std::fs::create_dir_all(&stored.data).unwrap();
    Store::open(&stored.data, stored.database_url.as_deref()).await.unwrap()
}

/// Rows of an account and of a run, and one blob with content; the others that the rows name were never stored. Gives its name.
async fn filled(stored: &Stored) -> String {
    let store = open(stored).await;
    somebody(&store, "1", "ada").await;
    let blobs = Blobs::open(&stored.data, None).unwrap();
    let blob = blobs.put(b"a mesh".to_vec()).await.unwrap();
    store.add_blob(&blob, 6, "x").await.unwrap();
    add(&store, run("run", Some("me"), 0, 1)).await;
    let attempt = begin(&store, "m").await.unwrap();
    let mut handed = handed();
    handed.results[0].1.records = Some(blob.clone());
    handed.results[0].1.seconds_per_query = Some(0.1 + 0.2);
    assert!(end(&store, &attempt, State::Done, Some(&handed)).await);
    store.close().await;
    blob
}

#[tokio::test]
async fn what_was_stored_is_restored_into_either_database() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let first = in_folder(path("first"));
    let blob = filled(&first).await;
    let end = back_up(&first, &path("1.tar"), |_| {}).await.unwrap();
    assert_eq!((end.blobs, end.bytes, end.rows["runs"]), (1, 6, 3));
    assert!(!end.unreadable.is_empty() && !end.unreadable.contains_key(&blob), "{end:?}");

    let second = Stored { database_url: Some(postgres_url("").await), ..in_folder(path("second")) };
    let third = in_folder(path("third"));
    assert_eq!(restore(&second, &path("1.tar"), |_| {}).await.unwrap(), end);
    assert_eq!(back_up(&second, &path("2.tar"), |_| {}).await.unwrap(), end);
    assert_eq!(restore(&third, &path("2.tar"), |_| {}).await.unwrap(), end);

    let (first, third) = (open(&first).await, open(&third).await);
    assert_eq!(row_counts(&third).await, row_counts(&first).await);
    assert_eq!(third.run("run").await.unwrap(), first.run("run").await.unwrap());
    assert_eq!(third.results("run").await.unwrap(), first.results("run").await.unwrap());
    assert_eq!(third.account("1").await.unwrap(), first.account("1").await.unwrap());
    assert_eq!(Blobs::open(&path("third"), None).unwrap().get(&blob).await.unwrap(), b"a mesh");
}

#[tokio::test]
async fn a_backup_has_all_tables() {
    let folder = tempfile::tempdir().unwrap();
    let store = open(&in_folder(folder.path().into())).await;
    let text = "SELECT name FROM sqlite_master WHERE type = 'table' AND name <> '_sqlx_migrations'";
    let tables: Vec<String> = sqlx::query_scalar(text).fetch_all(&store.pool).await.unwrap();
    let known: BTreeSet<&str> = TABLES.into_iter().collect();
    assert_eq!(tables.iter().map(String::as_str).collect::<BTreeSet<_>>(), known);
}

#[tokio::test]
async fn a_restore_is_whole_or_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let (from, into) = (in_folder(path("from")), in_folder(path("into")));
    filled(&from).await;
    back_up(&from, &path("whole.tar"), |_| {}).await.unwrap();
    let refused = |reason: EngineError| assert!(matches!(reason, EngineError::Invalid(_)), "{reason:?}");
    refused(back_up(&from, &path("whole.tar"), |_| {}).await.unwrap_err());
    refused(back_up(&in_folder(path("none")), &path("none.tar"), |_| {}).await.unwrap_err());

    let whole = std::fs::read(path("whole.tar")).unwrap();
    let mut changed = whole.clone();
    let at = whole.windows(6).position(|bytes| bytes == b"a mesh").unwrap();
    changed[at] = b'A';
    let newer = String::from_utf8_lossy(&whole).replace("\"format\": 1", "\"format\": 2");
    for (name, bytes) in
        [("cut", &whole[..whole.len() / 2]), ("changed", &changed), ("newer", newer.as_bytes()), ("none", b"")]
    {
        std::fs::write(path(name), bytes).unwrap();
        refused(restore(&into, &path(name), |_| {}).await.unwrap_err());
        let store = open(&into).await;
        assert_eq!(row_counts(&store).await, [0; 5], "{name}");
        store.close().await;
    }
    restore(&into, &path("whole.tar"), |_| {}).await.unwrap();
    // There is something now.
    refused(restore(&into, &path("whole.tar"), |_| {}).await.unwrap_err());
}
