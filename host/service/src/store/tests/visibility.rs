//! Who finds what in lists, on both databases.

use super::super::*;
use super::rows::*;
use super::{add, begin, end, object, run};
use crate::model::{Cursor, OwnedItem, State, Visibility};

pub async fn only_what_is_public_is_in_the_lists_of_others(store: Store) {
    store.add_blob("m", 1, "x").await.unwrap();
    store.add_object(&object("o"), Some("me"), "m").await.unwrap();
    add(&store, run("r", Some("me"), 1, 1)).await;
    assert!(end(&store, &begin(&store, "m").await.unwrap(), State::Done, None).await);
    let listed = async |viewer: Option<&str>| {
        let objects = store.objects_for(viewer, &Cursor::start(), 9).await.unwrap().into_iter().map(|row| row.info.id);
        let runs = store.finished_runs(viewer, 9).await.unwrap().into_iter().map(|row| row.id);
        (objects.collect::<Vec<_>>(), runs.collect::<Vec<_>>())
    };
    for hidden in [Visibility::Unlisted, Visibility::Private] {
        store.set_object_visibility("o", hidden).await.unwrap();
        store.set_run_visibility("r", hidden).await.unwrap();
        assert_eq!(store.object("o").await.unwrap().unwrap().info.visibility, hidden);
        assert_eq!(store.run("r").await.unwrap().unwrap().visibility, hidden);
        assert_eq!(listed(Some("other")).await, (vec![], vec![]));
        assert_eq!(listed(None).await, (vec![], vec![]));
        assert_eq!(listed(Some("me")).await, (vec!["o".to_owned()], vec!["r".to_owned()]));
    }
    store.set_object_visibility("o", Visibility::Public).await.unwrap();
    store.set_run_visibility("r", Visibility::Public).await.unwrap();
    let both = (vec!["o".to_owned()], vec!["r".to_owned()]);
    assert_eq!(listed(Some("other")).await, both);
    assert_eq!(listed(None).await, both);
    let row = store.object("o").await.unwrap().unwrap();
    assert!(row.is_for(None) && row.is_of(Some("me")) && !row.is_of(Some("other")) && !row.is_of(None));
}

pub async fn what_an_object_hid_stays_hidden_without_it(store: Store) {
    let all = [Visibility::Private, Visibility::Unlisted, Visibility::Public];
    for (i, (of_object, of_run)) in all.into_iter().flat_map(|o| all.map(|r| (o, r))).enumerate() {
        let (this, with, by) = (format!("o{i}"), format!("with-{i}"), format!("by-{i}"));
        store.add_blob("m", 1, "x").await.unwrap();
        store.add_object(&object(&this), Some("me"), "m").await.unwrap();
        store.set_object_visibility(&this, of_object).await.unwrap();
        let spec = |a: &str, b: Option<&str>| crate::model::RunSpec {
            object_a: a.into(),
            object_b: b.map(str::to_owned),
            ..run("", None, 1, 1).spec
        };
        let with_it = RunRow { spec: spec("stock:box@500", Some(&this)), ..run(&with, Some("me"), 1, 1) };
        add(&store, with_it).await;
        add(&store, RunRow { spec: spec("stock:box@500", None), ..run(&by, Some("me"), 1, 1) }).await;
        for run in [&with, &by] {
            store.set_run_visibility(run, of_run).await.unwrap();
        }
        let objects = vec![OwnedItem { id: this, name: String::new() }];
        let what = OwnedIds { objects, ..OwnedIds::default() };
        // Looking at what would go changes nothing.
        store.unused_without(&what).await.unwrap();
        assert_eq!(store.run(&with).await.unwrap().unwrap().visibility, of_run);
        store.take_away(&what).await.unwrap();
        assert_eq!(
            store.run(&with).await.unwrap().unwrap().visibility,
            of_run.min(of_object),
            "{of_object:?} {of_run:?}"
        );
        assert_eq!(store.run(&by).await.unwrap().unwrap().visibility, of_run, "a run without it is as it was");
    }
}
