//! An idle service measures missing results, and gives way to any request.

mod common;

use std::path::Path;
use std::time::{Duration, Instant};

use ocb_service::model::{AdviceSpec, Asked, BoardRequest, Role, State, SuiteProgress};
use ocb_service::{Engine, EngineConfig, EngineError, Visitor};

/// The file of a suite of two scenarios, with so many processes and seconds for each algorithm.
fn suite(data: &Path, passes: u32, budget_seconds: f64) -> std::path::PathBuf {
    let object = "stock:torus-knot@600";
    let document = serde_json::json!({
        "version": 3, "scenes": [[object, object]],
        "separations": [{ "kind": "relative", "distance": 0.1 }, { "kind": "relative", "distance": 0.01 }],
        "queries": ["collision_first"], "configurations": 30, "passes": passes, "budget_seconds": budget_seconds,
    });
    let file = data.join("suite.json");
    std::fs::write(&file, document.to_string()).unwrap();
    file
}

/// An engine without an advisor: the example of advice would come before the suite, and takes half a minute.
async fn opened(data: &Path, suite: &Path, idle: bool) -> Engine {
    let plain = common::config(data);
    let plugins = vec![plain.runner.with_file_name("libocb_box_tree.so")];
    let advisor = data.join("none");
    Engine::open(EngineConfig { plugins, suite: Some(suite.to_owned()), idle, advisor, ..plain }).await.unwrap()
}

async fn progress(engine: &Engine) -> SuiteProgress {
    engine.suite(None).await.unwrap().progress.remove(0)
}

/// Asks the database until it gives this.
async fn until<T: for<'r> sqlx::Decode<'r, sqlx::Any> + sqlx::Type<sqlx::Any> + Send + Unpin>(
    database: &sqlx::AnyPool,
    question: &'static str,
    so: impl Fn(&T) -> bool,
) -> T {
    let begun = Instant::now();
    loop {
        let found: Option<T> = sqlx::query_scalar(question).fetch_optional(database).await.unwrap();
        match found {
            Some(found) if so(&found) => return found,
            _ => {}
        }
        assert!(begun.elapsed() < Duration::from_secs(120), "waited in vain for {question}");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

/// One test at a time: while one measures, the process has fewer CPUs, and an engine opened then has another hardware class.
static ALONE: tokio::sync::Mutex<()> = tokio::sync::Mutex::const_new(());

/// Runs and stability runs of the service itself.
const IDLE_RUNS: &str = "SELECT COUNT(*) FROM runs WHERE priority = 9";
const STABILITY: &str = "SELECT COUNT(*) FROM stability_runs WHERE priority = 9 AND state = 'running'";

#[tokio::test(flavor = "multi_thread")]
async fn an_idle_service_measures_the_suite_and_then_tries_stability() {
    let _alone = ALONE.lock().await;
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), &suite(data.path(), 1, 20.0), true).await;
    let database = common::database(data.path()).await;
    until(&database, STABILITY, |n: &i64| *n == 1).await;
    let found = progress(&engine).await;
    assert_eq!((found.measured, found.waiting, found.failed, found.of), (2, 0, 0, 2));
    assert!(engine.suite(None).await.unwrap().idle);
    let board = engine.board(&BoardRequest::default(), None).await.unwrap();
    assert_eq!((board.results, board.suite.map(|suite| suite.version)), (2, Some(3)), "it has filled the board");
    assert_eq!(engine.status().await.unwrap().queued, 0);
    // It goes on part by part, and has no owner.
    until(&database, "SELECT LENGTH(done) FROM stability_runs", |length: &i64| *length > 2).await;
    engine.shutdown().await;
    let attempts: i64 = sqlx::query_scalar("SELECT attempts FROM stability_runs").fetch_one(&database).await.unwrap();
    assert_eq!(attempts, 0, "what was put back is no failed attempt");
    database.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn it_gives_way_to_a_visitor_at_once_and_finishes_later() {
    let _alone = ALONE.lock().await;
    let data = tempfile::tempdir().unwrap();
    // Long enough to be interrupted.
    let suite = suite(data.path(), 15, 30.0);
    let engine = opened(data.path(), &suite, true).await;
    let database = common::database(data.path()).await;
    let running = "SELECT id FROM runs WHERE priority = 9 AND state = 'running'";
    let idle: String = until(&database, running, |_| true).await;
    // It is measuring, not only looking for configurations.
    let measuring = "SELECT COUNT(*) FROM run_stages WHERE stage LIKE '%measuring%' AND stage LIKE '%running%'";
    until(&database, measuring, |n: &i64| *n > 0).await;

    let asked = Instant::now();
    let run = engine.submit(common::spec("collision_first", 20, 1), Some("me")).await.unwrap();
    assert!(run.runs_ahead == 0, "idle work delays no run");
    until(&database, "SELECT COUNT(*) FROM runs WHERE owner = 'me' AND state <> 'queued'", |n: &i64| *n == 1).await;
    let waited = asked.elapsed();
    let state = "SELECT state FROM runs WHERE priority = 9";
    until(&database, state, |state: &String| state == "queued").await;
    assert!(waited < Duration::from_secs(3), "it gave way after {waited:?}");
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    let (put_back, _) = common::finish(&engine, &idle).await;
    assert_eq!((put_back.state, put_back.attempts), (State::Done, 1), "{:?}", put_back.message);
    // The check of a plugin and advice interrupt it, too.
    let next = until(&database, running, |next: &String| *next != idle).await;
    send_plugin(&engine).await;
    put_back_within_seconds(&engine, &next, 1).await;
    until(&database, running, |again: &String| *again == next).await;
    let spec = AdviceSpec {
        object_a: "stock:torus-knot@2000".into(),
        object_b: None,
        question: Asked::Distance { tolerance: 0.05 },
    };
    let visitor = Visitor { owner: "me".into(), address: None };
    let (advice, _) = engine.ask_advice(spec, &visitor, None).await.unwrap();
    put_back_within_seconds(&engine, &next, 2).await;
    engine.cancel_advice(&advice.id, Some("me")).await.unwrap();
    // Off means off: what waits is missing again, and nothing is begun.
    engine.shutdown().await;
    let engine = opened(data.path(), &suite, false).await;
    let found = progress(&engine).await;
    assert_eq!((found.measured, found.waiting, found.failed), (1, 0, 0));
    assert!(!engine.suite(None).await.unwrap().idle);
    let run = engine.submit(common::spec("collision_first", 20, 2), Some("me")).await.unwrap();
    assert_eq!(common::finish(&engine, &run.id).await.0.state, State::Done);
    tokio::time::sleep(Duration::from_millis(200)).await;
    let waiting: i64 = until(&database, IDLE_RUNS, |_| true).await;
    assert_eq!(waiting, 2, "one is measured and one is cancelled");
    engine.shutdown().await;
    let engine = opened(data.path(), &suite, true).await;
    until(&database, STABILITY, |n: &i64| *n == 1).await;
    assert_eq!(progress(&engine).await.measured, 2);
    engine.shutdown().await;
    database.close().await;
}

/// Sends a file that is no plugin, whose check soon ends.
async fn send_plugin(engine: &Engine) {
    let author = engine.add_account("author", "a long enough password", Role::Developer).await.unwrap();
    let manifest = serde_json::json!({
        "name": "None", "version": "1", "authors": "Somebody", "license": "MIT", "queries": ["collision_first"],
    });
    let manifest = serde_json::from_value(manifest).unwrap();
    engine.submit_plugin(&author, "none.so", b"\x7fELF".to_vec(), manifest, None).await.unwrap();
}

/// Waits until this run has been put back into the queue so many times.
async fn put_back_within_seconds(engine: &Engine, run: &str, times: usize) {
    let begun = Instant::now();
    let put_back = async || {
        let events = engine.events(run, 0).await.unwrap();
        events.iter().filter(|event| event.state == State::Queued).count()
    };
    while put_back().await < times {
        assert!(begun.elapsed() < Duration::from_secs(3), "run {run} was not put back");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_failed_is_not_tried_again() {
    let _alone = ALONE.lock().await;
    let data = tempfile::tempdir().unwrap();
    // Over before the first question is asked.
    let suite = suite(data.path(), 1, 1e-9);
    let engine = opened(data.path(), &suite, true).await;
    let database = common::database(data.path()).await;
    until(&database, STABILITY, |n: &i64| *n == 1).await;
    // The stability of the algorithm is made to fail, too.
    sqlx::query("UPDATE stability_runs SET state = 'failed'").execute(&database).await.unwrap();
    engine.shutdown().await;
    let engine = opened(data.path(), &suite, true).await;
    // After the requested run it has looked for missing results, and waits.
    let run = engine.submit(common::spec("collision_first", 20, 1), Some("me")).await.unwrap();
    common::finish(&engine, &run.id).await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    let found = progress(&engine).await;
    assert_eq!((found.measured, found.waiting, found.failed), (0, 0, 2));
    let runs: i64 = until(&database, IDLE_RUNS, |_| true).await;
    let tries: i64 = until(&database, "SELECT COUNT(*) FROM stability_runs", |_| true).await;
    assert_eq!((runs, tries), (2, 1));
    engine.shutdown().await;
    database.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn examples_come_first_and_only_those_whose_algorithms_are_installed() {
    let _alone = ALONE.lock().await;
    let data = tempfile::tempdir().unwrap();
    let suite = suite(data.path(), 1, 5.0);
    let engine = opened(data.path(), &suite, false).await;
    assert_eq!(engine.examples().await.unwrap(), [], "box-tree alone makes no example");
    engine.shutdown().await;

    let plain = common::config(data.path());
    let plugins = ["box_tree", "fast", "parry"].map(|name| plain.runner.with_file_name(format!("libocb_{name}.so")));
    let plugins = Vec::from(plugins);
    let config = EngineConfig { plugins, suite: Some(suite), idle: false, ..plain };
    let engine = Engine::open(config.clone()).await.unwrap();
    assert_eq!(engine.examples().await.unwrap(), [], "without idle work none will come");
    engine.shutdown().await;

    let engine = Engine::open(EngineConfig { idle: true, ..config }).await.unwrap();
    let begun = Instant::now();
    let run = loop {
        let examples = engine.examples().await.unwrap();
        assert_eq!(examples[0].example.id, "gear");
        if let Some(run) = &examples[0].run {
            break run.clone();
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "no example was queued");
        tokio::time::sleep(Duration::from_millis(20)).await;
    };
    assert!(matches!(run.state, State::Queued | State::Running), "{run:?}");
    assert_eq!((run.visibility, run.spec.algorithms.len()), (ocb_service::model::Visibility::Public, 3));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn advice_of_an_example_gives_way_and_ends_later() {
    let _alone = ALONE.lock().await;
    let data = tempfile::tempdir().unwrap();
    let plain = common::config(data.path());
    let advisor = common::built().join("ocb-advisor");
    let config = EngineConfig { plugins: Vec::new(), advisor, quick_advice: true, idle: true, ..plain };
    let engine = Engine::open(config).await.unwrap();
    let database = common::database(data.path()).await;
    until(&database, "SELECT COUNT(*) FROM advice WHERE attempts = 1", |begun: &i64| *begun == 1).await;
    let made = async || {
        let mut examples = engine.examples().await.unwrap();
        assert_eq!((examples.len(), examples[0].example.id.as_str()), (1, "tolerance"), "no algorithm is installed");
        examples.remove(0).advice.expect("it was begun")
    };
    let id = made().await.id;

    // A visitor's advice comes first, and ends first.
    let question = Asked::Distance { tolerance: 0.05 };
    let spec = AdviceSpec { object_a: "stock:torus-knot@600".into(), object_b: None, question };
    let visitor = Visitor { owner: "me".into(), address: None };
    let asked = engine.ask_advice(spec, &visitor, None).await.unwrap().0.id;
    let put_back = "SELECT COUNT(*) FROM attempts WHERE kind = 'advise' AND outcome = 'put back'";
    until(&database, put_back, |times: &i64| *times == 1).await;
    // The rest of it is about a smaller object, which takes seconds.
    let smaller = "UPDATE advice SET info = REPLACE(info, 'torus-knot@8000', 'torus-knot@600') \
                   WHERE owner IS NULL AND info LIKE '%torus-knot@8000%'";
    assert_eq!(sqlx::query(smaller).execute(&database).await.unwrap().rows_affected(), 1);
    let refused = engine.cancel_advice(&id, Some("me")).await.unwrap_err();
    assert!(matches!(refused, EngineError::Forbidden(_)), "it is nobody's: {refused}");
    let ended = async |id: &str| loop {
        let info = engine.advice(id).await.unwrap();
        if !matches!(info.state, State::Queued | State::Running) {
            return info;
        }
        tokio::time::sleep(Duration::from_millis(20)).await;
    };
    assert_eq!(ended(&asked).await.state, State::Done);
    assert!(matches!(made().await.state, State::Queued | State::Running), "it waited for the visitor");
    assert_eq!(ended(&id).await.state, State::Done);
    assert!(made().await.advice.is_some());
    assert_eq!(engine.examples().await.unwrap().len(), 1, "it is made once");
    engine.shutdown().await;
    database.close().await;
}
