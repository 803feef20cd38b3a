//! Accounts, the audit log and submissions, on both databases.

use super::super::*;
use super::{add, fresh_stages, object, run};
use crate::model::{AccountInfo, CheckLine, CheckVerdict, Cursor, PluginState, Role, Scope, TokenInfo};

fn account(id: &str, name: &str) -> AccountInfo {
    AccountInfo { id: id.into(), name: name.into(), role: Role::User, wish: None, signing_key: None, created_us: 1 }
}

fn key(id: &str, expires_us: i64) -> TokenInfo {
    TokenInfo { id: id.into(), name: "n".into(), scopes: vec![Scope::Plugins], created_us: 1, expires_us }
}

const NOTE: Note<'static> = Note { actor: "ada", action: "did", subject: "x", detail: "" };

pub async fn accounts_have_one_name_and_keys_of_their_own(store: Store) {
    let (ada, later) = (account("1", "Ada"), now_us() + 1_000_000_000);
    assert!(store.add_account(&ada, "hash").await.unwrap());
    assert!(!store.add_account(&account("2", "aDA"), "other").await.unwrap());
    assert_eq!(store.password_of("ADA").await.unwrap(), Some(("1".into(), "hash".into())));
    store.set_password("1", "new").await.unwrap();
    assert_eq!(store.password_of("ada").await.unwrap(), Some(("1".into(), "new".into())));
    assert_eq!(store.password_of("bob").await.unwrap(), None);
    store.set_wish("1", "please").await.unwrap();
    assert_eq!(store.account("1").await.unwrap().unwrap().wish.as_deref(), Some("please"));
    assert!(store.set_role("1", Role::Developer, NOTE).await.unwrap());
    assert!(!store.set_role("9", Role::User, NOTE).await.unwrap());
    assert_eq!(store.notes_on("x").await.unwrap().len(), 1, "what did not happen is not noted");
    store.set_signing_key("1", Some("RWkey"), NOTE).await.unwrap();
    let now = AccountInfo { role: Role::Developer, signing_key: Some("RWkey".into()), ..ada };
    assert_eq!(store.accounts(&Cursor::start(), 9).await.unwrap(), std::slice::from_ref(&now));

    store.add_key("s", "1", &key("a", later), true).await.unwrap();
    store.add_key("t", "1", &key("b", later), false).await.unwrap();
    store.add_key("old", "1", &key("c", 5), true).await.unwrap();
    let opened = |hash: &'static str, session| store.opened_by(hash, session);
    assert_eq!(opened("s", true).await.unwrap(), Some((now.clone(), vec![Scope::Plugins])));
    assert_eq!(opened("t", false).await.unwrap(), Some((now, vec![Scope::Plugins])));
    // Neither stands for the other, and what has ended opens nothing.
    assert_eq!((opened("s", false).await.unwrap(), opened("t", true).await.unwrap()), (None, None));
    assert_eq!(opened("old", true).await.unwrap(), None);
    store.forget_ended_keys().await.unwrap();
    assert_eq!(store.tokens("1").await.unwrap(), [key("b", later)]);
    assert!(!store.end_token("1", "a").await.unwrap(), "a session is no token");
    store.end_sessions("1").await.unwrap();
    assert!(opened("s", true).await.unwrap().is_none() && opened("t", false).await.unwrap().is_some());
    assert!(store.end_token("1", "b").await.unwrap());
    store.add_key("s", "1", &key("d", later), true).await.unwrap();
    store.end_session("s").await.unwrap();
    assert_eq!(opened("s", true).await.unwrap(), None);

    store.add_blob("m", 1, "x").await.unwrap();
    store.add_object(&object("o"), Some("guest"), "m").await.unwrap();
    add(&store, run("r", Some("guest"), 1, 1)).await;
    // Both have used the same key of a request; the account's own run keeps it.
    for (id, owner) in [("s", "guest"), ("t", "account:1")] {
        let row = run(id, Some(owner), 1, 1);
        assert!(store.add_run(&row, &fresh_stages(&row.spec.algorithms), Some("k")).await.unwrap());
    }
    store.move_things("guest", "account:1").await.unwrap();
    assert_eq!(store.run_of_request("account:1", "k").await.unwrap().map(|row| row.id).as_deref(), Some("t"));
    assert_eq!(store.objects_for(Some("account:1"), &Cursor::start(), 9).await.unwrap().len(), 1);
    assert_eq!(store.runs_of("account:1", &Cursor::start(), 9).await.unwrap().len(), 3);
    assert!(store.runs_of("guest", &Cursor::start(), 9).await.unwrap().is_empty());
}

pub async fn the_log_shows_what_was_changed_by_hand(store: Store) {
    for i in 0..3 {
        store.note("ada", "did", "x", &i.to_string()).await.unwrap();
    }
    let entries = store.notes_on("x").await.unwrap();
    assert_eq!(entries.iter().map(|e| (e.seq, e.detail.as_str())).collect::<Vec<_>>(), [(1, "0"), (2, "1"), (3, "2")]);
    assert_eq!(store.broken_note().await.unwrap(), None);
    sqlx::query("UPDATE audit SET detail = 'nothing' WHERE seq = 2").execute(&store.pool).await.unwrap();
    assert_eq!(store.broken_note().await.unwrap(), Some(2));
    sqlx::query("DELETE FROM audit WHERE seq = 2").execute(&store.pool).await.unwrap();
    assert_eq!(store.broken_note().await.unwrap(), Some(2));
    // Writers at once each get a number.
    let notes = futures::future::join_all((0..8).map(|_| store.note("ada", "did", "y", ""))).await;
    assert!(notes.into_iter().all(|note| note.is_ok()));
    assert_eq!(store.notes_on("y").await.unwrap().len(), 8);
}

pub async fn a_submission_is_checked_three_times_at_most(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_blob("f", 1, "x").await.unwrap();
    let manifest = serde_json::from_value(serde_json::json!({
        "name": "n", "version": "1", "authors": "a", "license": "MIT", "queries": ["proximity"]
    }));
    let row = SubmissionRow {
        id: "p".into(),
        account: "1".into(),
        blob: "f".into(),
        file: "f.so".into(),
        bytes: 1,
        manifest: manifest.unwrap(),
        signed_by: Some("RWkey".into()),
        state: PluginState::Uploaded,
        reason: String::new(),
        hardware_class: None,
        algorithms: Vec::new(),
        created_us: 1,
        changed_us: 1,
    };
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
        let vetted = || store.move_submission("p", PluginState::Uploaded, PluginState::Vetted, "", Some(NOTE));
        assert!(vetted().await.unwrap() && !vetted().await.unwrap());
        store.recover_checks(3).await.unwrap();
    }
    assert_eq!(store.claim_check(3).await.unwrap(), None);
    let given_up = store.submission("p").await.unwrap().unwrap();
    assert!(given_up.state == PluginState::Failed && given_up.reason.contains("3 times"), "{given_up:?}");
    let told = store.notes_on("p").await.unwrap();
    assert_eq!(
        (told.len(), told[0].action.as_str(), store.notes_on("x").await.unwrap().len()),
        (1, "failed the check", 5)
    );
    store.describe_submission("p", &[], "class").await.unwrap();
    assert_eq!(store.submissions().await.unwrap()[0].hardware_class.as_deref(), Some("class"));
}
