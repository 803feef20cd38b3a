//! Attempts: one at a time, renewed by the database's clock, accepted once.

use std::collections::HashSet;

use super::super::*;
use super::people::{NOTE, account};
use super::plugins::{ended_check, plugin};
use super::rows::*;
use super::{
    add, advice_info, begin, end, fresh_stages, handed, plain_event, run, set_info, spec, worker, workload,
    workload_result,
};
use crate::attempts::{Attempt, Kind, LEASE_US, MOST_LOST};
use crate::model::{AdviceInfo, CheckLine, CheckVerdict, PluginState, Preview, RunSpec, StabilitySpec, State};
use crate::runs::accept::Handed;
use crate::runs::priority::INTERACTIVE;
use crate::stability::runs_sql::StabilityRow;
use crate::workloads::sql::WorkloadRow;

/// Puts a clock in the place of the database's that only this test moves.
pub async fn stopped_clock(store: &Store) {
    let texts = [
        "DROP VIEW database_clock",
        "CREATE TABLE database_clock (now_us BIGINT NOT NULL)",
        "INSERT INTO database_clock (now_us) VALUES (1000)",
    ];
    let mut connection = store.pool.acquire().await.unwrap();
    for text in texts {
        sqlx::query(text).execute(&mut *connection).await.unwrap();
    }
}

pub async fn pass(store: &Store, us: i64) {
    let mut connection = store.pool.acquire().await.unwrap();
    // A connection of SQLite's that has not read since then believes that this is still the view.
    sqlx::query("SELECT now_us FROM database_clock").execute(&mut *connection).await.unwrap();
    let text = "UPDATE database_clock SET now_us = now_us + $1";
    sqlx::query(text).bind(us).execute(&mut *connection).await.unwrap();
}

async fn silent(store: &Store, just_started: Option<&str>) -> Vec<String> {
    let worker = just_started.map(worker);
    let silent = store.silent_attempts(worker.as_ref()).await.unwrap();
    silent.into_iter().map(|attempt| attempt.job).collect()
}

pub async fn a_lease_is_counted_by_the_databases_clock(store: Store) {
    let now = "SELECT now_us FROM database_clock";
    let now: i64 = sqlx::query_scalar(now).fetch_one(&store.pool).await.unwrap();
    assert!((now - now_us()).abs() < 60_000_000, "{now}");
    // Far from that of this process, so that a statement that asked this process would be noticed.
    stopped_clock(&store).await;
    for id in ["r", "s"] {
        add(&store, run(id, None, 1, 1)).await;
    }
    let (one, other) = (begin(&store, "m").await.unwrap(), begin(&store, "n").await.unwrap());
    assert_eq!((one.job.as_str(), one.number, other.job.as_str()), ("r", 1, "s"));
    pass(&store, LEASE_US).await;
    assert!(silent(&store, None).await.is_empty());
    assert!(store.beat(&one.id).await.unwrap());
    pass(&store, 1).await;
    assert_eq!(silent(&store, None).await, ["s"], "this one was silent for longer than its lease");
    // It beats again before the lost lease was noticed.
    assert!(store.beat(&other.id).await.unwrap());
    assert_eq!(store.lose_run(&other, None).await.unwrap(), None);
    pass(&store, LEASE_US + 1).await;
    assert_eq!(store.lose_run(&other, None).await.unwrap(), Some(State::Queued));
    assert!(!store.beat(&other.id).await.unwrap(), "it has ended");
    assert_eq!(store.run("s").await.unwrap().unwrap().state, State::Queued);
}

pub async fn a_clock_that_jumps_loses_no_run_and_keeps_no_dead_worker(store: Store) {
    const HOUR: i64 = 3_600_000_000;
    stopped_clock(&store).await;
    pass(&store, 2 * HOUR).await;
    add(&store, run("r", None, 1, 1)).await;
    let dead = begin(&store, "m").await.unwrap();
    // Back by an hour: the worker has died, and its lease would last as long.
    pass(&store, -HOUR).await;
    store.shorten_leases().await.unwrap();
    assert!(silent(&store, None).await.is_empty(), "nobody who is alive is taken for dead");
    pass(&store, LEASE_US + 1).await;
    assert_eq!(silent(&store, None).await, ["r"]);
    assert_eq!(store.lose_run(&dead, None).await.unwrap(), Some(State::Queued));
    // Forward by an hour: whoever does not beat before it is noticed has lost the run, and its result is refused.
    let late = begin(&store, "m").await.unwrap();
    pass(&store, HOUR).await;
    assert_eq!(store.lose_run(&late, None).await.unwrap(), Some(State::Queued));
    let current = begin(&store, "n").await.unwrap();
    assert!(!end(&store, &late, State::Done, None).await, "too late");
    assert!(end(&store, &current, State::Done, None).await, "once");
}

pub async fn who_starts_takes_back_its_own_alone(store: Store) {
    for id in ["r", "s"] {
        add(&store, run(id, None, 1, 1)).await;
    }
    let (mine, theirs) = (begin(&store, "m").await.unwrap(), begin(&store, "n").await.unwrap());
    assert_eq!(silent(&store, Some("m")).await, ["r"]);
    let me = worker("m");
    assert_eq!(store.lose_run(&theirs, None).await.unwrap(), None, "its lease is not over");
    assert_eq!(store.lose_run(&mine, Some(&me)).await.unwrap(), Some(State::Queued));
    assert_eq!(store.lose_run(&mine, Some(&me)).await.unwrap(), None, "once");
    assert_eq!((silent(&store, Some("m")).await.len(), store.beat(&theirs.id).await.unwrap()), (0, true));
    let states = (store.run("r").await.unwrap().unwrap().state, store.run("s").await.unwrap().unwrap().state);
    assert_eq!(states, (State::Queued, State::Running));
    // Followers hear of it.
    assert_eq!(store.events("r", 0).await.unwrap().last().map(|event| event.state), Some(State::Queued));
}

pub async fn a_lost_attempts_result_is_refused_and_leaves_nothing(store: Store) {
    store.add_blob("b", 1, "x").await.unwrap();
    add(&store, run("r", None, 1, 1)).await;
    let lost = begin(&store, "m").await.unwrap();
    store.lose_run(&lost, Some(&worker("m"))).await.unwrap();
    let current = begin(&store, "n").await.unwrap();
    assert_eq!((current.job.as_str(), current.number), ("r", 2));
    let before = (store.run("r").await.unwrap(), store.stages("r").await.unwrap(), store.events("r", 0).await.unwrap());

    // The worker of the first goes on: it writes stages and events, notes its set and its draw, puts back, hands in.
    let mut stages = fresh_stages(&spec().algorithms);
    stages[2].done = 9;
    let mut event = plain_event(State::Running, 0);
    assert!(!store.tell(&lost, &[(2, &stages[2])], &mut event).await.unwrap());
    assert!(!store.set_of_run(&lost, &set_info(), "b").await.unwrap());
    assert!(!store.spec_of_run(&lost, &RunSpec { passes: 9, ..spec() }).await.unwrap());
    assert!(!store.put_back_run(&lost).await.unwrap());
    assert!(!end(&store, &lost, State::Done, Some(&handed())).await);
    let after = (store.run("r").await.unwrap(), store.stages("r").await.unwrap(), store.events("r", 0).await.unwrap());
    assert_eq!((before, store.results("r").await.unwrap().len()), (after, 0));

    // Of the current one all of it counts, once.
    assert!(store.tell(&current, &[(2, &stages[2])], &mut event).await.unwrap());
    assert_eq!(store.stages("r").await.unwrap()[2].done, 9);
    let preview = Preview {
        n: 5,
        of: 9,
        precision: 0.05,
        looks: 1,
        settled: false,
        beside: Vec::new(),
        finding: "f".into(),
        more: "m".into(),
    };
    let all = Handed { preview: Some(preview), ..handed() };
    assert!(end(&store, &current, State::Done, Some(&all)).await);
    assert!(!end(&store, &current, State::Failed, None).await);
    let row = store.run("r").await.unwrap().unwrap();
    assert_eq!((row.state, row.attempts, row.preview), (State::Done, 2, all.preview.clone()));
    assert_eq!(store.results("r").await.unwrap().len(), 2);
    let events = store.events("r", event.seq).await.unwrap();
    let told: Vec<(State, Option<&str>)> =
        events.iter().map(|e| (e.state, e.result.as_ref().map(|result| result.algorithm.as_str()))).collect();
    assert_eq!(told, [(State::Running, Some("a")), (State::Running, Some("b")), (State::Done, None)]);
}

pub async fn interrupted_runs_are_tried_three_times(store: Store) {
    add(&store, run("r", None, 1, 1)).await;
    let me = worker("m");
    for attempts in 1..MOST_LOST {
        let attempt = begin(&store, "m").await.unwrap();
        assert_eq!(store.lose_run(&attempt, Some(&me)).await.unwrap(), Some(State::Queued));
        assert_eq!(i64::from(store.run("r").await.unwrap().unwrap().attempts), attempts);
    }
    let stopped = begin(&store, "m").await.unwrap();
    assert!(store.put_back_run(&stopped).await.unwrap());
    assert_eq!(store.run("r").await.unwrap().unwrap().attempts, 2, "a wanted stop is no attempt");
    let last = begin(&store, "m").await.unwrap();
    assert_eq!(last.number, 4);
    assert_eq!(store.lose_run(&last, Some(&me)).await.unwrap(), Some(State::Failed));
    let failed = store.run("r").await.unwrap().unwrap();
    assert!(failed.state == State::Failed && failed.finished_us.is_some());
    assert!(failed.message.unwrap().contains("3 times"));
    assert_eq!(store.events("r", 0).await.unwrap().last().map(|event| event.state), Some(State::Failed));
    assert_eq!(begin(&store, "m").await, None);
}

pub async fn two_workers_never_begin_the_same(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    for i in 0..20 {
        add(&store, run(&format!("r{i:02}"), None, 1, i)).await;
    }
    for i in 0..4 {
        let id = format!("p{i}");
        store.add_blob(&id, 1, "x").await.unwrap();
        assert!(store.add_plugin(&plugin(&id, "1", &id), NOTE).await.unwrap());
        assert!(store.add_stability_run(&tried(&format!("s{i}"))).await.unwrap());
        assert!(store.add_workload(&workload(&format!("w{i}"), "me", "f")).await.unwrap());
    }
    let both = ["m", "n"].map(|machine| {
        let (store, worker) = (store.clone(), worker(machine));
        tokio::spawn(async move {
            let mut begun = Vec::new();
            while let Some(attempt) = store.begin_run(&worker).await.unwrap() {
                begun.push(attempt.job);
            }
            while let Some((attempt, _)) = store.begin_check(&worker).await.unwrap() {
                begun.push(attempt.job);
            }
            while let Some((attempt, _)) = store.begin_part(1, &worker).await.unwrap() {
                begun.push(attempt.job);
            }
            while let Some((attempt, _)) = store.begin_replay(&worker).await.unwrap() {
                begun.push(attempt.job);
            }
            begun
        })
    });
    let [one, two] = both;
    let all = [one.await.unwrap(), two.await.unwrap()].concat();
    assert_eq!(all.len(), 32, "everything is begun, although both choose the same one now and then");
    assert_eq!(all.iter().collect::<HashSet<_>>().len(), 32, "nothing is begun twice");
}

pub(crate) fn tried(id: &str) -> StabilityRow {
    StabilityRow {
        id: id.into(),
        owner: Some("me".into()),
        turn: "me".into(),
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
    }
}

/// A job that is ended at another service ends at once, and its worker's result is refused.
pub async fn a_job_is_withdrawn_from_another_worker_alone(store: Store) {
    let (me, other) = (worker("m"), worker("n"));
    add(&store, run("r", None, 1, 1)).await;
    let attempt = begin(&store, "m").await.unwrap();
    let cancelled = |here| store.withdraw_run("r", here, State::Cancelled, Some("why"));
    assert!(!cancelled(&me).await.unwrap(), "its own work it stops itself");
    assert!(cancelled(&other).await.unwrap() && !cancelled(&other).await.unwrap());
    assert!(!store.beat(&attempt.id).await.unwrap());
    assert!(!end(&store, &attempt, State::Done, Some(&handed())).await);
    let row = store.run("r").await.unwrap().unwrap();
    assert_eq!((row.state, row.message.as_deref(), row.finished_us.is_some()), (State::Cancelled, Some("why"), true));
    assert_eq!(store.events("r", 0).await.unwrap().last().map(|event| event.state), Some(State::Cancelled));

    assert!(store.add_advice(&advice_info("v"), Some("me"), "turn").await.unwrap());
    let (advice, _) = store.begin_advice(false, &me).await.unwrap().unwrap();
    let ended = AdviceInfo { state: State::Cancelled, ..advice_info("v") };
    assert!(!store.withdraw_advice(&ended, &me).await.unwrap() && store.withdraw_advice(&ended, &other).await.unwrap());
    assert!(!store.end_advice(&advice, &advice_info("v"), &Default::default()).await.unwrap());
    assert_eq!(store.advice("v").await.unwrap().unwrap().info.state, State::Cancelled);
    assert_eq!(store.next_advice(false).await.unwrap(), None);
}

pub async fn visitors_take_turns_whatever_they_wait_for(store: Store) {
    store.add_blob("f", 1, "x").await.unwrap();
    let me = worker("m");
    let in_turn = async || store.in_turn(&me, None).await.unwrap();
    assert_eq!(in_turn().await, [Kind::Measure], "nothing waits, or a run does");
    for n in 0..3 {
        add(&store, run(&format!("a{n}"), Some("a"), 1, n)).await;
        add(&store, run(&format!("b{n}"), Some("b"), 1, 10 + n)).await;
    }
    // One visitor asks for all that there is, again and again.
    for n in 0..3 {
        assert!(store.add_advice(&advice_info(&format!("v{n}")), Some("me"), "greedy").await.unwrap());
    }
    assert!(
        store.add_stability_run(&StabilityRow { turn: "greedy".into(), created_us: 30, ..tried("s") }).await.unwrap()
    );
    assert!(
        store
            .add_workload(&WorkloadRow { turn: "greedy".into(), created_us: 40, ..workload("w", "me", "f") })
            .await
            .unwrap()
    );

    let mut served = String::new();
    while let Some(kind) = in_turn().await.first() {
        let attempt = match kind {
            Kind::Measure => store.begin_run(&me).await.unwrap(),
            Kind::Stability => store.begin_part(INTERACTIVE, &me).await.unwrap().map(|(part, _)| part),
            Kind::Replay => store.begin_replay(&me).await.unwrap().map(|(replay, _)| replay),
            _ => store.begin_advice(false, &me).await.unwrap().map(|(advice, _)| advice),
        };
        let Some(attempt) = attempt else { break };
        served.push_str(if matches!(kind, Kind::Measure) { &attempt.job[..1] } else { "." });
    }
    assert_eq!(served, "ab.ab.ab...", "each turn of the greedy one comes behind one of everybody else");

    // Runs that nobody waits for come last.
    add(&store, run("own", None, 5, 1)).await;
    assert!(store.add_advice(&advice_info("late"), Some("me"), "greedy").await.unwrap());
    assert_eq!(in_turn().await, [Kind::Advise, Kind::Measure]);
}

/// The first attempt at a check, a stability part, a replay and advice is lost; what its worker says then changes nothing.
pub async fn lost_checks_parts_and_advice_change_nothing(store: Store) {
    store.add_account(&account("1", "ada"), "hash").await.unwrap();
    store.add_blob("f", 1, "x").await.unwrap();
    assert!(store.add_plugin(&plugin("p", "1", "f"), NOTE).await.unwrap());
    assert!(store.add_stability_run(&tried("s")).await.unwrap());
    let (me, other) = (worker("m"), worker("n"));
    let (check, _) = store.begin_check(&me).await.unwrap().unwrap();
    let (part, _) = store.begin_part(1, &me).await.unwrap().unwrap();
    assert!(store.add_workload(&workload("w", "me", "f")).await.unwrap());
    let (replay, _) = store.begin_replay(&me).await.unwrap().unwrap();
    store.replay_is_at("w", 5, Some("It is doing something.")).await.unwrap();
    assert!(store.add_advice(&advice_info("v"), Some("me"), "turn").await.unwrap());
    let (advice, _) = store.begin_advice(false, &me).await.unwrap().unwrap();
    assert!(store.note_vetted(&check).await.unwrap());
    assert!(
        store.begin_advice(false, &other).await.unwrap().is_none(),
        "a second service takes up nothing of the first"
    );
    assert!(store.lose_check(&check, Some(&me)).await.unwrap());
    for attempt in [&part, &replay, &advice] {
        assert!(store.lose(attempt, Some(&me)).await.unwrap());
    }
    assert_eq!(store.plugin("p").await.unwrap().unwrap().state, PluginState::Uploaded);
    assert!(store.next_advice(false).await.unwrap().is_some());

    let line =
        CheckLine { check: "c".into(), verdict: CheckVerdict::Pass, evidence: "e".into(), hint: None, repro: None };
    let second: Attempt = store.begin_check(&other).await.unwrap().unwrap().0;
    assert!(!store.add_line(&check, 1, &line).await.unwrap() && !store.note_vetted(&check).await.unwrap());
    assert!(!store.put_back_check(&check).await.unwrap());
    assert!(!ended_check(&store, &check, PluginState::Failed).await);
    assert!(store.lines("p").await.unwrap().is_empty());
    assert!(store.add_line(&second, 1, &line).await.unwrap());
    assert!(ended_check(&store, &second, PluginState::Validated).await);
    assert!(!ended_check(&store, &second, PluginState::Failed).await);
    assert_eq!(store.plugin("p").await.unwrap().unwrap().state, PluginState::Validated);

    let second = store.begin_part(1, &other).await.unwrap().unwrap().0;
    let found = super::stability_of(1);
    assert_eq!(store.accept_part(&part, &["x".into()], &found, 1.0).await.unwrap(), None);
    assert!(!store.give_up_part(&part, State::Failed, None).await.unwrap());
    assert!(store.stability_run("s").await.unwrap().unwrap().done.is_empty());
    let ended = store.accept_part(&second, &["x".into()], &found, 1.0).await.unwrap();
    assert_eq!(ended, Some(true), "it was the last one");

    let (second, row) = store.begin_replay(&other).await.unwrap().unwrap();
    assert_eq!((row.attempts, row.done), (2, 0), "it begins anew");
    let found = workload_result();
    assert!(!store.accept_replay(&replay, &found, "table", None).await.unwrap());
    assert!(!store.give_up_replay(&replay, State::Failed, None).await.unwrap());
    assert_eq!(store.workload_table("w").await.unwrap(), None);
    assert!(store.accept_replay(&second, &found, "table", Some("smaller")).await.unwrap());
    assert!(!store.accept_replay(&second, &found, "other", None).await.unwrap());
    assert_eq!(store.workload_table("w").await.unwrap().as_deref(), Some("table"));
    assert_eq!(store.workload_result("w").await.unwrap(), Some(found));

    let (second, row) = store.begin_advice(false, &other).await.unwrap().unwrap();
    assert_eq!(row.attempts, 2, "one was lost");
    assert!(!store.end_advice(&advice, &advice_info("v"), &Default::default()).await.unwrap());
    assert!(store.end_advice(&second, &advice_info("v"), &[vec![], vec![]]).await.unwrap());
    let paper = StoredPaper { mesh: "m".into(), certificate: "c".into(), file: "f".into() };
    assert!(!store.end_advice(&second, &advice_info("v"), &[vec![paper], vec![]]).await.unwrap());
}
