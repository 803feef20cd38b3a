//! Accounts and the audit log, on both databases.

use super::super::*;
use super::rows::*;
use super::{add, fresh_stages, object, run};
use crate::model::{AccountInfo, Cursor, InvitationInfo, InvitationState, Role, Scope, TokenInfo};

pub(crate) fn account(id: &str, name: &str) -> AccountInfo {
    AccountInfo {
        id: id.into(),
        name: name.into(),
        role: Role::User,
        developer_request: None,
        signing_key: None,
        created_us: 1,
    }
}

fn key(id: &str, expires_us: i64) -> TokenInfo {
    TokenInfo { id: id.into(), name: "n".into(), scopes: vec![Scope::Plugins], created_us: 1, expires_us }
}

pub(crate) const NOTE: Note<'static> = Note { actor: "ada", action: "did", subject: "x", detail: "" };

pub async fn accounts_have_one_name_and_keys_of_their_own(store: Store) {
    let (ada, later) = (account("1", "Ada"), now_us() + 1_000_000_000);
    assert!(store.add_account(&ada, "hash").await.unwrap());
    assert!(!store.add_account(&account("2", "aDA"), "other").await.unwrap());
    assert_eq!(store.password_of("ADA").await.unwrap(), Some(("1".into(), "hash".into())));
    store.set_password("1", "new").await.unwrap();
    assert_eq!(store.password_of("ada").await.unwrap(), Some(("1".into(), "new".into())));
    assert_eq!(store.password_of("bob").await.unwrap(), None);
    store.set_developer_request("1", "please").await.unwrap();
    assert_eq!(store.account("1").await.unwrap().unwrap().developer_request.as_deref(), Some("please"));
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

pub async fn an_invitation_is_accepted_once_and_in_time(store: Store) {
    for (id, role) in [("1", Role::Curator), ("2", Role::User), ("3", Role::User), ("4", Role::User)] {
        store.add_account(&AccountInfo { role, ..account(id, &format!("name{id}")) }, "hash").await.unwrap();
    }
    let later = now_us() + 1_000_000_000;
    let made = |id: &str, created_us: i64, expires_us: i64, by: Option<&str>| InvitationInfo {
        id: id.into(),
        recipient: "Ada".into(),
        invited_by: by.map(|id| format!("name{id}")),
        state: if expires_us == later { InvitationState::Open } else { InvitationState::Expired },
        accepted_by: None,
        created_us,
        expires_us,
    };
    // By a curator, too late, by the operator, and by somebody who is no curator.
    for (id, expires_us, by) in
        [("a", later, Some("1")), ("b", 5, Some("1")), ("c", later, None), ("d", later, Some("4")), ("e", later, None)]
    {
        let invitation = made(id, 1, expires_us, by);
        assert!(store.add_invitation(&format!("hash {id}"), by, &invitation, NOTE).await.unwrap());
        assert_eq!(store.invitation(id).await.unwrap(), Some(invitation));
    }
    assert_eq!(store.open_invitations().await.unwrap(), 4);
    let ids: Vec<String> = store.invitations(&Cursor::start(), 2).await.unwrap().into_iter().map(|i| i.id).collect();
    assert_eq!(ids, ["e", "d"]);
    let accept = |hash: &'static str, account: &'static str| store.accept_invitation(hash, account, NOTE);
    for none in ["hash b", "hash d", "hash z"] {
        assert_eq!(accept(none, "2").await.unwrap(), None, "{none}");
    }
    // Who is more already does not use it up.
    assert_eq!(accept("hash a", "1").await.unwrap(), None);
    assert_eq!(accept("hash a", "2").await.unwrap().as_deref(), Some("a"));
    assert_eq!(store.account("2").await.unwrap().unwrap().role, Role::Developer);
    assert_eq!(accept("hash a", "3").await.unwrap(), None);
    assert_eq!(store.account("3").await.unwrap().unwrap().role, Role::User);
    let used = store.invitation("a").await.unwrap().unwrap();
    assert_eq!((used.state, used.accepted_by.as_deref()), (InvitationState::Accepted, Some("name2")));
    assert_eq!(store.notes_on("invitation:a").await.unwrap().len(), 1);
    assert!(store.revoke_invitation("c", NOTE).await.unwrap());
    assert!(!store.revoke_invitation("c", NOTE).await.unwrap() && !store.revoke_invitation("a", NOTE).await.unwrap());
    assert_eq!(accept("hash c", "3").await.unwrap(), None);
    assert_eq!(store.invitation("c").await.unwrap().unwrap().state, InvitationState::Revoked);
    // Made again it has another secret, as long as it is open.
    let again = made("e", 1, later, None);
    assert!(store.add_invitation("another hash", None, &again, NOTE).await.unwrap());
    assert!(!store.add_invitation("no hash", Some("1"), &made("a", 1, later, Some("1")), NOTE).await.unwrap());
    assert_eq!(accept("hash e", "3").await.unwrap(), None);
    assert_eq!(accept("another hash", "3").await.unwrap().as_deref(), Some("e"));
    assert_eq!(store.notes_on("x").await.unwrap().len(), 6 + 2 + 1, "what did not happen is not noted");
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

pub async fn a_key_names_one_request(store: Store) {
    let request = |owner: &'static str, resource: &'static str, digest: &'static str| Request {
        owner,
        resource,
        key: "k",
        digest,
    };
    let of = async |owner, resource, digest, id: &'static str| {
        store.request(request(owner, resource, digest), id).await.unwrap()
    };
    let found = |id: &str, digest: &str| (id.to_owned(), digest.to_owned());
    assert_eq!(of("guest", "token", "d", "1").await, found("1", "d"));
    assert_eq!(of("guest", "token", "e", "2").await, found("1", "d"), "the first stands");
    assert_eq!(of("guest", "advice", "e", "3").await, found("3", "e"));
    assert_eq!(of("account:1", "advice", "f", "4").await, found("4", "f"));
    // Keys go along when a guest becomes an account; where both have one, the account's stays.
    store.move_things("guest", "account:1").await.unwrap();
    assert_eq!(of("account:1", "token", "d", "5").await, found("1", "d"));
    assert_eq!(of("account:1", "advice", "f", "6").await, found("4", "f"));
    store.forget_requests(now_us() + 1).await.unwrap();
    assert_eq!(of("account:1", "token", "g", "7").await, found("7", "g"));
}
