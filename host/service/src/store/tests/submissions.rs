//! Plugins that developers bring, on both databases.

use super::super::*;
use super::people::{NOTE, account};
use super::rows::*;
use crate::model::{CheckLine, CheckVerdict, Cursor, NoticeInfo, PluginState};

pub(super) fn submission(id: &str, account: &str, blob: &str) -> SubmissionRow {
    let manifest = serde_json::from_value(serde_json::json!({
        "name": "n", "version": "1", "authors": "a", "license": "MIT", "queries": ["proximity"]
    }));
    SubmissionRow {
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

pub async fn a_submission_is_checked_three_times_at_most(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_blob("f", 1, "x").await.unwrap();
    let row = SubmissionRow { signed_by: Some("RWkey".into()), ..submission("p", "1", "f") };
    assert!(store.add_submission(&row, NOTE).await.unwrap());
    assert!(!store.add_submission(&SubmissionRow { id: "q".into(), ..row.clone() }, NOTE).await.unwrap());
    assert_eq!(store.notes_on("x").await.unwrap().len(), 1, "what did not happen is not noted");
    assert_eq!(store.submission("p").await.unwrap().as_ref(), Some(&row));
    assert_eq!(store.submission_of("1", "f").await.unwrap().as_ref(), Some(&row));
    store.sign_submission("p", "RWother", NOTE).await.unwrap();
    let row = SubmissionRow { signed_by: Some("RWother".into()), ..row };
    let line =
        CheckLine { check: "c".into(), verdict: CheckVerdict::Pass, evidence: "e".into(), hint: None, repro: None };
    assert_eq!(store.claim_check(3).await.unwrap().as_ref(), Some(&row));
    store.put_back_check("p").await.unwrap();
    for _ in 0..3 {
        assert_eq!(store.claim_check(3).await.unwrap().map(|claimed| claimed.id).as_deref(), Some("p"));
        // Lines of an earlier attempt are gone.
        store.add_line("p", 1, &line).await.unwrap();
        assert_eq!(store.lines("p").await.unwrap(), std::slice::from_ref(&line));
        let vetted = || store.move_submission("p", PluginState::Uploaded, PluginState::Vetted, "", None, Some(NOTE));
        assert!(vetted().await.unwrap() && !vetted().await.unwrap());
        assert_eq!(store.recover_checks(4).await.unwrap(), []);
    }
    // Begun three times it is given up, as often as that is asked for.
    for _ in 0..2 {
        assert_eq!(store.claim_check(3).await.unwrap(), None);
        let given_up = store.recover_checks(3).await.unwrap();
        assert!(matches!(&given_up[..], [row] if row.id == "p" && row.state == PluginState::Uploaded), "{given_up:?}");
    }
    assert!(
        store.move_submission("p", PluginState::Uploaded, PluginState::Failed, "", None, Some(NOTE)).await.unwrap()
    );
    assert_eq!(store.recover_checks(3).await.unwrap(), []);
    assert_eq!(store.notes_on("x").await.unwrap().len(), 6);
    store.describe_submission("p", &[], "class").await.unwrap();
    assert_eq!(store.submissions().await.unwrap()[0].hardware_class.as_deref(), Some("class"));

    // Taken out on another class while it is public, unless somebody has decided since it failed.
    let public = |from| store.move_submission("p", from, PluginState::Public, "", None, None);
    let out = |failed_us| store.exclude_submission("p", "other", failed_us, None, Note { detail: "why", ..NOTE });
    assert!(!out(now_us() + 1_000_000).await.unwrap(), "it is not public");
    assert!(public(PluginState::Failed).await.unwrap());
    assert!(!out(1).await.unwrap(), "it failed before it was decided about");
    assert!(out(now_us() + 1_000_000).await.unwrap());
    let row = store.submission("p").await.unwrap().unwrap();
    assert_eq!(
        (row.state, row.reason.as_str(), row.excluded_on.as_deref()),
        (PluginState::Excluded, "why", Some("other"))
    );
    assert_eq!((row.hardware_class.as_deref(), store.notes_on("x").await.unwrap().len()), (Some("class"), 7));
    assert!(public(PluginState::Excluded).await.unwrap());
    assert_eq!(store.submission("p").await.unwrap().unwrap().excluded_on, None);
}

pub async fn a_decision_and_its_notice_stand_or_fall_together(store: Store) {
    assert!(store.add_account(&account("1", "ada"), "hash").await.unwrap());
    store.add_blob("f", 1, "x").await.unwrap();
    assert!(store.add_submission(&submission("p", "1", "f"), NOTE).await.unwrap());
    let notice: NoticeInfo = serde_json::from_value(serde_json::json!({
        "id": "n", "subject": "s", "text": "t", "link": "/p/p", "created_us": 1, "read_us": null,
    }))
    .unwrap();
    let new_notice = NewNotice { account: "1", notice: &notice, most: 9, mailing: true };
    let decide = |from, to| store.move_submission("p", from, to, "why", Some(new_notice), Some(NOTE));
    let told = async || store.notices("1", &Cursor::start(), 9).await.unwrap().len();
    assert!(!decide(PluginState::Awaiting, PluginState::Public).await.unwrap());
    assert_eq!(told().await, 0, "of what did not happen nobody is told");
    assert!(decide(PluginState::Uploaded, PluginState::Public).await.unwrap());
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (1, 2));
    // The notice cannot be kept, because there is one of this id: then nothing was decided, and nothing noted.
    decide(PluginState::Public, PluginState::Suspended).await.unwrap_err();
    store.exclude_submission("p", "class", i64::MAX, Some(new_notice), NOTE).await.unwrap_err();
    assert_eq!(store.submission("p").await.unwrap().unwrap().state, PluginState::Public);
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (1, 2));
    let another = NoticeInfo { id: "m".into(), ..notice.clone() };
    let new_notice = NewNotice { notice: &another, ..new_notice };
    assert!(store.exclude_submission("p", "class", i64::MAX, Some(new_notice), NOTE).await.unwrap());
    assert_eq!((told().await, store.notes_on("x").await.unwrap().len()), (2, 3));
}

pub async fn a_state_and_its_history_are_of_one_moment(store: Store) {
    assert!(store.add_account(&account("1", "ada"), "hash").await.unwrap());
    store.add_blob("f", 1, "x").await.unwrap();
    let uploaded = Note { action: "uploaded", subject: "p", ..NOTE };
    assert!(store.add_submission(&submission("p", "1", "f"), uploaded).await.unwrap());
    // Somebody moves it until both readers have seen it at so many moments. Who looked once for a state and then for a
    // history would see a step between them.
    let reading = std::cell::Cell::new(2);
    let mover = async || {
        let mut from = PluginState::Uploaded;
        while reading.get() > 0 {
            let to = if from == PluginState::Public { PluginState::Suspended } else { PluginState::Public };
            let note = Note { action: to.name(), ..uploaded };
            assert!(store.move_submission("p", from, to, "", None, Some(note)).await.unwrap());
            from = to;
        }
    };
    let reader = async || {
        let mut moments = std::collections::BTreeSet::new();
        while moments.len() < 40 {
            let (row, _, history) = store.whole_submission("p").await.unwrap().unwrap();
            assert_eq!(history.last().unwrap().action, row.state.name(), "after {} steps", history.len());
            moments.insert(history.len());
        }
        reading.set(reading.get() - 1);
    };
    futures::join!(mover(), reader(), reader());
    assert_eq!(store.whole_submission("q").await.unwrap(), None);
}

pub async fn authors_take_turns_with_their_checks(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_account(&account("2", "bob"), "hash").await.unwrap();
    for (id, of, created_us) in [("a", "1", 1), ("b", "1", 2), ("c", "1", 3), ("d", "2", 4), ("e", "2", 5)] {
        store.add_blob(id, 1, "x").await.unwrap();
        let row = SubmissionRow { created_us, ..submission(id, of, id) };
        assert!(store.add_submission(&row, NOTE).await.unwrap());
    }
    let mut order = String::new();
    while let Some(row) = store.claim_check(3).await.unwrap() {
        order += &row.id;
        assert!(store.move_submission(&row.id, row.state, PluginState::Failed, "", None, None).await.unwrap());
        // What was ended meanwhile does not wait again.
        store.put_back_check(&row.id).await.unwrap();
    }
    assert_eq!(order, "adbec");
}
