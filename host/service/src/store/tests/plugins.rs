//! Plugins that developers bring, on both databases.

use super::super::*;
use super::people::{NOTE, account};
use super::rows::*;
use super::worker;
use crate::attempts::Attempt;
use crate::model::{CheckLine, CheckVerdict, Cursor, NoticeInfo, PluginState};
use crate::plugins::checks_sql::CheckEnd;

pub(crate) fn plugin(id: &str, account: &str, blob: &str) -> PluginRow {
    let manifest = serde_json::from_value(serde_json::json!({
        "name": "n", "version": "1", "authors": "a", "license": "MIT", "queries": ["proximity"]
    }));
    PluginRow {
        id: id.into(),
        account: account.into(),
        blob: blob.into(),
        file: "f.so".into(),
        bytes: 1,
        manifest: manifest.unwrap(),
        signed_by: None,
        state: PluginState::Uploaded,
        reason: String::new(),
        hardware_class: None,
        excluded_on: None,
        algorithms: Vec::new(),
        created_us: 1,
        changed_us: 1,
    }
}

pub async fn a_plugin_is_checked_three_times_at_most(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_blob("f", 1, "x").await.unwrap();
    let row = PluginRow { signed_by: Some("RWkey".into()), ..plugin("p", "1", "f") };
    assert!(store.add_plugin(&row, NOTE).await.unwrap());
    assert!(!store.add_plugin(&PluginRow { id: "q".into(), ..row.clone() }, NOTE).await.unwrap());
    assert_eq!(store.notes_on("x").await.unwrap().len(), 1, "what did not happen is not noted");
    assert_eq!(store.plugin("p").await.unwrap().as_ref(), Some(&row));
    assert_eq!(store.plugin_of("1", "f").await.unwrap().as_ref(), Some(&row));
    store.sign_plugin("p", "RWother", NOTE).await.unwrap();
    let row = PluginRow { signed_by: Some("RWother".into()), ..row };
    let line =
        CheckLine { check: "c".into(), verdict: CheckVerdict::Pass, evidence: "e".into(), hint: None, repro: None };
    let me = worker("m");
    let begun = || async { store.begin_check(&me).await.unwrap() };
    let (attempt, claimed) = begun().await.unwrap();
    assert_eq!(claimed, row);
    assert!(store.put_back_check(&attempt).await.unwrap());
    for _ in 0..3 {
        let (attempt, claimed) = begun().await.unwrap();
        assert_eq!((claimed.id.as_str(), begun().await), ("p", None));
        // Lines of an earlier attempt are gone.
        assert!(store.add_line(&attempt, 1, &line).await.unwrap());
        assert_eq!(store.lines("p").await.unwrap(), std::slice::from_ref(&line));
        assert!(store.note_vetted(&attempt).await.unwrap());
        assert_eq!(store.plugin("p").await.unwrap().unwrap().state, PluginState::Vetted);
        assert_eq!(store.checks_to_give_up().await.unwrap(), []);
        assert!(store.lose_check(&attempt, Some(&me)).await.unwrap());
    }
    // Lost three times it is given up, as often as that is asked for.
    for _ in 0..2 {
        assert_eq!(begun().await, None);
        let given_up = store.checks_to_give_up().await.unwrap();
        assert!(matches!(&given_up[..], [row] if row.id == "p" && row.state == PluginState::Uploaded), "{given_up:?}");
    }
    assert!(store.move_plugin("p", PluginState::Uploaded, PluginState::Failed, "", None, Some(NOTE)).await.unwrap());
    assert_eq!(store.checks_to_give_up().await.unwrap(), []);
    assert_eq!(store.notes_on("x").await.unwrap().len(), 3);

    // Taken out on another class while it is public, unless somebody has decided since it failed.
    let public = |from| store.move_plugin("p", from, PluginState::Public, "", None, None);
    let out = |failed_us| store.exclude_plugin("p", "other", failed_us, None, Note { detail: "why", ..NOTE });
    assert!(!out(now_us() + 1_000_000).await.unwrap(), "it is not public");
    assert!(public(PluginState::Failed).await.unwrap());
    assert!(!out(1).await.unwrap(), "it failed before it was decided about");
    assert!(out(now_us() + 1_000_000).await.unwrap());
    let row = store.plugin("p").await.unwrap().unwrap();
    assert_eq!(
        (row.state, row.reason.as_str(), row.excluded_on.as_deref()),
        (PluginState::Excluded, "why", Some("other"))
    );
    assert_eq!(store.notes_on("x").await.unwrap().len(), 4);
    assert!(public(PluginState::Excluded).await.unwrap());
    assert_eq!(store.plugin("p").await.unwrap().unwrap().excluded_on, None);
}

pub async fn a_decision_and_its_notice_stand_or_fall_together(store: Store) {
    assert!(store.add_account(&account("1", "ada"), "hash").await.unwrap());
    store.add_blob("f", 1, "x").await.unwrap();
    assert!(store.add_plugin(&plugin("p", "1", "f"), NOTE).await.unwrap());
    let notice: NoticeInfo = serde_json::from_value(serde_json::json!({
        "id": "n", "subject": "s", "text": "t", "link": "/p/p", "created_us": 1, "read_us": null,
    }))
    .unwrap();
    let new_notice = NewNotice { account: "1", notice: &notice, most: 9, mailing: true };
    let decide = |from, to| store.move_plugin("p", from, to, "why", Some(new_notice), Some(NOTE));
    let told = async || store.notices("1", &Cursor::start(), 9).await.unwrap().len();
    assert!(!decide(PluginState::Awaiting, PluginState::Public).await.unwrap());
    assert_eq!(told().await, 0, "of what did not happen nobody is told");
    assert!(decide(PluginState::Uploaded, PluginState::Public).await.unwrap());
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (1, 2));
    // The notice cannot be kept, because there is one of this id: then nothing was decided, and nothing noted.
    decide(PluginState::Public, PluginState::Suspended).await.unwrap_err();
    store.exclude_plugin("p", "class", i64::MAX, Some(new_notice), NOTE).await.unwrap_err();
    assert_eq!(store.plugin("p").await.unwrap().unwrap().state, PluginState::Public);
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (1, 2));
    let another = NoticeInfo { id: "m".into(), ..notice.clone() };
    let new_notice = NewNotice { notice: &another, ..new_notice };
    assert!(store.exclude_plugin("p", "class", i64::MAX, Some(new_notice), NOTE).await.unwrap());
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (2, 3));
}

pub async fn a_state_and_its_history_are_of_one_moment(store: Store) {
    assert!(store.add_account(&account("1", "ada"), "hash").await.unwrap());
    store.add_blob("f", 1, "x").await.unwrap();
    let uploaded = Note { action: "uploaded", subject: "p", ..NOTE };
    assert!(store.add_plugin(&plugin("p", "1", "f"), uploaded).await.unwrap());
    // Somebody moves it until both readers have seen it at so many moments. Who looked once for a state and then for a
    // history would see a step between them.
    let reading = std::cell::Cell::new(2);
    let mover = async || {
        let mut from = PluginState::Uploaded;
        while reading.get() > 0 {
            let to = if from == PluginState::Public { PluginState::Suspended } else { PluginState::Public };
            let note = Note { action: to.name(), ..uploaded };
            assert!(store.move_plugin("p", from, to, "", None, Some(note)).await.unwrap());
            from = to;
        }
    };
    let reader = async || {
        let mut moments = std::collections::BTreeSet::new();
        while moments.len() < 40 {
            let (row, _, history) = store.whole_plugin("p").await.unwrap().unwrap();
            assert_eq!(history.last().unwrap().action, row.state.name(), "after {} steps", history.len());
            moments.insert(history.len());
        }
        reading.set(reading.get() - 1);
    };
    futures::join!(mover(), reader(), reader());
    assert_eq!(store.whole_plugin("q").await.unwrap(), None);
}

pub async fn authors_take_turns_with_their_checks(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_account(&account("2", "bob"), "hash").await.unwrap();
    for (id, of, created_us) in [("a", "1", 1), ("b", "1", 2), ("c", "1", 3), ("d", "2", 4), ("e", "2", 5)] {
        store.add_blob(id, 1, "x").await.unwrap();
        let row = PluginRow { created_us, ..plugin(id, of, id) };
        assert!(store.add_plugin(&row, NOTE).await.unwrap());
    }
    let mut order = String::new();
    while let Some((attempt, row)) = store.begin_check(&worker("m")).await.unwrap() {
        order += &row.id;
        assert!(store.move_plugin(&row.id, row.state, PluginState::Failed, "", None, None).await.unwrap());
        // A check that was ended meanwhile does not wait again, and no report is kept.
        if row.id == "a" {
            assert!(!ended_check(&store, &attempt, PluginState::Validated).await);
            assert_eq!(store.plugin("a").await.unwrap().unwrap().hardware_class, None);
        } else {
            assert!(store.put_back_check(&attempt).await.unwrap());
        }
    }
    assert_eq!(order, "adbec");
}

/// Ends a check; false when that is refused.
pub(super) async fn ended_check(store: &Store, attempt: &Attempt, state: PluginState) -> bool {
    let notice: NoticeInfo = serde_json::from_value(serde_json::json!({
        "id": attempt.id, "subject": "s", "text": "t", "link": "/p/p", "created_us": 1, "read_us": null,
    }))
    .unwrap();
    let new_notice = NewNotice { account: "1", notice: &notice, most: 9, mailing: false };
    let check = CheckEnd { algorithms: &[], class: "class", state, new_notice, note: NOTE };
    store.accept_check(attempt, check).await.unwrap()
}
