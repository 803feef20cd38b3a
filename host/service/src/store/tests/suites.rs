//! Suites and their runs, on both databases.

use super::super::*;
use super::rows::*;
use super::{add, run};
use crate::suite::Suite;

pub async fn a_suites_runs_are_apart_from_those_of_people(store: Store) {
    let suite = Suite::open(None).unwrap();
    assert!(store.suites().await.unwrap().is_empty());
    for _ in 0..2 {
        assert!(store.keep_suite(&suite).await.unwrap());
    }
    let changed = Suite::read(&suite.text.replace("\"passes\": 5,", "\"passes\": 6,")).unwrap();
    assert!(!store.keep_suite(&changed).await.unwrap(), "another suite of the same version");
    let kept = store.suites().await.unwrap();
    assert_eq!(kept.len(), 1);
    assert_eq!((&kept[0].sha256, &kept[0].document), (&suite.sha256, &suite.document));

    let of_suite = |id: &str, created_us| RunRow {
        suite: Some(suite.sha256.clone()),
        visibility: crate::model::Visibility::Public,
        ..run(id, None, 5, created_us)
    };
    for (id, created_us) in [("done", 1), ("failed", 2), ("waits", 3)] {
        add(&store, of_suite(id, created_us)).await;
    }
    add(&store, RunRow { visibility: crate::model::Visibility::Public, ..run("public", None, 1, 4) }).await;
    use crate::model::State;
    for (id, end) in [("done", State::Done), ("failed", State::Failed), ("public", State::Done)] {
        assert!(store.end_waiting_run(id, end, None).await.unwrap());
    }
    let ids = |rows: Vec<RunRow>| rows.into_iter().map(|row| row.id).collect::<Vec<_>>();
    assert_eq!(ids(store.suite_runs().await.unwrap()), ["waits", "done"]);
    assert_eq!(ids(store.finished_runs(None, 9).await.unwrap()), ["public"]);
    assert_eq!(store.run("done").await.unwrap().unwrap().suite, Some(suite.sha256));
}
