//! Lists part by part, on both databases.

use super::super::*;
use super::people::account;
use super::rows::*;
use super::{add, object, run};
use crate::model::{Cursor, ObjectInfo, Page, Part, PluginState};

pub async fn lists_go_on_where_they_were_left(store: Store) {
    store.add_blob("m", 1, "x").await.unwrap();
    // Some of the same moment, some of others.
    for (id, created_us) in [("a", 5), ("b", 5), ("c", 5), ("d", 4), ("e", 6)] {
        add(&store, run(id, Some("me"), 1, created_us)).await;
        add(&store, run(&format!("not {id}"), Some("other"), 1, created_us)).await;
        let info = ObjectInfo { created_us, ..object(id) };
        store.add_object(&info, Some("me"), "m").await.unwrap();
    }
    let expected = ["e", "c", "b", "a", "d"];
    for most in 1..=6 {
        let (mut runs, mut objects) = (Vec::new(), Vec::new());
        let (mut of_runs, mut of_objects) = (Cursor::start(), Cursor::start());
        loop {
            let rows = store.runs_of("me", &of_runs, most).await.unwrap();
            let infos = store.objects_for(Some("me"), &of_objects, most).await.unwrap();
            let (Some(run), Some(object)) = (rows.last(), infos.last()) else { break };
            of_runs = Cursor::behind(run.created_us, &run.id);
            of_objects = Cursor::behind(object.info.created_us, &object.info.id);
            runs.extend(rows.into_iter().map(|row| row.id));
            objects.extend(infos.into_iter().map(|row| row.info.id));
        }
        assert_eq!((&runs[..], &objects[..]), (&expected.map(str::to_owned)[..], &expected.map(str::to_owned)[..]));
    }
}

/// A plugin of this account in this state.
fn plugin(id: &str, account: &str, state: PluginState, created_us: i64, changed_us: i64) -> PluginRow {
    let manifest = serde_json::json!({ "name": "n", "version": "1", "authors": "a", "license": "MIT", "queries": [] });
    PluginRow {
        id: id.into(),
        account: account.into(),
        blob: format!("file {}", id.trim_start_matches("twin of ")),
        file: "f.so".into(),
        bytes: 1,
        manifest: serde_json::from_value(manifest).unwrap(),
        signed_by: None,
        state,
        reason: String::new(),
        hardware_class: None,
        excluded_on: None,
        algorithms: Vec::new(),
        created_us,
        changed_us,
    }
}

/// The ids of a list, by parts of this size.
async fn walked(
    limit: usize,
    load: impl AsyncFn(&Cursor, usize) -> Result<Vec<PluginRow>>,
    place: impl Fn(&PluginRow) -> Cursor,
) -> Vec<String> {
    let (mut from, mut ids) = (Cursor::start(), Vec::new());
    loop {
        let part = Part::of(load(&from, limit + 1).await.unwrap(), limit, &place);
        assert!(part.entries.len() == limit || part.next.is_none(), "a part in the middle is full");
        ids.extend(part.entries.into_iter().map(|row| row.id));
        let Some(next) = part.next else { return ids };
        from = next;
    }
}

pub async fn lists_of_plugins_are_whole_and_in_order(store: Store) {
    let note = Note { actor: "ada", action: "did", subject: "x", detail: "" };
    for (id, name) in [("1", "ada"), ("2", "bob")] {
        assert!(store.add_account(&account(id, name), "hash").await.unwrap());
    }
    // Every state of both accounts, often at the same moment, and in another order of changes than of making.
    let mut all = Vec::new();
    for number in 0..440_i64 {
        let state = PluginState::NAMES[number as usize % 11].0;
        let account = if number / 11 % 2 == 0 { "1" } else { "2" };
        let id = format!("{:03}", number * 7 % 440);
        all.push(plugin(&id, account, state, number / 3, (number * 13) % 50));
    }
    all.push(plugin(&format!("twin of {}", all[0].id), "2", PluginState::Failed, 1, 1));
    for row in &all {
        store.add_blob(&row.blob, 1, "x").await.unwrap();
        assert!(store.add_plugin(row, note).await.unwrap());
    }
    let most = Page::default().limit as usize;
    for viewer in [None, Some("1"), Some("2"), Some("nobody")] {
        let may = |row: &&PluginRow| row.state.is_shown() || viewer == Some(row.account.as_str());
        let place = |row: &PluginRow| Cursor::behind(row.created_us, &row.id);
        let mut expected: Vec<&PluginRow> = all.iter().filter(may).collect();
        expected.sort_by_key(|row| std::cmp::Reverse(place(row)));
        let expected: Vec<String> = expected.into_iter().map(|row| row.id.clone()).collect();
        assert!(expected.len() >= 160 && (viewer != Some("1") || expected.len() > most), "more than a part");
        for limit in [most, 7] {
            let load = async |from: &Cursor, limit| store.plugins_for(viewer, from, limit).await;
            assert_eq!(walked(limit, load, place).await, expected, "{viewer:?}, {limit} at a time");
        }
    }
    let waits = |row: &&PluginRow| matches!(row.state, PluginState::Awaiting | PluginState::Asked);
    let mut expected: Vec<&PluginRow> = all.iter().filter(waits).collect();
    expected.sort_by_key(|row| (row.changed_us, std::cmp::Reverse(row.id.clone())));
    let expected: Vec<String> = expected.into_iter().map(|row| row.id.clone()).collect();
    assert_eq!(expected.len(), 80);
    for limit in [1, 30, 200] {
        let load = async |from: &Cursor, limit| store.waiting_plugins(from, limit).await;
        let place = |row: &PluginRow| Cursor::behind(-row.changed_us, &row.id);
        assert_eq!(walked(limit, load, place).await, expected, "{limit} at a time");
    }

    let published = store.published_by("1").await.unwrap();
    assert!(published.len() == 80 && published.iter().all(|row| row.account == "1" && row.state.is_shown()));
    assert!(published.is_sorted_by_key(|row| std::cmp::Reverse((row.created_us, row.id.clone()))));
    let twins = async |row: &PluginRow| store.twins(&row.blob, &row.account).await.unwrap();
    assert_eq!((twins(&all[0]).await, twins(&all[1]).await, twins(all.last().unwrap()).await), (1, 0, 1));
}
