//! The contract of the store: every function, on SQLite and on PostgreSQL.

/// The rows of all concepts.
mod rows {
    pub use crate::advice::sql::StoredPaper;
    pub use crate::audit::A_FORMER_ACCOUNT;
    pub use crate::audit::Note;
    pub use crate::campaigns::sql::CampaignRow;
    pub use crate::mail::sql::{MailLink, WaitingMail};
    pub use crate::notices::sql::NewNotice;
    pub use crate::owned::sql::OwnedIds;
    pub use crate::plugins::sql::PluginRow;
    pub use crate::requests::sql::Request;
    pub use crate::results::sql::StoredResult;
    pub use crate::runs::sql::RunRow;
}

use ocb_core::query::Query;

mod attempts;
mod campaigns;
pub(crate) mod deletion;
pub(crate) mod fixtures;
mod lists;
mod machines;
mod mails;
mod owned;
pub(crate) mod people;
pub(crate) mod plugins;
mod rate_limits;
mod suites;
mod visibility;

use fixtures::{
    add, advice_info, begin, end, handed, object, set_info, spec, usual, worker, workload, workload_result,
};
pub(crate) use fixtures::{result, run};

use super::*;
use crate::blobs::tests::from_harness;
use crate::model::{AlgorithmInfo, Cursor, Draw, Environment, Estimated, ObjectInfo, Reference, Stability, State};
use crate::runs::accept::{Handed, RunEnd};
use crate::runs::events::plain_event;
use crate::runs::log::fresh_stages;
use rows::*;

/// How many rows there are of blobs, objects, sets, runs and results.
pub(crate) async fn row_counts(store: &Store) -> [i64; 5] {
    let mut counts = [0; 5];
    let texts = [
        "SELECT COUNT(*) FROM blobs",
        "SELECT COUNT(*) FROM objects",
        "SELECT COUNT(*) FROM sets",
        "SELECT COUNT(*) FROM runs",
        "SELECT COUNT(*) FROM results",
    ];
    for (count, text) in counts.iter_mut().zip(texts) {
        *count = sqlx::query_scalar(text).fetch_one(&store.pool).await.unwrap();
    }
    counts
}

/// A whole result with so many seeds.
fn stability_of(seeds: u32) -> Stability {
    let text = serde_json::json!({
        "algorithm": "a", "name": "A", "version": "1", "plugin_sha256": "", "single_precision": false,
        "seeds": seeds, "created_us": seeds, "complete": true, "families": [], "relations": [], "failures": [],
        "tessellations": [], "search": null, "unit_safe": [-10, 20], "offset_safe": 16.0
    });
    serde_json::from_value(text).unwrap()
}

async fn sqlite() -> (Store, tempfile::TempDir) {
    let folder = tempfile::Builder::new().prefix("ocb 100% é?").tempdir().unwrap();
    (Store::open(folder.path(), None).await.unwrap(), folder)
}

async fn postgres() -> Store {
    postgres_with("").await.unwrap()
}

async fn postgres_with(parameters: &str) -> Result<Store> {
    Store::open(Path::new("/nonexistent"), Some(&postgres_url(parameters).await)).await
}

/// The address of a fresh schema in the harness's database, so that tests do not see each other, with these parameters.
pub(crate) async fn postgres_url(parameters: &str) -> String {
    let url = from_harness("OCB_TEST_POSTGRES");
    sqlx::any::install_default_drivers();
    let schema = format!("test_{}", uuid::Uuid::new_v4().simple());
    let admin = AnyPoolOptions::new().max_connections(1).connect(&url).await.unwrap();
    let create = sqlx::AssertSqlSafe(format!("CREATE SCHEMA {schema}"));
    sqlx::query(create).execute(&admin).await.unwrap();
    admin.close().await;
    let join = if url.contains('?') { '&' } else { '?' };
    format!("{url}{join}options=-c%20search_path%3D{schema}{parameters}")
}

/// A password and everything else that is stored go only to the server that the certificate names.
#[tokio::test]
async fn a_connection_to_postgresql_is_encrypted_and_the_server_is_checked() {
    let folder = from_harness("OCB_TEST_TLS");
    let checked = |authority| format!("&sslmode=verify-full&sslrootcert={folder}/{authority}.crt");
    let store = postgres_with(&checked("server")).await.unwrap();
    let text = "SELECT COUNT(*) FROM pg_stat_ssl WHERE pid = pg_backend_pid() AND ssl";
    let encrypted: i64 = sqlx::query_scalar(text).fetch_one(&store.pool).await.unwrap();
    assert_eq!(encrypted, 1);
    let refused = postgres_with(&checked("other")).await.map(drop).unwrap_err();
    assert!(matches!(refused, EngineError::Fault(_)), "{refused:?}");
}

macro_rules! on_both {
    ($($name:ident),* $(,)?) => {$(
        mod $name {
            #[tokio::test]
            async fn on_sqlite() {
                let (store, _folder) = super::sqlite().await;
                super::contract::$name(store).await;
            }

            #[tokio::test]
            async fn on_postgres() {
                super::contract::$name(super::postgres().await).await;
            }
        }
    )*};
}

on_both!(
    blobs_are_noted_once,
    objects_belong_to_their_owners,
    descriptions_are_replaced,
    stability_is_replaced,
    advice_ends_once_and_is_found_again,
    sets_are_found_by_their_key,
    a_run_comes_back_as_it_was,
    a_request_makes_one_run,
    events_are_numbered_from_one,
    two_writers_number_events_without_gaps,
    the_queue_is_fair,
    visitors_take_turns_whatever_they_wait_for,
    places_are_right_where_many_wait,
    interrupted_runs_are_tried_three_times,
    a_lease_is_counted_by_the_databases_clock,
    a_clock_that_jumps_loses_no_run_and_keeps_no_dead_worker,
    who_starts_takes_back_its_own_alone,
    a_lost_attempts_result_is_refused_and_leaves_nothing,
    lost_checks_parts_and_advice_change_nothing,
    a_job_is_withdrawn_from_another_worker_alone,
    two_workers_never_begin_the_same,
    a_token_is_that_of_one_machine_until_it_is_revoked,
    a_machine_that_has_changed_is_not_admitted,
    prepared_runs_go_to_machines_in_turn,
    runs_go_to_machines_of_their_hardware_class,
    errands_wait_for_machines_of_the_usual_class_and_idle_runs_give_way_to_them,
    what_waits_is_counted_by_priority_and_class_and_the_oldest_is_found,
    rates_are_those_of_the_hardware_class_or_of_any,
    a_machine_reaches_its_own_attempt_alone,
    results_replace_those_of_an_earlier_attempt,
    the_newest_finished_featured_run_is_shown,
    accounts_have_one_name_and_keys_of_their_own,
    the_log_shows_what_was_changed_by_hand,
    an_invitation_is_accepted_once_and_in_time,
    a_key_names_one_request,
    notices_belong_to_their_account_and_go_with_it,
    mails_wait_for_those_who_want_them,
    an_address_counts_once_its_link_was_opened,
    a_link_turns_off_the_mails_of_its_account_alone,
    a_plugin_is_checked_three_times_at_most,
    authors_take_turns_with_their_checks,
    only_what_is_public_is_in_the_lists_of_others,
    what_an_object_hid_stays_hidden_without_it,
    lists_go_on_where_they_were_left,
    lists_of_plugins_are_whole_and_in_order,
    what_is_taken_away_takes_the_files_that_nobody_else_uses,
    a_suites_runs_are_apart_from_those_of_people,
    a_campaign_repeats_a_run_once_and_takes_nobodys_turn,
    only_runs_of_those_who_agree_are_measured_again,
    an_account_goes_at_once_and_what_is_public_is_nobodys,
    somebody_who_decides_is_always_left,
    a_plugin_that_became_public_meanwhile_stays,
    a_decision_and_its_notice_stand_or_fall_together,
    a_state_and_its_history_are_of_one_moment,
    too_many_attempts_wait_until_the_bucket_has_drained,
);

mod contract {
    pub use super::attempts::*;
    pub use super::campaigns::*;
    pub use super::deletion::*;
    pub use super::lists::*;
    pub use super::machines::*;
    pub use super::mails::*;
    pub use super::owned::*;
    pub use super::people::*;
    pub use super::plugins::*;
    pub use super::rate_limits::*;
    pub use super::suites::*;
    pub use super::visibility::*;
    use super::*;

    pub async fn blobs_are_noted_once(store: Store) {
        assert_eq!(store.blob_bytes("x").await.unwrap(), None);
        store.add_blob("x", 10, "text/plain").await.unwrap();
        store.add_blob("x", 10, "text/plain").await.unwrap();
        assert_eq!(store.blob_bytes("x").await.unwrap(), Some(10));
        assert_eq!(row_counts(&store).await, [1, 0, 0, 0, 0]);
    }

    pub async fn objects_belong_to_their_owners(store: Store) {
        store.add_blob("m", 1, "x").await.unwrap();
        let (mine, other, nobodys) = (object("1"), object("2"), object("3"));
        store.add_object(&mine, Some("me"), "m").await.unwrap();
        store.add_object(&other, Some("other"), "m").await.unwrap();
        store.add_object(&nobodys, None, "m").await.unwrap();
        let row = |info: &ObjectInfo, owner: Option<&str>| {
            let owner = owner.map(str::to_owned);
            crate::objects::sql::ObjectRow { info: info.clone(), owner, blob: "m".into() }
        };
        assert_eq!(store.object("1").await.unwrap(), Some(row(&mine, Some("me"))));
        assert_eq!(store.object("9").await.unwrap(), None);
        assert_eq!((store.uploaded_bytes("me").await.unwrap(), store.uploaded_bytes("none").await.unwrap()), (1, 0));
        assert_eq!(store.objects_for(Some("me"), &Cursor::start(), 9).await.unwrap(), [row(&mine, Some("me"))]);
        assert_eq!(store.object_with_mesh(&mine.sha256, Some("me")).await.unwrap(), Some(row(&mine, Some("me"))));
        assert_eq!(store.object_with_mesh(&mine.sha256, Some("other")).await.unwrap(), None);
        assert_eq!(store.object_with_mesh(&nobodys.sha256, None).await.unwrap(), Some(row(&nobodys, None)));
        assert!(store.add_object(&object("4"), None, "no such blob").await.is_err(), "rows never point nowhere");
    }

    pub async fn descriptions_are_replaced(store: Store) {
        assert_eq!(store.described("h").await.unwrap(), None);
        let mut algorithm = AlgorithmInfo {
            id: "a".into(),
            name: "A".into(),
            version: "1".into(),
            authors: String::new(),
            license: String::new(),
            url: String::new(),
            paper: String::new(),
            queries: vec![Query::CollisionFirst],
            counters: true,
            witness_points: false,
            single_precision: false,
            solid: false,
            coherent: false,
            threads: false,
            scene: false,
            usual: false,
            parameters: Vec::new(),
            plugin_sha256: "h".into(),
            builds: Vec::new(),
        };
        store.keep_description("h", std::slice::from_ref(&algorithm)).await.unwrap();
        algorithm.version = "2".into();
        store.keep_description("h", std::slice::from_ref(&algorithm)).await.unwrap();
        assert_eq!(store.described("h").await.unwrap(), Some(vec![algorithm]));
    }

    pub async fn stability_is_replaced(store: Store) {
        let of = stability_of;
        assert!(store.stability().await.unwrap().is_empty());
        store.keep_stability(&of(1)).await.unwrap();
        store.keep_stability(&of(2)).await.unwrap();
        assert_eq!(store.stability().await.unwrap(), [of(2)]);
    }

    pub async fn advice_ends_once_and_is_found_again(store: Store) {
        let mut info = advice_info("x");
        assert!(store.add_advice(&info, Some("me"), "turn").await.unwrap());
        assert!(!store.add_advice(&info, Some("me"), "turn").await.unwrap());
        let begin = async || store.begin_advice(false, &worker("m")).await.unwrap();
        let (attempt, begun) = begin().await.unwrap();
        assert_eq!((begun.info, begun.owner.as_deref(), begun.attempts), (info.clone(), Some("me"), 1));
        assert!(begin().await.is_none(), "it is at work");
        store.put_back_advice(&attempt).await.unwrap();
        let (attempt, begun) = begin().await.unwrap();
        assert_eq!(begun.attempts, 1, "what was put back does not count");
        info.state = State::Done;
        let paper = StoredPaper { mesh: "m".into(), certificate: "c".into(), file: "a-1.obj".into() };
        assert!(store.end_advice(&attempt, &info, &[vec![paper], vec![]]).await.unwrap());
        assert!(begin().await.is_none() && store.advice("y").await.unwrap().is_none());
        let ended = store.advice("x").await.unwrap().unwrap();
        assert_eq!((ended.info, ended.papers[0][0].file.as_str(), ended.papers[1].len()), (info, "a-1.obj", 0));
    }

    pub async fn sets_are_found_by_their_key(store: Store) {
        store.add_blob("b", 1, "x").await.unwrap();
        assert!(store.set("k").await.unwrap().is_none());
        store.keep_set("k", &set_info(), "b", 1000, 2.0).await.unwrap();
        store.keep_set("k", &set_info(), "b", 1000, 9.0).await.unwrap();
        let stored = store.set("k").await.unwrap().unwrap();
        assert_eq!((stored.info, stored.blob.as_str()), (set_info(), "b"));
        assert_eq!(store.set_rates().await.unwrap(), [(1000, 0.5)]);
    }

    pub async fn a_run_comes_back_as_it_was(store: Store) {
        store.add_blob("b", 1, "x").await.unwrap();
        let mut expected = run("r", Some("me"), 1, 7);
        add(&store, expected.clone()).await;
        assert_eq!(store.run("r").await.unwrap(), Some(expected.clone()));
        assert_eq!(store.run("q").await.unwrap(), None);
        let environment = Environment {
            cpu: "c".into(),
            cpus: 2,
            memory_bytes: 1 << 40,
            kernel: "k".into(),
            hardware_class: "h".into(),
            clock: "spin".into(),
            clock_drift: Some(1e-6),
            null_ns: Estimated { value: 1.0, lo: 0.5, hi: 2.0 },
            disturbed: 3,
            calibration_ns: None,
            reference: Some(Reference { algorithm: "a".into(), plugin_sha256: "p".into() }),
            draw: Some(Draw { seed: (1 << 53) - 1, secret: Some("s".into()), commitment: Some("c".into()) }),
            jail: vec!["seccomp".into()],
            profile: "dev".into(),
            version: "1".into(),
        };
        let attempt = begin(&store, "m").await.unwrap();
        assert!(store.set_of_run(&attempt, &set_info(), "b").await.unwrap());
        assert!(!store.end_waiting_run("r", State::Cancelled, None).await.unwrap(), "it is not queued any more");
        let mut stages = store.stages("r").await.unwrap();
        assert_eq!(stages, fresh_stages(&spec().algorithms));
        (stages[2].done, stages[2].message) = (3, Some("note".into()));
        let mut event = plain_event(State::Running, 0);
        assert!(store.tell(&attempt, &[(2, &stages[2])], &mut event).await.unwrap());
        let handed = Handed { results: Vec::new(), environment: Some(environment.clone()), ..handed() };
        let ended = RunEnd { state: State::Failed, message: Some("why"), handed: Some(&handed) };
        assert!(store.accept_run(&attempt, ended).await.unwrap());
        let got = store.run("r").await.unwrap().unwrap();
        assert!(got.finished_us.is_some());
        (expected.state, expected.attempts, expected.message) = (State::Failed, 1, Some("why".into()));
        (expected.set, expected.set_blob, expected.environment) =
            (Some(set_info()), Some("b".into()), Some(environment));
        expected.finished_us = got.finished_us;
        assert_eq!(got, expected);
        assert_eq!(store.stages("r").await.unwrap(), stages);
        add(&store, run("s", Some("me"), 1, 8)).await;
        add(&store, run("t", Some("other"), 1, 9)).await;
        let mine: Vec<String> =
            store.runs_of("me", &Cursor::start(), 10).await.unwrap().into_iter().map(|r| r.id).collect();
        assert_eq!(mine, ["s", "r"]);
        assert_eq!(store.runs_of("me", &Cursor::start(), 1).await.unwrap().len(), 1);
    }

    pub async fn a_request_makes_one_run(store: Store) {
        let (mine, again) = (run("r", Some("me"), 1, 1), run("s", Some("me"), 1, 2));
        let ask = |row: RunRow, key| {
            let store = store.clone();
            async move { store.add_run(&row, &fresh_stages(&row.spec.algorithms), key).await.unwrap() }
        };
        assert!(ask(mine.clone(), Some("k")).await && !ask(again.clone(), Some("k")).await);
        assert_eq!(store.run_of_request("me", "k").await.unwrap().map(|row| row.id).as_deref(), Some("r"));
        assert!(store.stages("s").await.unwrap().is_empty(), "nothing is left of the second");
        // Keys are each owner's own, and who gives none may ask as often as they like.
        assert!(ask(run("t", Some("other"), 1, 3), Some("k")).await);
        assert!(ask(again, None).await && ask(run("u", Some("me"), 1, 4), None).await);
    }

    pub async fn events_are_numbered_from_one(store: Store) {
        add(&store, run("r", None, 1, 1)).await;
        add(&store, run("s", None, 1, 2)).await;
        for expected in 1..=3 {
            let mut event = plain_event(State::Running, 0);
            store.add_event("r", &mut event).await.unwrap();
            assert_eq!(event.seq, expected);
        }
        let mut event = plain_event(State::Queued, 2);
        store.add_event("s", &mut event).await.unwrap();
        assert_eq!(event.seq, 1);
        let seqs: Vec<i64> = store.events("r", 1).await.unwrap().iter().map(|e| e.seq).collect();
        assert_eq!(seqs, [2, 3]);
        assert_eq!(store.events("s", 0).await.unwrap(), [event]);
    }

    pub async fn two_writers_number_events_without_gaps(store: Store) {
        add(&store, run("r", None, 1, 1)).await;
        let writer = |store: Store| async move {
            for _ in 0..25 {
                store.add_event("r", &mut plain_event(State::Running, 0)).await.unwrap();
            }
        };
        let (one, two) = (tokio::spawn(writer(store.clone())), tokio::spawn(writer(store.clone())));
        // A reader who asks for what is behind the last number gets all of them, in order.
        let mut seen = Vec::new();
        loop {
            let written = one.is_finished() && two.is_finished();
            let last = seen.last().copied().unwrap_or(0);
            seen.extend(store.events("r", last).await.unwrap().iter().map(|event| event.seq));
            if written {
                break;
            }
            tokio::task::yield_now().await;
        }
        one.await.unwrap();
        two.await.unwrap();
        assert_eq!(seen, (1..=50).collect::<Vec<i64>>());
    }

    pub async fn the_queue_is_fair(store: Store) {
        add(&store, run("background", None, 5, 1)).await;
        for (i, id) in ["a1", "a2", "a3"].iter().enumerate() {
            add(&store, run(id, Some("a"), 1, 2 + i as i64)).await;
        }
        add(&store, run("b1", Some("b"), 1, 9)).await;
        assert_eq!(
            (store.granted_to("a").await.unwrap().waiting, store.granted_to("none").await.unwrap().waiting),
            (3, 0)
        );
        let mut foretold = Vec::new();
        for id in ["background", "a1", "a2", "a3", "b1"] {
            foretold.push((store.runs_before(id, &usual()).await.unwrap().unwrap(), id));
        }
        foretold.sort_unstable();
        assert_eq!(foretold.iter().map(|(before, _)| *before).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
        let foretold: Vec<String> = foretold.into_iter().map(|(_, id)| id.to_owned()).collect();
        let mut served = Vec::new();
        while let Some(attempt) = begin(&store, "m").await {
            assert_eq!(store.running(&usual()).await.unwrap().len(), 1);
            assert!(end(&store, &attempt, State::Done, None).await);
            served.push(attempt.job);
        }
        assert_eq!(served, ["a1", "b1", "a2", "a3", "background"]);
        assert_eq!(foretold, served, "what the pages say about the queue is what happens");
        assert_eq!(store.runs_before("a1", &usual()).await.unwrap(), None, "it waits no more");
    }

    pub async fn places_are_right_where_many_wait(store: Store) {
        let mut foretold = Vec::new();
        for i in 0..240 {
            add(&store, run(&format!("r{i}"), Some(&format!("owner{}", i % 120)), 1, 1 + i)).await;
        }
        for i in 0..240 {
            let id = format!("r{i}");
            foretold.push((store.runs_before(&id, &usual()).await.unwrap().unwrap(), id));
        }
        foretold.sort_unstable();
        for (place, (before, id)) in foretold.iter().enumerate() {
            let attempt = begin(&store, "m").await.unwrap();
            assert_eq!((*before as usize, id), (place, &attempt.job));
            assert!(end(&store, &attempt, State::Done, None).await);
        }
    }

    pub async fn results_replace_those_of_an_earlier_attempt(store: Store) {
        let row = run("r", None, 1, 1);
        add(&store, row.clone()).await;
        store.add_blob("b", 1, "x").await.unwrap();
        let first = Handed { results: vec![(1, result("b", 5)), (0, result("a", 2))], ..handed() };
        assert!(end(&store, &begin(&store, "m").await.unwrap(), State::Done, Some(&first)).await);
        assert_eq!(store.results("r").await.unwrap(), [result("a", 2), result("b", 5)]);
        assert!(store.queue_again(&row, &fresh_stages(&row.spec.algorithms)).await.unwrap());
        let again = StoredResult { records: Some("b".into()), ..result("a", 4) };
        let second = Handed { results: vec![(0, again.clone())], ..handed() };
        assert!(end(&store, &begin(&store, "m").await.unwrap(), State::Done, Some(&second)).await);
        assert_eq!(store.results("r").await.unwrap(), [again, result("b", 5)]);
        assert_eq!(store.events("r", 0).await.unwrap()[0].seq, 1, "the log began anew");
        assert_eq!(store.result_rates("a", Query::Proximity, &usual()).await.unwrap(), [(100, 1e-6)]);
        assert_eq!(store.result_rates("a", Query::CollisionFirst, &usual()).await.unwrap(), []);
    }

    pub async fn the_newest_finished_featured_run_is_shown(store: Store) {
        for (id, featured) in [("old", true), ("new", true), ("plain", false), ("waiting", true)] {
            add(&store, RunRow { featured, ..run(id, None, 1, if id == "waiting" { 9 } else { 1 }) }).await;
        }
        // While none has ended, the newest that is to be measured.
        assert_eq!(store.newest_featured().await.unwrap().unwrap().id, "waiting");
        for id in ["old", "new", "plain"] {
            assert!(store.end_waiting_run(id, State::Done, None).await.unwrap());
            tokio::time::sleep(std::time::Duration::from_millis(2)).await;
        }
        assert_eq!(store.newest_featured().await.unwrap().unwrap().id, "new");
        assert_eq!(store.featured_count().await.unwrap(), 3);
    }
}

#[test]
fn numbers_come_back_from_json_to_the_last_bit() {
    let mut state = 0u64;
    for _ in 0..100_000 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // Of the sizes that lengths, shares and times have.
        let number = f64::from_bits((1003 + state % 40) << 52 | state >> 12);
        let again: f64 = from_json(&to_json(&number).unwrap()).unwrap();
        assert_eq!(again.to_bits(), number.to_bits(), "{number:e} became {again:e}");
    }
}
