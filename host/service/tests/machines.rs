//! What a measuring machine may ask of its service, and what of its results is believed. The machine is this process.

#[path = "machines/classes.rs"]
mod classes;
mod common;
#[path = "machines/errands.rs"]
mod errands;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use ocb_core::query::Query;
use ocb_core::statistics::{Outliers, Statistic};
use ocb_service::model::{
    AccountInfo, AlgorithmResult, Claim, Ended, HeatmapRequest, MachineFacts, MachineState, Measure, MeasuredAlgorithm,
    NextWork, OutcomeName, PluginState, Role, RunInfo, RunSpec, Sentinel, State, Told, WorkOrder,
};
use ocb_service::worker::{Handed, Seen, Worker};
use ocb_service::{Ceilings, Engine, EngineConfig, EngineError, Handing, Profile, Stop, Visitor};
use tempfile::TempDir;
use tokio::runtime::Handle;
use tokio::sync::{Mutex, MutexGuard};

/// No wait for work.
const NOW: Duration = Duration::ZERO;

/// One measures at a time on a machine, and an engine that is opened meanwhile sees fewer CPUs.
async fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::const_new(());
    ALONE.lock().await
}

fn config(data: &Path) -> EngineConfig {
    EngineConfig { elsewhere: true, quick_checks: true, ..common::config(data) }
}

fn small(algorithms: &[&str]) -> RunSpec {
    let algorithms = algorithms.iter().map(|name| (*name).to_owned()).collect();
    RunSpec { algorithms, budget_seconds: 5.0, ..common::spec("proximity", 40, 1) }
}

/// A service on a folder of its own, which is there as long as the first of the three, and the machine that it has allowed.
async fn site() -> ((MutexGuard<'static, ()>, TempDir), Engine, Worker) {
    let here = (alone().await, tempfile::tempdir().unwrap());
    let engine = Engine::open(config(here.1.path())).await.unwrap();
    engine.add_machine("alpha").await.unwrap();
    let worker = common::here(&config(here.1.path()));
    (here, engine, worker)
}

/// The next order, which comes once the run is prepared.
async fn order(engine: &Engine, machine: &str, facts: &MachineFacts) -> WorkOrder {
    let order = common::next(engine, machine, facts, Duration::from_secs(60)).await.unwrap();
    order.expect("a run is prepared within a minute")
}

async fn hand_in(engine: &Engine, machine: &str, order: &WorkOrder, Handed { ended, files }: Handed) -> bool {
    engine.hand_in(machine, &order.attempt, Handing { ended, files }).await.unwrap()
}

async fn state(engine: &Engine, run: &RunInfo) -> State {
    engine.run(&run.id, None).await.unwrap().state
}

#[tokio::test(flavor = "multi_thread")]
async fn results_of_something_else_are_refused_and_those_of_the_order_kept_once() {
    let (_here, engine, worker) = site().await;
    engine.add_machine("beta").await.unwrap();
    let run = engine.submit(small(&["box-tree", "brute-force"]), None).await.unwrap();
    let order = order(&engine, "alpha", worker.facts()).await;
    assert_eq!((order.run.as_str(), order.draw.secret.as_deref()), (run.id.as_str(), None), "the secret stays here");
    assert!(common::next(&engine, "beta", worker.facts(), NOW).await.unwrap().is_none(), "nobody else gets it");
    // Another machine reaches nothing of it, and this machine nothing but what the order names.
    for (machine, name) in [("beta", "a"), ("alpha", "../../lock"), ("alpha", "plugin-"), ("alpha", "c")] {
        let refused = engine.file_of_order(machine, &order.attempt, name).await;
        assert!(matches!(refused, Err(EngineError::NotFound(_))), "{machine} {name}");
    }
    assert!(!engine.beat_of("beta", &order.attempt, Vec::new()).await.unwrap());
    let (_, handed) = common::measured(&engine, "alpha", worker, &order).await;
    let Ended::Measured { algorithms, environment, preview } = &handed.ended else { panic!("it was measured") };
    let with = |change: &dyn Fn(&mut Vec<ocb_service::model::MeasuredAlgorithm>)| {
        let mut algorithms = algorithms.clone();
        change(&mut algorithms);
        Ended::Measured { algorithms, environment: environment.clone(), preview: preview.clone() }
    };
    let wrong = [
        (with(&|all| all.truncate(1)), "a file too many"),
        (with(&|all| all.clear()), "a file too many"),
        (with(&|all| all.swap(0, 1)), "was not ordered"),
        (with(&|all| all[1].plugin_sha256 = "0".repeat(64)), "measured from another file"),
        (with(&|all| all[0].triangle_tests = !all[0].triangle_tests), "file"),
    ];
    for (ended, words) in wrong {
        let files = handed.files.clone();
        let refused = engine.hand_in("alpha", &order.attempt, Handing { ended, files }).await;
        assert!(matches!(&refused, Err(EngineError::Invalid(why)) if why.contains(words)), "{words}: {refused:?}");
    }
    let mut elsewhere = environment.clone().expect("it was measured");
    elsewhere.hardware_class = "0123456789abcdef".into();
    let ended = Ended::Measured { algorithms: algorithms.clone(), environment: Some(elsewhere), preview: None };
    let refused = engine.hand_in("alpha", &order.attempt, Handing { ended, files: handed.files.clone() }).await;
    assert!(matches!(&refused, Err(EngineError::Invalid(why)) if why.contains("hardware class")), "{refused:?}");
    let none = Ended::Measured { algorithms: Vec::new(), environment: None, preview: None };
    let refused = engine.hand_in("alpha", &order.attempt, Handing { ended: none, files: Vec::new() }).await;
    assert!(matches!(&refused, Err(EngineError::Invalid(why)) if why.contains("another number")), "{refused:?}");
    let mut files = handed.files.clone();
    files.pop();
    let refused = engine.hand_in("alpha", &order.attempt, Handing { ended: handed.ended.clone(), files }).await;
    assert!(matches!(&refused, Err(EngineError::Invalid(why)) if why.contains("is missing")), "{refused:?}");
    // Files that are no records.
    let files = vec![b"PAR1".to_vec(); handed.files.len()];
    let refused = engine.hand_in("alpha", &order.attempt, Handing { ended: handed.ended.clone(), files }).await;
    assert!(matches!(refused, Err(EngineError::Invalid(_))), "{refused:?}");
    assert_eq!(state(&engine, &run).await, State::Running);
    let told = Told::Progress { place: 0, done: 7, total: 9, worked_us: 1000 };
    assert!(engine.beat_of("alpha", &order.attempt, vec![told, Told::Waiting { waiting: true }]).await.unwrap());
    let stages = engine.run(&run.id, None).await.unwrap().stages;
    assert_eq!((stages[2].done, stages[2].total, stages[2].message.is_some()), (7, 9, true));
    let again = Handed { ended: handed.ended.clone(), files: handed.files.clone() };
    assert!(!hand_in(&engine, "beta", &order, again).await, "another machine cannot hand in for it");
    let again = Handed { ended: handed.ended.clone(), files: handed.files.clone() };
    assert!(hand_in(&engine, "alpha", &order, handed).await);
    assert!(!hand_in(&engine, "alpha", &order, again).await, "once");
    let run = engine.run(&run.id, None).await.unwrap();
    assert_eq!((run.state, run.results.len()), (State::Done, 2));
    assert!(run.results.iter().all(|result| result.rank.is_some() && result.wrong == 0), "{:?}", run.results);
    let draw = run.environment.unwrap().draw.unwrap();
    assert_eq!((draw.seed, draw.secret.is_some()), (order.draw.seed, true), "published with the result");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_a_machine_has_found_so_far_is_seen_and_nothing_of_something_else() {
    let (_here, engine, worker) = site().await;
    let spec = RunSpec { method: common::spec("collision_first", 300, 7).method, ..small(&["parry", "box-tree"]) };
    let run = engine.submit(spec, Some("me")).await.unwrap();
    let order = order(&engine, "alpha", worker.facts()).await;
    let (looks, attempt, of) = (engine.clone(), order.attempt.clone(), run.id.clone());
    let seen = Arc::new(AtomicU32::new(0));
    let counted = seen.clone();
    let look = move |seen: Seen| {
        let here = Handle::current();
        let show = |machine: &str, seen: Seen| here.block_on(looks.seen_of(machine, &attempt, seen));
        assert!(!show("beta", seen.clone()).unwrap(), "of another machine");
        let with = |change: &dyn Fn(&mut Seen)| {
            let mut changed = seen.clone();
            change(&mut changed);
            changed
        };
        let wrong = [
            with(&|it| it.place = 1 - it.place),
            with(&|it| it.place = 2),
            with(&|it| it.preliminary.result.algorithm = "sphere-tree".into()),
            with(&|it| it.preliminary.records.configuration[0] = 300),
            with(&|it| it.preliminary.records.time_ns.truncate(1)),
            with(&|it| {
                it.preliminary.records.claims.insert(300, Claim { triangles: Some([0, 0]), points: None });
            }),
        ];
        for wrong in wrong {
            assert!(matches!(show("alpha", wrong), Err(EngineError::Invalid(_))));
        }
        // What a machine says of ranks is not believed.
        let ranked = with(&|it| (it.preliminary.result.rank, it.preliminary.result.preliminary) = (Some(1), false));
        assert!(show("alpha", ranked).unwrap());
        let (info, algorithm) = (here.block_on(looks.run(&of, None)).unwrap(), &seen.preliminary.result.algorithm);
        let shown = info.results.iter().find(|it| it.algorithm == *algorithm).expect("it is shown");
        assert!(shown.preliminary && shown.rank.is_none() && shown.n == seen.preliminary.result.n, "{shown:?}");
        let request = HeatmapRequest::new(algorithm, Measure::Time, Statistic::Median, Outliers::Keep);
        let map = here.block_on(looks.heatmap(&of, &request)).unwrap();
        assert_eq!((map.preliminary, map.n), (true, shown.n));
        assert!(info.seconds_left.is_some_and(|left| left > 0.0), "from the first look on");
        counted.fetch_add(1, Ordering::Relaxed);
    };
    let (_, handed) = common::watched(&engine, "alpha", worker, &order, look).await;
    assert!(seen.load(Ordering::Relaxed) >= 2, "a first look at each");
    let so_far = engine.run(&run.id, None).await.unwrap().results;
    assert!(so_far.len() == 2 && so_far.iter().any(|result| result.place_so_far == Some(1)), "{so_far:?}");
    assert!(hand_in(&engine, "alpha", &order, handed).await);
    let done = engine.run(&run.id, None).await.unwrap();
    // Beside other programs its time may end first.
    let whole = |it: &AlgorithmResult| it.n == 300 || (it.n > 0 && it.budget_limited);
    assert!(done.results.iter().all(|it| !it.preliminary && it.place_so_far.is_none() && whole(it)), "{done:?}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_that_fails_three_times_does_not_keep_the_run_for_ever() {
    let (_here, engine, worker) = site().await;
    let run = engine.submit(small(&["box-tree"]), None).await.unwrap();
    for number in 1..=3 {
        assert_ne!(state(&engine, &run).await, State::Failed, "attempt {number}");
        // It rests after a failure, so that other machines get the run; until its operator says that it is mended.
        if number > 1 {
            let rests = common::next(&engine, "alpha", worker.facts(), NOW).await;
            let long = |refused: &EngineError| matches!(refused, EngineError::TooMuch { retry_seconds: 500..=601, .. });
            assert!(rests.as_ref().is_err_and(long), "{rests:?}");
            let status = engine.status().await.unwrap();
            assert_eq!(status.machines[0].state, MachineState::Refused);
            let machines = engine.machines().await.unwrap();
            assert_eq!(machines[0].trouble.as_deref(), Some("The disk of /somewhere is full."));
            engine.add_machine("alpha").await.unwrap();
        }
        let order = order(&engine, "alpha", worker.facts()).await;
        let ended = Ended::Failed { message: "The disk of /somewhere is full.".into() };
        assert!(hand_in(&engine, "alpha", &order, Handed { ended, files: Vec::new() }).await);
    }
    let run = engine.run(&run.id, None).await.unwrap();
    let message = run.message.unwrap();
    assert_eq!(run.state, State::Failed);
    assert!(message.contains("3 times") && !message.contains("somewhere"), "{message}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn machines_that_would_measure_otherwise_are_refused() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(config(data.path())).await.unwrap();
    let token = engine.add_machine("alpha").await.unwrap();
    assert_eq!(engine.machine_of(&token).await.unwrap().as_deref(), Some("alpha"));
    let plain = common::here(&config(data.path())).facts().clone();
    let refused = [
        (MachineFacts { version: "0.0.0".into(), ..plain.clone() }, "it has version 0.0.0"),
        (MachineFacts { runner_sha256: String::new(), ..plain.clone() }, "ocb-runner is another file"),
        (MachineFacts { profile: "dev".into(), ..plain.clone() }, "its profile is dev"),
        (MachineFacts { plugins: Vec::new(), ..plain.clone() }, "missing or another file"),
    ];
    for (facts, words) in refused {
        let refused = common::next(&engine, "alpha", &facts, NOW).await;
        assert!(matches!(&refused, Err(EngineError::Busy(why)) if why.contains(words)), "{words}: {refused:?}");
    }
    assert!(common::next(&engine, "alpha", &plain, NOW).await.unwrap().is_none());
    let status = engine.status().await.unwrap();
    let states: Vec<_> = status.machines.iter().map(|it| (it.name.as_str(), it.state)).collect();
    assert_eq!((states, &status.hardware_class), (vec![("alpha", MachineState::Waiting)], &plain.hardware_class));
    engine.revoke_machine("alpha").await.unwrap();
    assert_eq!(engine.machine_of(&token).await.unwrap(), None);
    assert!(matches!(engine.revoke_machine("alpha").await, Err(EngineError::NotFound(_))));
    assert!(matches!(engine.add_machine(" \n").await, Err(EngineError::Invalid(_))));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_whose_times_drift_gets_no_run_until_they_are_as_before() {
    let (here, engine, worker) = site().await;
    let facts = worker.facts();
    for name in ["beta", "gamma", "delta"] {
        engine.add_machine(name).await.unwrap();
        assert!(common::next(&engine, name, facts, NOW).await.unwrap().is_none(), "its sentinel is kept");
    }
    let run = engine.submit(small(&["box-tree"]), None).await.unwrap();
    let asks = async || engine.next_order("alpha", facts, NOW).await;
    let takes = async |median_ns| engine.sentinel_of("alpha", Sentinel::Measured { median_ns }).await;
    let is_sentinel = |next: Result<NextWork, EngineError>| matches!(next, Ok(NextWork::Sentinel(_)));
    // A reading that is off is measured again at once, and three of them are no chance.
    for median_ns in [1031.0, 1040.0, 1050.0] {
        assert!(is_sentinel(asks().await), "first of all, or once more");
        takes(median_ns).await.unwrap();
    }
    let refused = asks().await;
    assert!(matches!(refused, Err(EngineError::TooMuch { retry_seconds: 500..=601, .. })), "{refused:?}");
    let told = engine.machines().await.unwrap();
    assert!(told[0].trouble.as_ref().is_some_and(|why| why.contains("+5.0 %")), "{told:?}");
    assert_eq!((told[0].drift, told[1].drift), (Some(1.05), None));
    assert!(matches!(takes(f64::NAN).await, Err(EngineError::Invalid(_))));
    // When it has rested, it is measured once more, and gets a run when it is what it was.
    let database = common::database(here.1.path()).await;
    sqlx::query("UPDATE machines SET rests_until_us = 0").execute(&database).await.unwrap();
    assert!(is_sentinel(asks().await));
    takes(1050.0).await.unwrap();
    assert!(matches!(asks().await, Err(EngineError::TooMuch { .. })), "one more is enough");
    sqlx::query("UPDATE machines SET rests_until_us = 0").execute(&database).await.unwrap();
    assert!(is_sentinel(asks().await));
    takes(1010.0).await.unwrap();
    let order = order(&engine, "alpha", facts).await;
    assert_eq!(order.run, run.id);
    // An hour later it is measured again, and a machine on which that is not possible gets no run either.
    sqlx::query("UPDATE sentinels SET at_us = at_us - 3600000000").execute(&database).await.unwrap();
    assert!(is_sentinel(asks().await));
    let message = "box-tree does not answer.".into();
    engine.sentinel_of("alpha", Sentinel::Failed { message }).await.unwrap();
    assert!(matches!(asks().await, Err(EngineError::TooMuch { .. })));
    // Who allows it again starts anew.
    engine.add_machine("alpha").await.unwrap();
    assert!(is_sentinel(asks().await));
    assert_eq!(engine.machines().await.unwrap()[0].drift, None);
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_sentinel_is_measured_where_its_algorithm_is_installed() {
    let (_here, engine, worker) = site().await;
    let Ok(NextWork::Sentinel(algorithm)) = engine.next_order("alpha", worker.facts(), NOW).await else {
        panic!("it comes first")
    };
    assert_eq!(algorithm.info.id, "box-tree");
    let measured = tokio::task::spawn_blocking(move || {
        let measure = || worker.sentinel(&algorithm, &Stop::default(), || {}).unwrap().unwrap();
        let stopped = Stop::default();
        stopped.stop();
        assert_eq!(worker.sentinel(&algorithm, &stopped, || {}).unwrap(), None);
        let mut absent = (*algorithm).clone();
        absent.info.plugin_sha256 = "0".repeat(64);
        assert!(
            worker.sentinel(&absent, &Stop::default(), || {}).is_err_and(|e| e.to_string().contains("not installed"))
        );
        [measure(), measure()]
    });
    let measured = measured.await.unwrap();
    println!("the sentinel twice, ns: {measured:?}");
    // Other programs may be at work here, so no two are compared.
    assert!(measured.iter().all(|ns| (100.0..1e7).contains(ns)), "{measured:?}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_the_jail_of_a_machine_lacks_is_no_result() {
    let (_here, engine, worker) = site().await;
    let facts = worker.facts().clone();
    let run = engine.submit(small(&["box-tree"]), None).await.unwrap();
    let first = order(&engine, "alpha", &facts).await;
    let (_, handed) = common::measured(&engine, "alpha", worker, &first).await;
    let Ended::Measured { mut algorithms, .. } = handed.ended else { panic!("it was measured") };
    let MeasuredAlgorithm { result, records, triangle_tests, .. } = &mut algorithms[0];
    (*records, *triangle_tests, result.n, result.outcome.ours) = (false, false, 0, true);
    result.outcome.name = OutcomeName::SandboxFault;
    let ended = Ended::Measured { algorithms, environment: None, preview: None };
    assert!(hand_in(&engine, "alpha", &first, Handed { ended, files: Vec::new() }).await);
    assert_eq!(state(&engine, &run).await, State::Queued, "another machine may have more luck");
    assert!(matches!(common::next(&engine, "alpha", &facts, NOW).await, Err(EngineError::TooMuch { .. })));

    // Who asks anew has ended in the middle of what it had, which is lost; what it has when its token is revoked is not.
    engine.add_machine("beta").await.unwrap();
    let second = order(&engine, "beta", &facts).await;
    let third = order(&engine, "beta", &facts).await;
    assert_eq!((&second.run, &third.run), (&run.id, &run.id));
    assert!(!engine.beat_of("beta", &second.attempt, Vec::new()).await.unwrap());
    engine.revoke_machine("beta").await.unwrap();
    let waiting = engine.run(&run.id, None).await.unwrap();
    assert_eq!((waiting.state, waiting.attempts), (State::Queued, 2), "the failure of alpha, and the end of beta");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_that_the_service_cannot_begin_fails_and_holds_up_nobody() {
    let (here, engine, worker) = site().await;
    let facts = worker.facts();
    let database = common::database(here.1.path()).await;
    let damaged = engine.submit(small(&["box-tree"]), None).await.unwrap();
    let damage = "UPDATE runs SET set_info = NULL WHERE prepared = 1";
    while sqlx::query(damage).execute(&database).await.unwrap().rows_affected() == 0 {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    let next = engine.submit(small(&["box-tree"]), None).await.unwrap();
    for _ in 0..3 {
        assert!(matches!(common::next(&engine, "alpha", facts, NOW).await, Err(EngineError::Fault(_))));
    }
    let run = engine.run(&damaged.id, None).await.unwrap();
    assert_eq!((run.state, run.attempts), (State::Failed, 3));
    assert!(run.message.as_ref().is_some_and(|why| why.contains("no fault of the algorithms")), "{:?}", run.message);
    assert_eq!(order(&engine, "alpha", facts).await.run, next.id);
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_finds_what_the_service_itself_would_find() {
    let _alone = alone().await;
    let [here, there] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let spec = RunSpec {
        object_b: Some("stock:box@500".into()),
        seed: Some(7),
        at_most: Some(60),
        ..RunSpec {
            method: common::spec("proximity", 200, 1).method,
            ..small(&["box-tree:leaf_size=4", "brute-force"])
        }
    };
    let alone = Engine::open(EngineConfig { elsewhere: false, ..config(here.path()) }).await.unwrap();
    let run = alone.submit(spec.clone(), Some("me")).await.unwrap();
    let expected = common::finish(&alone, &run.id).await.0;
    alone.shutdown().await;

    let engine = Engine::open(config(there.path())).await.unwrap();
    engine.add_machine("alpha").await.unwrap();
    let worker = common::here(&config(there.path()));
    let run = engine.submit(spec, Some("me")).await.unwrap();
    let first = order(&engine, "alpha", worker.facts()).await;
    let (worker, handed) = common::measured(&engine, "alpha", worker, &first).await;
    assert!(hand_in(&engine, "alpha", &first, handed).await);
    let found = engine.run(&run.id, None).await.unwrap();
    let told = |run: &RunInfo| {
        let of = |it: &ocb_service::model::AlgorithmResult| {
            (it.algorithm.clone(), it.n, it.of, it.wrong, it.verdicts.clone(), it.bv_tests_mean, it.rank.is_some())
        };
        (run.state, run.results.iter().map(of).collect::<Vec<_>>(), run.preview.as_ref().map(|it| (it.n, it.of)))
    };
    assert_eq!(told(&found), told(&expected));
    assert_eq!(found.set.as_ref().map(|set| &set.sha256), expected.set.as_ref().map(|set| &set.sha256));
    let reference = |run: &RunInfo| run.environment.as_ref().and_then(|it| it.reference.clone());
    assert_eq!(reference(&found), reference(&expected));

    // The whole of the preview is prepared and measured like any other run.
    engine.refine(&run.id, Some("me")).await.unwrap();
    let whole = order(&engine, "alpha", worker.facts()).await;
    assert_eq!(whole.spec.at_most, None);
    let (_, handed) = common::measured(&engine, "alpha", worker, &whole).await;
    assert!(hand_in(&engine, "alpha", &whole, handed).await);
    let refined = engine.run(&run.id, None).await.unwrap();
    assert_eq!((refined.state, refined.preview.is_none(), refined.results[0].n), (State::Done, true, 200));
    engine.shutdown().await;
}

/// Sends a plugin, whose check this machine makes; its name.
async fn validated(engine: &Engine, author: &AccountInfo, file: &Path, worker: Worker) -> (String, Worker) {
    let bytes = std::fs::read(file).unwrap();
    let id = engine.submit_plugin(author, "slow.so", bytes, common::manifest(), None).await.unwrap().0.id;
    let errand = errands::next_errand(engine, "alpha", worker.facts()).await.expect("the check");
    let (worker, handed, _) = errands::done(engine, "alpha", worker, &errand).await;
    let handing = Handing { ended: handed.ended, files: handed.files };
    assert!(engine.hand_in("alpha", &errand.attempt, handing).await.unwrap());
    let plugin = engine.plugin(&id, Some(author)).await.unwrap();
    assert_eq!(plugin.state, PluginState::Validated, "{plugin:?}");
    (format!("{}@1.0", plugin.algorithms[0].id), worker)
}

#[tokio::test(flavor = "multi_thread")]
async fn a_submitted_plugin_comes_with_the_order_and_a_guests_time_is_limited() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let ceilings = Ceilings { guest_run: Duration::from_secs(90), ..Ceilings::default() };
    let settings = EngineConfig { ceilings, profile: Profile::Dev, ..config(data.path()) };
    let engine = Engine::open(settings.clone()).await.unwrap();
    engine.add_machine("alpha").await.unwrap();
    let author = engine.add_account("author", "a long enough password", Role::Developer).await.unwrap();
    let worker = common::here(&settings);
    let (name, worker) = validated(&engine, &author, &common::slow(data.path(), 0, 0, 1), worker).await;
    let spec = RunSpec { query: Query::CollisionFirst, ..small(&[&name]) };
    let run = engine.submit(spec, Some(&author.owner())).await.unwrap();
    let order_of_account = order(&engine, "alpha", worker.facts()).await;
    assert_eq!(order_of_account.most_seconds, None);
    assert!(!worker.facts().plugins.contains(&order_of_account.algorithms[0].info.plugin_sha256));
    let (worker, handed) = common::measured(&engine, "alpha", worker, &order_of_account).await;
    assert!(hand_in(&engine, "alpha", &order_of_account, handed).await);
    let found = engine.run(&run.id, Some(&author.owner())).await.unwrap();
    assert_eq!((found.state, found.results[0].algorithm.as_str()), (State::Done, &*name));
    // Beside other programs its time may end first.
    let n = found.results[0].n;
    assert!(n == 40 || (n > 0 && found.results[0].budget_limited), "{found:?}");
    let guest = Visitor { owner: uuid::Uuid::now_v7().to_string(), address: None };
    let (limited, _) = engine.submit_for(small(&["box-tree"]), &guest, None).await.unwrap();
    let order_of_guest = order(&engine, "alpha", worker.facts()).await;
    let left = order_of_guest.most_seconds.unwrap();
    assert!(60.0 < left && left < 90.0, "{left} s are left; preparing took some");
    assert!(hand_in(&engine, "alpha", &order_of_guest, Handed { ended: Ended::TooLong, files: Vec::new() }).await);
    let limited = engine.run(&limited.id, None).await.unwrap();
    assert_eq!(limited.state, State::Cancelled);
    assert!(limited.message.unwrap().contains("the time limit for guests"));
    engine.shutdown().await;
}
