//! Machines: their tokens and facts, prepared runs and whose turn they are.

use ocb_core::query::Query;

use super::super::*;
use super::attempts::tried;
use super::fixtures::{advice_info, workload};
use super::people::{NOTE, account};
use super::plugins::plugin;
use super::{StoredResult, add, end, fresh_stages, handed, result, run, usual, worker};
use crate::attempts::{Attempt, Kind};
use crate::machines::sql::worker as of;
use crate::model::{MachineFacts, RunSpec, State};
use crate::runs::accept::Handed;
use crate::runs::priority::{BACKGROUND, IDLE, INTERACTIVE};
use crate::runs::share::OfClass;
use crate::runs::sql::RunRow;
use crate::stability::runs_sql::StabilityRow;

fn facts(class: &str, kernel: &str) -> MachineFacts {
    MachineFacts {
        version: "1".into(),
        runner_sha256: "r".into(),
        plugins: vec!["p".into()],
        hardware_class: class.into(),
        cpu: "c".into(),
        kernel: kernel.into(),
        microcode: "0x1".into(),
        governor: "performance".into(),
        profile: "production".into(),
        partition: None,
    }
}

async fn prepare(store: &Store) -> Option<Attempt> {
    let attempt = store.begin_preparing(&worker("service")).await.unwrap()?;
    assert!(store.run_is_prepared(&attempt).await.unwrap());
    Some(attempt)
}

pub async fn a_token_is_that_of_one_machine_until_it_is_revoked(store: Store) {
    store.keep_machine("alpha", "one").await.unwrap();
    store.keep_machine("beta", "two").await.unwrap();
    assert_eq!(store.machine_of("one").await.unwrap().as_deref(), Some("alpha"));
    assert_eq!(store.machine_of("three").await.unwrap(), None);
    store.keep_machine("alpha", "three").await.unwrap();
    assert_eq!(store.machine_of("one").await.unwrap(), None, "another token replaces it");
    assert!(store.revoke_machine("alpha").await.unwrap() && !store.revoke_machine("alpha").await.unwrap());
    assert_eq!(store.machine_of("three").await.unwrap(), None);
    let all = store.machines().await.unwrap();
    let told: Vec<_> = all.iter().map(|it| (it.name.as_str(), it.revoked_us.is_some(), it.run.as_deref())).collect();
    assert_eq!(told, [("alpha", true, None), ("beta", false, None)]);
    store.keep_machine("alpha", "four").await.unwrap();
    assert_eq!(store.machine_of("four").await.unwrap().as_deref(), Some("alpha"));
}

pub async fn a_machine_that_has_changed_is_not_admitted(store: Store) {
    store.keep_machine("alpha", "one").await.unwrap();
    let seen = async |facts: &MachineFacts| store.machine_was_seen("alpha", facts).await.unwrap();
    assert_eq!(seen(&facts("x", "6.1")).await, None);
    assert_eq!(seen(&facts("x", "6.1")).await, None);
    assert_eq!(seen(&facts("y", "6.1")).await, Some("hardware class"));
    assert_eq!(seen(&facts("x", "6.2")).await, Some("kernel"));
    let slower = MachineFacts { governor: "powersave".into(), ..facts("x", "6.1") };
    assert_eq!(seen(&slower).await, Some("frequency governor"));
    let newer = MachineFacts { plugins: Vec::new(), version: "2".into(), ..facts("x", "6.1") };
    assert_eq!(seen(&newer).await, None, "what is installed may change");
    assert_eq!(store.machines().await.unwrap()[0].facts.as_ref(), Some(&newer));
    store.keep_machine("alpha", "two").await.unwrap();
    assert_eq!(seen(&facts("y", "6.2")).await, None, "it was allowed anew");
}

pub async fn prepared_runs_go_to_machines_in_turn(store: Store) {
    for n in 0..10 {
        add(&store, run(&format!("a{n}"), Some("a"), 1, n)).await;
    }
    add(&store, run("b", Some("b"), 1, 50)).await;
    assert!(store.begin_prepared_run(&of("m", "class"), "class").await.unwrap().is_none(), "nothing is prepared");
    let mut prepared = Vec::new();
    while let Some(attempt) = prepare(&store).await {
        prepared.push(attempt.job);
    }
    assert_eq!(prepared.len(), 9, "no more than eight of one visitor: {prepared:?}");
    assert_eq!(prepared.last().map(String::as_str), Some("b"));
    assert_eq!(store.waiting_for_machines(&usual()).await.unwrap(), 9);
    let mut begun = Vec::new();
    for machine in ["m", "n", "o"] {
        begun.push(store.begin_prepared_run(&of(machine, "class"), "class").await.unwrap().unwrap());
    }
    let jobs: Vec<_> = begun.iter().map(|attempt| attempt.job.as_str()).collect();
    assert_eq!(jobs, ["a0", "b", "a1"], "preparing takes nobody's turn");
    let row = store.run("a0").await.unwrap().unwrap();
    assert_eq!((row.state, row.attempts), (State::Running, 1), "preparing is no attempt");
    // What waits again stays prepared; what is asked for anew is not.
    assert!(store.put_back_run(&begun[0]).await.unwrap());
    assert_eq!(store.waiting_for_machines(&usual()).await.unwrap(), 7);
    assert!(end(&store, &begun[1], State::Done, None).await);
    let b = store.run("b").await.unwrap().unwrap();
    assert!(store.queue_again(&b, &fresh_stages(&b.spec.algorithms)).await.unwrap());
    assert_eq!(store.waiting_for_machines(&usual()).await.unwrap(), 7);
}

pub async fn runs_go_to_machines_of_their_hardware_class(store: Store) {
    let named = |id: &str, class: Option<&str>, created_us| {
        let plain = run(id, Some("a"), 1, created_us);
        RunRow { spec: RunSpec { hardware_class: class.map(str::to_owned), ..plain.spec.clone() }, ..plain }
    };
    for n in 0..9 {
        add(&store, named(&format!("new{n}"), Some("new"), n)).await;
    }
    add(&store, named("any", None, 20)).await;
    add(&store, named("usual", Some("class"), 21)).await;
    let mut prepared = Vec::new();
    while let Some(attempt) = prepare(&store).await {
        prepared.push(attempt.job);
    }
    assert_eq!(prepared.len(), 10, "eight of one class, and those of another are not behind them: {prepared:?}");
    let new = OfClass { class: "new".into(), usual: "class".into() };
    assert_eq!(
        (store.waiting_for_machines(&usual()).await.unwrap(), store.waiting_for_machines(&new).await.unwrap()),
        (2, 8)
    );
    assert_eq!((store.waiting(1, &usual()).await.unwrap().0, store.waiting(1, &new).await.unwrap().0), (2, 9));
    assert_eq!(
        store.runs_before("usual", &usual()).await.unwrap(),
        Some(1),
        "those of the other class are not before it"
    );
    assert_eq!(store.runs_before("new2", &new).await.unwrap(), Some(2));
    let next = async |machine: &str, class: &str, usual: &str| {
        store.begin_prepared_run(&of(machine, class), usual).await.unwrap().map(|attempt| attempt.job)
    };
    assert_eq!(next("m", "class", "class").await.as_deref(), Some("any"));
    assert_eq!(next("n", "new", "class").await.as_deref(), Some("new0"));
    assert_eq!(next("o", "other", "class").await, None);
    assert_eq!((store.running(&usual()).await.unwrap().len(), store.running(&new).await.unwrap().len()), (1, 1));
    assert_eq!(store.runs_before("new2", &new).await.unwrap(), Some(2), "one of them is under way");
    assert_eq!(next("m", "class", "class").await.as_deref(), Some("usual"));
    assert_eq!(next("m", "class", "class").await, None, "the others are for other machines");
    // The usual class has become another one: what names its class keeps it, what names none follows.
    add(&store, named("later", None, 22)).await;
    prepare(&store).await.unwrap();
    assert_eq!(next("m", "class", "new").await, None);
    assert_eq!(next("n", "new", "new").await.as_deref(), Some("new1"));
}

pub async fn what_waits_is_counted_by_priority_and_class_and_the_oldest_is_found(store: Store) {
    assert_eq!(
        (store.waiting_in_all(BACKGROUND).await.unwrap(), store.oldest_seconds().await.unwrap()),
        ((0, 0.0), 0.0)
    );
    let ago = |seconds: i64| now_us() - seconds * 1_000_000;
    let add_run = async |id: &str, priority, seconds, class: Option<&str>| {
        let plain = run(id, Some("a"), priority, ago(seconds));
        let spec = RunSpec { hardware_class: class.map(str::to_owned), ..plain.spec.clone() };
        add(&store, RunRow { spec, ..plain }).await;
    };
    add_run("idle", IDLE, 4000, None).await;
    add_run("new", INTERACTIVE, 1000, Some("new")).await;
    let oldest = async || (store.oldest_seconds().await.unwrap() / 100.0).round() * 100.0;
    assert_eq!(oldest().await, 1000.0, "idle work does not count");
    add_run("background", BACKGROUND, 2000, None).await;
    assert_eq!(oldest().await, 2000.0);
    add_run("usual", INTERACTIVE, 3000, Some("class")).await;
    assert_eq!(oldest().await, 3000.0);
    let new = OfClass { class: "new".into(), usual: "class".into() };
    assert_eq!(store.waiting_in_all(BACKGROUND).await.unwrap(), (3, 4.5));
    assert_eq!(store.waiting_in_all(INTERACTIVE).await.unwrap(), (2, 3.0));
    assert_eq!(store.waiting(BACKGROUND, &usual()).await.unwrap(), (2, 3.0));
    assert_eq!(store.waiting(INTERACTIVE, &usual()).await.unwrap(), (1, 1.5));
    assert_eq!(store.waiting(BACKGROUND, &new).await.unwrap(), (1, 1.5));
}

pub async fn rates_are_those_of_the_hardware_class_or_of_any(store: Store) {
    for (id, class, seconds) in [("r", None, 1e-6), ("s", Some("new".to_owned()), 3e-6)] {
        let row = run(id, None, 1, 1);
        add(&store, RunRow { spec: RunSpec { hardware_class: class, ..row.spec.clone() }, ..row }).await;
        let of_run = StoredResult { seconds_per_query: Some(seconds), ..result("a", 5) };
        let class = if id == "r" { "class" } else { "new" };
        prepare(&store).await.unwrap();
        let attempt = store.begin_prepared_run(&of(id, class), "class").await.unwrap().unwrap();
        let handed = Handed { results: vec![(0, of_run)], ..handed() };
        assert!(end(&store, &attempt, State::Done, Some(&handed)).await);
    }
    let rates = async |class: &str, usual: &str| {
        let on = OfClass { class: class.into(), usual: usual.into() };
        store.result_rates("a", Query::Proximity, &on).await.unwrap().iter().map(|rate| rate.1).collect::<Vec<_>>()
    };
    assert_eq!(rates("class", "class").await, [1e-6]);
    assert_eq!(rates("new", "class").await, [3e-6]);
    assert_eq!(rates("third", "class").await, [3e-6, 1e-6], "the newest first");
}

pub async fn a_machine_reaches_its_own_attempt_alone(store: Store) {
    store.keep_machine("m", "one").await.unwrap();
    add(&store, run("r", Some("a"), 1, 1)).await;
    prepare(&store).await.unwrap();
    let mine = store.begin_prepared_run(&of("m", "class"), "class").await.unwrap().unwrap();
    assert_eq!(store.attempt_of("m", &mine.id).await.unwrap(), Some(mine.clone()));
    assert_eq!(store.attempt_of("n", &mine.id).await.unwrap(), None);
    assert_eq!(store.attempt_of("machine m", &mine.id).await.unwrap(), None);
    assert_eq!(store.machines().await.unwrap()[0].run.as_deref(), Some("r"));
    // A service that starts believes no machine dead.
    assert!(store.silent_attempts(Some(&worker("service"))).await.unwrap().is_empty());
    assert!(store.withdraw_run("r", &worker("service"), State::Cancelled, None).await.unwrap());
    assert_eq!(store.attempt_of("m", &mine.id).await.unwrap(), None, "it has ended");
    assert!(!store.beat(&mine.id).await.unwrap());
    assert!(store.machines().await.unwrap()[0].run.is_none());
}

pub async fn errands_wait_for_machines_of_the_usual_class_and_idle_runs_give_way_to_them(store: Store) {
    let me = of("alpha", "class");
    add(&store, run("idle", None, IDLE, 1)).await;
    let idle = store.begin_preparing_idle(&worker("service")).await.unwrap().unwrap();
    assert!(store.run_is_prepared(&idle).await.unwrap());
    store.begin_prepared_run(&me, "class").await.unwrap().expect("the idle run");
    let other = OfClass { class: "new".into(), usual: "class".into() };
    let waiting = async |of: &OfClass| store.waiting_for_machines(of).await.unwrap();
    assert_eq!((waiting(&usual()).await, store.gives_way("idle", "class").await.unwrap()), (0, false));

    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_blob("f", 1, "x").await.unwrap();
    assert!(store.add_plugin(&plugin("p", "1", "f"), NOTE).await.unwrap());
    assert_eq!((waiting(&usual()).await, store.gives_way("idle", "class").await.unwrap()), (1, true));
    assert!(store.add_stability_run(&tried("s")).await.unwrap());
    assert!(store.add_stability_run(&StabilityRow { priority: IDLE, ..tried("unasked") }).await.unwrap());
    assert!(store.add_workload(&workload("w", "me", "f")).await.unwrap());
    assert!(store.add_advice(&advice_info("v"), Some("me"), "me").await.unwrap());
    assert!(!store.add_advice(&advice_info("v"), Some("me"), "me").await.unwrap(), "it is there");
    assert!(store.add_advice(&advice_info("own"), None, "").await.unwrap());
    assert_eq!((waiting(&usual()).await, waiting(&other).await), (4, 0));

    // What a machine is at does not wait.
    let kind = async || store.last_kind_of(&me).await.unwrap();
    assert_eq!((kind().await, store.last_kind_of(&of("beta", "class")).await.unwrap()), (Some(Kind::Measure), None));
    store.begin_check(&me).await.unwrap().expect("the check");
    assert_eq!((waiting(&usual()).await, kind().await), (3, Some(Kind::Check)));
    let (part, _) = store.begin_part(INTERACTIVE, &me).await.unwrap().expect("the part");
    assert_eq!(waiting(&usual()).await, 2);
    store.begin_replay(&me).await.unwrap().expect("the replay");
    assert_eq!(waiting(&usual()).await, 1);
    assert!(store.end_waiting_advice(&advice_info("v")).await.unwrap());
    assert!(!store.end_waiting_advice(&advice_info("v")).await.unwrap(), "once");
    assert_eq!((waiting(&usual()).await, store.gives_way("idle", "class").await.unwrap()), (0, false));
    // A stability run that has begun waits between two parts.
    store.put_back_part(&part).await.unwrap();
    assert_eq!(waiting(&usual()).await, 1);
    assert_eq!(store.idle_runs().await.unwrap(), 2, "the run, and the stability run that nobody asked for");
}
