//! Deleting an account, and what stays of it, on both databases.

use super::super::*;
use super::people::account;
use super::plugins::plugin;
use super::rows::*;
use super::{add, begin, object, run, workload};
use crate::model::{
    AccountInfo, CheckLine, CheckVerdict, Cursor, InvitationInfo, InvitationState, NewChoices, NoticeInfo, OwnedItem,
    PluginState, Role, SavedConfigurations, Scope, StabilitySpec, State, TokenInfo,
};
use crate::owned::sql::Unused;
use crate::stability::runs_sql::StabilityRow;
use crate::suite::Suite;

const NOTE: Note<'static> = Note { actor: "Ada", action: "did", subject: "x", detail: "" };

fn thing(id: &str) -> OwnedItem {
    OwnedItem { id: id.into(), name: String::new() }
}

/// How many rows of every table hold something of the account by its id, as an owner, or by its address.
async fn rows_of(store: &Store, id: &str) -> i64 {
    let text = "SELECT (SELECT COUNT(*) FROM keys WHERE account = $1) + (SELECT COUNT(*) FROM mails WHERE account = $1) \
                + (SELECT COUNT(*) FROM notices WHERE account = $1) \
                + (SELECT COUNT(*) FROM confirmations WHERE account = $1) \
                + (SELECT COUNT(*) FROM off_links WHERE account = $1) \
                + (SELECT COUNT(*) FROM runs WHERE owner = $2) + (SELECT COUNT(*) FROM objects WHERE owner = $2) \
                + (SELECT COUNT(*) FROM requests WHERE owner = $2) + (SELECT COUNT(*) FROM kept WHERE owner = $2) \
                + (SELECT COUNT(*) FROM served WHERE owner = $2) \
                + (SELECT COUNT(*) FROM stability_runs WHERE owner = $2) \
                + (SELECT COUNT(*) FROM workloads WHERE owner = $2) \
                + (SELECT COUNT(*) FROM saved_configurations WHERE owner = $2)";
    let owner = format!("account:{id}");
    sqlx::query_scalar(text).bind(id).bind(owner).fetch_one(&store.pool).await.unwrap()
}

/// An account with everything that a store keeps of one.
pub(crate) async fn somebody(store: &Store, id: &str, name: &str) -> AccountInfo {
    let info = AccountInfo { role: Role::Curator, ..account(id, name) };
    let (owner, later) = (info.owner(), now_us() + 1_000_000_000);
    assert!(store.add_account(&info, "hash").await.unwrap());
    let key =
        TokenInfo { id: id.into(), name: "n".into(), scopes: vec![Scope::Runs], created_us: 1, expires_us: later };
    store.add_key(&format!("session {id}"), id, &key, true).await.unwrap();
    store.add_key(&format!("token {id}"), id, &key, false).await.unwrap();
    let both = NewChoices { mail_notices: Some(true), agrees_to_reruns: Some(true) };
    store.choose(id, &both).await.unwrap();
    let address = &format!("{name}@example.org");
    store.set_address(id, address, true, NOTE).await.unwrap();
    let link = MailLink { sha256: &format!("link {id}"), account: id, address, expires_us: later };
    store.add_confirmation(link).await.unwrap();
    store.add_off_link(link).await.unwrap();
    store.set_signing_key(id, Some("RWkey"), NOTE).await.unwrap();
    let notice: NoticeInfo = serde_json::from_value(serde_json::json!({
        "id": format!("n{id}"), "subject": "s", "text": "t", "link": "/runs", "created_us": 1, "read_us": null,
    }))
    .unwrap();
    assert!(store.add_notice(NewNotice { account: id, notice: &notice, most: 9, mailing: true }).await.unwrap());
    let request = Request { owner: &owner, resource: "token", key: "k", digest: "d" };
    store.request(request, "1").await.unwrap();
    store.keep_longer(&owner).await.unwrap();
    for (kind, private) in [("public", 0), ("own", 1)] {
        let (run_id, object_id) = (format!("{kind} run {id}"), format!("{kind} object {id}"));
        store.add_blob(&format!("{kind} mesh {id}"), 10, "x").await.unwrap();
        store.add_object(&object(&object_id), Some(&owner), &format!("{kind} mesh {id}")).await.unwrap();
        add(store, run(&run_id, Some(&owner), 5, 1 + private)).await;
        let mut plugin = plugin(&format!("{kind} plugin {id}"), id, &format!("{kind} file {id}"));
        plugin.state = if kind == "public" { PluginState::Withdrawn } else { PluginState::Awaiting };
        store.add_blob(&plugin.blob, 20, "x").await.unwrap();
        assert!(store.add_plugin(&plugin, Note { actor: name, subject: &plugin.id, ..NOTE }).await.unwrap());
        let line =
            CheckLine { check: "c".into(), verdict: CheckVerdict::Pass, evidence: "e".into(), hint: None, repro: None };
        let text = "INSERT INTO submission_lines (submission, seq, line) VALUES ($1, 1, $2)";
        let query = sqlx::query(text).bind(&plugin.id).bind(to_json(&line).unwrap());
        query.execute(&store.pool).await.unwrap();
    }
    begin(store, "m").await.unwrap();
    store.add_blob(&format!("saved {id}"), 30, "x").await.unwrap();
    let saved = SavedConfigurations {
        id: format!("configurations {id}"),
        name: "n".into(),
        sha256: format!("saved {id}"),
        configurations: 3,
        straightened: 0,
        created_us: 1,
    };
    store.add_saved(&saved, &owner).await.unwrap();
    let tried = StabilityRow {
        id: format!("stability {id}"),
        turn: owner.clone(),
        owner: Some(owner),
        priority: 1,
        state: State::Queued,
        attempts: 0,
        message: None,
        name: "n".into(),
        spec: StabilitySpec { algorithm: "a".into(), parts: Vec::new(), seeds: None },
        done: Vec::new(),
        spent_seconds: 0.0,
        created_us: 1,
        finished_us: None,
    };
    assert!(store.add_stability_run(&tried).await.unwrap());
    let recorded = workload(&format!("workload {id}"), &info.owner(), &format!("recording {id}"));
    store.add_blob(&recorded.recording.sha256, 40, "application/zip").await.unwrap();
    assert!(store.add_workload(&recorded).await.unwrap());
    info
}

fn parted(id: &str) -> (OwnedIds, OwnedIds) {
    let of = |kind: &str| OwnedIds {
        runs: vec![thing(&format!("{kind} run {id}"))],
        objects: vec![thing(&format!("{kind} object {id}"))],
        advice: Vec::new(),
        configurations: Vec::from_iter((kind == "own").then(|| thing(&format!("configurations {id}")))),
        stability: Vec::from_iter((kind == "own").then(|| format!("stability {id}"))),
        workloads: Vec::from_iter((kind == "own").then(|| format!("workload {id}"))),
        plugins: vec![format!("{kind} plugin {id}")],
    };
    (of("own"), of("public"))
}

pub async fn an_account_goes_at_once_and_what_is_public_is_nobodys(store: Store) {
    let (ada, bob) = (somebody(&store, "1", "Ada").await, somebody(&store, "2", "Bob").await);
    let suite = Suite::open(None).unwrap();
    store.keep_suite(&suite).await.unwrap();
    let later = now_us() + 1_000_000_000;
    for (id, by) in [("a", "1"), ("b", "2")] {
        let made = InvitationInfo {
            id: id.into(),
            recipient: "Eve of Example".into(),
            invited_by: Some(by.into()),
            state: InvitationState::Open,
            accepted_by: None,
            created_us: 1,
            expires_us: later,
        };
        assert!(store.add_invitation(&format!("hash {id}"), Some(by), &made, NOTE).await.unwrap());
    }
    let campaign = super::campaigns::campaign("c", 1, &suite);
    assert!(store.add_campaign(&CampaignRow { created_by: "Ada".into(), ..campaign }, NOTE).await.unwrap());
    let before = rows_of(&store, "2").await;
    assert!(before >= 14 && rows_of(&store, "1").await >= 14, "{before}");

    let (goes, stays) = parted("1");
    let unused = store.delete_account(&ada, &goes, &stays, NOTE).await.unwrap();
    let file = |sha256: &str, bytes| Unused { sha256: sha256.into(), bytes };
    assert_eq!(
        unused,
        Some(vec![file("own file 1", 20), file("own mesh 1", 10), file("recording 1", 40), file("saved 1", 30)])
    );
    assert_eq!(rows_of(&store, "1").await, 0);
    assert_eq!(rows_of(&store, "2").await, before, "nobody else lost anything");

    // Nothing opens it, nobody finds it, and nothing of it is in its row.
    assert_eq!((store.account("1").await.unwrap(), store.password_of("ada").await.unwrap()), (None, None));
    for (hash, session) in [("session 1", true), ("token 1", false)] {
        assert_eq!(store.opened_by(hash, session).await.unwrap(), None);
    }
    assert!(store.opened_by("session 2", true).await.unwrap().is_some());
    assert_eq!(store.accounts(&Cursor::start(), 9).await.unwrap().len(), 1);
    let left: (String, String, String, i64, i64) = sqlx::query_as(
        "SELECT name, password, role, mail_notices, agrees_to_reruns FROM accounts WHERE id = '1' AND address IS NULL \
         AND signing_key IS NULL AND confirmed_us IS NULL AND wish IS NULL",
    )
    .fetch_one(&store.pool)
    .await
    .unwrap();
    assert_eq!(left, (A_FORMER_ACCOUNT.into(), String::new(), "user".into(), 0, 0));
    // What was under way when it went leads nowhere: no key, no plugin, no notice, no link, no address.
    let key = TokenInfo { id: "k".into(), name: "n".into(), scopes: vec![], created_us: 1, expires_us: later };
    store.add_key("late", "1", &key, true).await.unwrap();
    assert!(!store.add_plugin(&plugin("late", "1", "public file 2"), NOTE).await.unwrap());
    store.set_address("1", "ada@example.org", false, NOTE).await.unwrap();
    let link = MailLink { sha256: "late", account: "1", address: "ada@example.org", expires_us: later };
    store.add_confirmation(link).await.unwrap();
    store.add_off_link(link).await.unwrap();
    let notice = store.notices("2", &Cursor::start(), 1).await.unwrap().remove(0);
    let told = NoticeInfo { id: "late".into(), ..notice };
    assert!(!store.add_notice(NewNotice { account: "1", notice: &told, most: 9, mailing: true }).await.unwrap());
    assert_eq!(rows_of(&store, "1").await, 0);
    // Its name is nobody else's.
    assert!(!store.add_account(&account("3", "ADA"), "hash").await.unwrap());

    // What was public is there, without a name; the rest is not.
    let kept = store.run("public run 1").await.unwrap().unwrap();
    assert_eq!((kept.owner, store.object("public object 1").await.unwrap().unwrap().owner), (None, None));
    assert!(store.run("own run 1").await.unwrap().is_none() && store.object("own object 1").await.unwrap().is_none());
    assert!(store.plugin("own plugin 1").await.unwrap().is_none());
    assert!(store.lines("own plugin 1").await.unwrap().is_empty());
    assert_eq!(store.plugin("public plugin 1").await.unwrap().unwrap().account, "1");
    assert_eq!(store.lines("public plugin 1").await.unwrap().len(), 1);
    let actors =
        async |of: &str| store.notes_on(of).await.unwrap().into_iter().map(|entry| entry.actor).collect::<Vec<_>>();
    assert_eq!(actors("public plugin 1").await, [A_FORMER_ACCOUNT]);
    assert_eq!(actors("public plugin 2").await, ["Bob"]);
    assert_eq!(store.broken_note().await.unwrap(), None, "the log itself is as it was");
    assert_eq!(store.campaign("c").await.unwrap().unwrap().created_by, A_FORMER_ACCOUNT);
    let withdrawn = store.invitation("a").await.unwrap().unwrap();
    assert_eq!((withdrawn.state, withdrawn.invited_by.as_deref()), (InvitationState::Revoked, Some(A_FORMER_ACCOUNT)));
    assert_eq!(store.invitation("b").await.unwrap().unwrap().state, InvitationState::Open);
    assert!(store.is_former("1").await.unwrap() && !store.is_former("2").await.unwrap());
    // Again is harmless, and the last one stays with everything.
    assert_eq!(store.delete_account(&ada, &goes, &stays, NOTE).await.unwrap(), None);
    let (goes, stays) = parted("2");
    assert_eq!(store.delete_account(&bob, &goes, &stays, NOTE).await.unwrap(), None);
    assert_eq!(rows_of(&store, "2").await, before);
}

pub async fn somebody_who_decides_is_always_left(store: Store) {
    use Role::{Administrator, Curator, Developer};
    let all = [("1", Administrator), ("2", Administrator), ("3", Curator), ("4", Curator), ("5", Developer)];
    let of = |id: &str, role| AccountInfo { role, ..account(id, &format!("name{id}")) };
    for (id, role) in all {
        assert!(store.add_account(&of(id, role), "hash").await.unwrap());
    }
    let nothing = OwnedIds::default();
    let leave =
        async |id: &str, role| store.delete_account(&of(id, role), &nothing, &nothing, NOTE).await.unwrap().is_some();
    assert!(leave("5", Developer).await && leave("3", Curator).await);
    assert!(store.others_may(Curator, "4").await.unwrap() && store.others_may(Administrator, "1").await.unwrap());
    assert!(leave("4", Curator).await, "administrators decide, too");
    // Both at once: one of them stays.
    let both = futures::future::join_all(["1", "2"].map(|id| leave(id, Administrator))).await;
    assert_eq!(both.iter().filter(|gone| **gone).count(), 1, "{both:?}");
    let left = store.accounts(&Cursor::start(), 9).await.unwrap();
    assert_eq!(left.len(), 1);
    assert!(!store.others_may(Administrator, &left[0].id).await.unwrap());
    assert_eq!(store.notes_on("x").await.unwrap().len(), 4, "what did not happen is not noted");
}

pub async fn a_plugin_that_became_public_meanwhile_stays(store: Store) {
    let ada = account("1", "ada");
    assert!(store.add_account(&ada, "hash").await.unwrap());
    store.add_blob("f", 1, "x").await.unwrap();
    assert!(store.add_plugin(&plugin("p", "1", "f"), NOTE).await.unwrap());
    assert!(store.move_plugin("p", PluginState::Uploaded, PluginState::Public, "", None, None).await.unwrap());
    let goes = OwnedIds { plugins: vec!["p".into()], ..OwnedIds::default() };
    assert_eq!(store.delete_account(&ada, &goes, &OwnedIds::default(), NOTE).await.unwrap(), Some(vec![]));
    assert_eq!(store.plugin("p").await.unwrap().unwrap().state, PluginState::Public);
}
