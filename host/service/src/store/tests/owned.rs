//! What an owner has, and taking it away, on both databases.

use super::super::*;
use super::rows::*;
use super::{add, advice_info, begin, end, handed, object, result, run, set_info, worker};
use crate::model::{OwnedItem, State};
use crate::owned::sql::Unused;
use crate::runs::accept::Handed;

pub async fn what_is_taken_away_takes_the_files_that_nobody_else_uses(store: Store) {
    for (file, bytes) in [("mesh", 10), ("set", 20), ("records", 30), ("paper", 40), ("proof", 50)] {
        store.add_blob(file, bytes, "x").await.unwrap();
    }
    store.add_object(&object("o"), Some("me"), "mesh").await.unwrap();
    store.add_object(&object("p"), Some("other"), "mesh").await.unwrap();
    store.keep_set("k", &set_info(), "set", 1, 1.0).await.unwrap();
    for (id, owner, of) in [("r", "me", "o"), ("s", "other", "o"), ("t", "me", "p")] {
        let mut row = run(id, Some(owner), 1, 1);
        row.spec.object_a = of.to_owned();
        add(&store, row).await;
    }
    let stored = StoredResult { records: Some("records".into()), ..result("a", 1) };
    let measured = Handed { results: vec![(0, stored)], ..handed() };
    while let Some(attempt) = begin(&store, "m").await {
        assert!(store.set_of_run(&attempt, &set_info(), "set").await.unwrap());
        assert!(end(&store, &attempt, State::Done, Some(&measured).filter(|_| attempt.job == "r")).await);
    }
    let mut info = advice_info("v");
    info.spec.object_a = "o".to_owned();
    assert!(store.add_advice(&info, Some("me"), "turn").await.unwrap());
    let (attempt, _) = store.begin_advice(false, &worker("m")).await.unwrap().unwrap();
    let paper = StoredPaper { mesh: "paper".into(), certificate: "proof".into(), file: "f.obj".into() };
    assert!(store.end_advice(&attempt, &info, &[vec![paper], vec![]]).await.unwrap());

    let with_object = store.owned_ids("me", Some("o")).await.unwrap();
    let ids = |things: &[OwnedItem]| things.iter().map(|thing| thing.id.clone()).collect::<Vec<_>>();
    assert_eq!((ids(&with_object.runs), ids(&with_object.objects)), (vec!["r".to_owned()], vec!["o".to_owned()]));
    assert_eq!(with_object.advice, ["v"]);
    assert_eq!(store.owned_ids("me", None).await.unwrap().runs.len(), 2);
    assert_eq!(store.owners().await.unwrap().len(), 2);
    assert!(store.last_wanted("me").await.unwrap() > Some(1) && store.last_wanted("nobody").await.unwrap().is_none());
    let before = store.last_wanted("me").await.unwrap();
    store.keep_longer("me").await.unwrap();
    store.keep_longer("me").await.unwrap();
    assert!(store.last_wanted("me").await.unwrap() > before);

    let unused = |sha256: &str, bytes| Unused { sha256: sha256.into(), bytes };
    let expected = [unused("paper", 40), unused("proof", 50), unused("records", 30)];
    assert_eq!(store.unused_without(&with_object).await.unwrap(), expected, "the mesh and the set are others', too");
    assert!(store.run("r").await.unwrap().is_some() && store.set("k").await.unwrap().is_some());
    assert_eq!(store.take_away(&with_object).await.unwrap(), expected);
    assert!(store.run("r").await.unwrap().is_none() && store.object("o").await.unwrap().is_none());
    assert!(store.advice("v").await.unwrap().is_none() && store.results("r").await.unwrap().is_empty());
    assert!(store.run("s").await.unwrap().is_some() && store.run("t").await.unwrap().is_some());
    // With the last run that has it the set goes, with the last object the mesh.
    for (owner, left) in [("me", vec![]), ("other", vec![unused("mesh", 10), unused("set", 20)])] {
        let all = store.owned_ids(owner, None).await.unwrap();
        assert_eq!(store.unused_without(&all).await.unwrap(), left);
        assert_eq!(store.take_away(&all).await.unwrap(), left);
    }
    assert!(store.set("k").await.unwrap().is_none() && store.owners().await.unwrap().is_empty());
    let left: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM attempts").fetch_one(&store.pool).await.unwrap();
    assert_eq!(left, 0, "attempts go with what they tried");
}

#[tokio::test]
async fn looking_at_ones_things_waits_for_no_writer() {
    let (store, _folder) = super::sqlite().await;
    add(&store, run("r", Some("me"), 1, 1)).await;
    let mut writer = store.pool.begin().await.unwrap();
    sqlx::query("UPDATE runs SET attempts = 1").execute(&mut *writer).await.unwrap();
    let look = async { store.unused_without(&store.owned_ids("me", None).await.unwrap()).await };
    let looked = tokio::time::timeout(std::time::Duration::from_secs(5), look).await;
    assert_eq!(looked.expect("it waited for the writer").unwrap(), []);
    writer.rollback().await.unwrap();
}
