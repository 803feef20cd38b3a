//! Two services on one database: neither takes what the other works on.

mod common;

use std::fs::File;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use futures::StreamExt;
use ocb_core::statistics::{Outliers, Statistic};
use ocb_service::model::{Ended, HeatmapRequest, Measure, RunInfo, RunSpec, State, Told};
use ocb_service::worker::Seen;
use ocb_service::{Engine, EngineConfig, Handing};
use tokio::runtime::Handle;

/// A fresh schema in the harness's database.
async fn database() -> (String, sqlx::AnyPool) {
    let url = std::env::var("OCB_TEST_POSTGRES").expect("OCB_TEST_POSTGRES is not set: run `make test`");
    sqlx::any::install_default_drivers();
    let schema = format!("test_{}", uuid::Uuid::new_v4().simple());
    let join = if url.contains('?') { '&' } else { '?' };
    let url = format!("{url}{join}options=-c%20search_path%3D{schema}");
    let pool = sqlx::AnyPool::connect(&url).await.unwrap();
    sqlx::query(sqlx::AssertSqlSafe(format!("CREATE SCHEMA {schema}"))).execute(&pool).await.unwrap();
    (url, pool)
}

async fn opened(data: &Path, url: &str) -> Engine {
    let config = EngineConfig { database_url: Some(url.to_owned()), ..common::config(data) };
    Engine::open(config).await.unwrap()
}

/// On a database and files that others use as well.
fn sharing(data: &Path, url: &str) -> EngineConfig {
    let bucket = std::env::var("OCB_TEST_S3").expect("OCB_TEST_S3 is not set: run `make test`");
    EngineConfig { database_url: Some(url.to_owned()), blob_url: Some(bucket), ..common::config(data) }
}

async fn until(engine: &Engine, id: &str, there: impl Fn(&RunInfo) -> bool) -> RunInfo {
    let begun = Instant::now();
    loop {
        let run = engine.run(id, None).await.unwrap();
        if there(&run) {
            return run;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "{run:?}");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

fn now_us() -> i64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_micros() as i64
}

/// The right to measure on this machine, so that runs wait for it.
fn right_to_measure() -> File {
    let folder = if Path::new("/run/lock").is_dir() { "/run/lock" } else { "/tmp" };
    let lock = File::options().create(true).append(true).open(Path::new(folder).join("opencollbench-measuring.lock"));
    let lock = lock.unwrap();
    lock.lock().unwrap();
    lock
}

/// From now on the first attempt at a job gets no lease any more, as if its worker were silent.
async fn silence(database: &sqlx::AnyPool, job: &str) {
    let text = format!(
        "CREATE FUNCTION silence() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN NEW.lease_us := 0; RETURN NEW; END'; \
         CREATE TRIGGER silence BEFORE UPDATE ON attempts FOR EACH ROW \
         WHEN (OLD.job = '{job}' AND OLD.number = 1) EXECUTE FUNCTION silence(); \
         UPDATE attempts SET lease_us = 0 WHERE job = '{job}'"
    );
    sqlx::raw_sql(sqlx::AssertSqlSafe(text)).execute(database).await.unwrap();
}

async fn outcomes(database: &sqlx::AnyPool, job: &str) -> Vec<String> {
    let text = "SELECT outcome FROM attempts WHERE job = $1 AND ended_us IS NOT NULL ORDER BY number";
    sqlx::query_scalar(text).bind(job).fetch_all(database).await.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_second_service_takes_nothing_from_the_first_until_that_is_silent() {
    let right = right_to_measure();
    let (url, database) = database().await;
    let [data, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let first = opened(data.path(), &url).await;
    let submitted = async |engine: &Engine, seed| {
        let run = engine.submit(common::spec("collision_first", 20, seed), Some("me")).await.unwrap();
        until(engine, &run.id, |run| run.stages[2].message.is_some()).await.id
    };
    let run = submitted(&first, 1).await;
    let at_work = async |engine: &Engine, id: &str| {
        let run = engine.run(id, None).await.unwrap();
        (run.state, run.attempts)
    };

    // The second looks at the queue, and finds its own work there.
    let second = opened(other.path(), &url).await;
    let theirs = submitted(&second, 2).await;
    assert_eq!(at_work(&second, &run).await, (State::Running, 1));
    assert!(first.run(&run, None).await.unwrap().seconds_left.is_some(), "the first goes on");

    // Cancelled at the second, which answers at once; the first hears of it from PostgreSQL, and takes the next run.
    let asked = Instant::now();
    assert_eq!(second.cancel(&run, Some("me")).await.unwrap().state, State::Cancelled);
    assert!(asked.elapsed() < Duration::from_secs(2), "{:?}", asked.elapsed());
    let next = submitted(&first, 3).await;
    println!("a run cancelled at the other service ended, and the next one began, after {:?}", asked.elapsed());
    assert!(asked.elapsed() < Duration::from_secs(5), "{:?}", asked.elapsed());
    let (run, events) = common::finish(&first, &run).await;
    assert_eq!((run.state, events.last().unwrap().state), (State::Cancelled, State::Cancelled));
    assert_eq!(outcomes(&database, &run.id).await, ["withdrawn"]);

    // The second starts again: it puts back its own work alone.
    second.shutdown().await;
    let second = opened(other.path(), &url).await;
    until(&second, &theirs, |run| run.state == State::Running).await;
    assert_eq!(at_work(&second, &next).await, (State::Running, 1));

    // Once the first is silent for longer than its lease, its work waits again: the second keeps house then.
    silence(&database, &next).await;
    let door = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity \
                WHERE application_name = (SELECT 'ocb ' || machine FROM attempts WHERE job = $1 AND number = 1)";
    let begun = Instant::now();
    while at_work(&second, &next).await.1 == 1 {
        assert!(begun.elapsed() < Duration::from_secs(60), "it was not taken back");
        sqlx::query(door).bind(&next).execute(&database).await.unwrap();
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    // The first hears of events that the second writes.
    let known = first.events(&theirs, 0).await.unwrap().last().map_or(0, |event| event.seq);
    let events = first.follow(&theirs, known).await.unwrap();
    let lags = tokio::spawn(events.map(|event| now_us() - event.unwrap().at_us).collect::<Vec<i64>>());
    drop(right);
    for run in [&next, &theirs] {
        let (run, _) = common::finish(&second, run).await;
        assert_eq!((run.state, run.results.len()), (State::Done, 3), "{:?}", run.message);
    }
    let mut lags = lags.await.unwrap();
    lags.sort_unstable();
    let [median, most] = [lags[lags.len() / 2], lags[lags.len() - 1]];
    println!("{} events of the other service came after {median} us (median), {most} us at most", lags.len());
    assert!(median < 1_000_000, "{lags:?}");
    assert_eq!(outcomes(&database, &next).await, ["lost", "accepted"]);
    assert_eq!(outcomes(&database, &theirs).await, ["put back", "accepted"]);
    first.shutdown().await;
    second.shutdown().await;
    database.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_one_service_measures_is_shown_by_the_other_before_its_end() {
    let (url, database) = database().await;
    let [data, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let settings = |data: &Path, dispatch| EngineConfig { dispatch, ..sharing(data, &url) };
    let first = Engine::open(settings(data.path(), true)).await.unwrap();
    let second = Engine::open(settings(other.path(), false)).await.unwrap();
    let spec = RunSpec { algorithms: vec!["box-tree".into(), "parry".into()], ..common::spec("proximity", 400, 1) };
    let run = first.submit(spec, Some("me")).await.unwrap();
    let found = |run: &RunInfo| run.results.first().is_some_and(|it| it.preliminary && it.n > 0);
    let seen = until(&second, &run.id, found).await;
    assert!(seen.results[0].rank.is_none() && seen.seconds_left.is_some(), "{seen:?}");
    let request = HeatmapRequest::new("box-tree", Measure::Time, Statistic::Median, Outliers::Keep);
    assert!(second.heatmap(&run.id, &request).await.unwrap().preliminary);
    let (done, _) = common::finish(&second, &run.id).await;
    assert!(done.state == State::Done && done.results.iter().all(|it| !it.preliminary && it.n == 400), "{done:?}");
    let kept: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM seen").fetch_one(&database).await.unwrap();
    assert_eq!(kept, 0, "what was found on the way went with the attempt");
    for engine in [first, second] {
        engine.shutdown().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_begins_at_one_service_and_hands_in_at_the_other() {
    let (url, database) = database().await;
    let [data, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let settings = |data: &Path, dispatch| EngineConfig { elsewhere: true, dispatch, ..sharing(data, &url) };
    let first = Engine::open(settings(data.path(), true)).await.unwrap();
    let token = first.add_machine("alpha").await.unwrap();
    // It prepares nothing.
    let second = Engine::open(settings(other.path(), false)).await.unwrap();
    assert_eq!(second.machine_of(&token).await.unwrap().as_deref(), Some("alpha"));
    let worker = common::here(&settings(data.path(), true));
    let facts = worker.facts().clone();
    let wait = Duration::from_secs(60);
    let spec = |count, seed| {
        let usual = common::spec("collision_first", count, seed);
        RunSpec { algorithms: vec!["box-tree".into()], ..usual }
    };

    // Of so many that there is a first look.
    let run = first.submit(spec(300, 1), Some("me")).await.unwrap();
    let order = common::next(&second, "alpha", &facts, wait).await.unwrap().unwrap();
    // It tells one what it has found, and both show it.
    let (hears, shows, of) = (second.clone(), first.clone(), (run.id.clone(), order.attempt.clone()));
    let seen = Arc::new(AtomicU32::new(0));
    let counted = seen.clone();
    let look = move |seen: Seen| {
        let n = seen.preliminary.result.n;
        let shown = async {
            assert!(hears.seen_of("alpha", &of.1, seen).await.unwrap());
            let there = |run: &RunInfo| run.results.first().is_some_and(|it| it.preliminary && it.n == n);
            let run = until(&shows, &of.0, there).await;
            assert!(run.seconds_left.is_some() && run.results[0].rank.is_none(), "{run:?}");
            let request = HeatmapRequest::new("box-tree", Measure::Time, Statistic::Median, Outliers::Keep);
            let map = shows.heatmap(&of.0, &request).await.unwrap();
            assert_eq!((map.preliminary, map.n), (true, n));
        };
        Handle::current().block_on(shown);
        counted.fetch_add(1, Ordering::Relaxed);
    };
    let (_, handed) = common::watched(&second, "alpha", worker, &order, look).await;
    assert!(seen.load(Ordering::Relaxed) > 0, "there was a first look");
    let kept = async || sqlx::query_scalar::<_, i64>("SELECT COUNT(*) FROM seen").fetch_one(&database).await.unwrap();
    assert_eq!(kept().await, 1);
    let told = |done| Told::Progress { place: 0, done, total: 300, worked_us: 10 };
    assert!(first.beat_of("alpha", &order.attempt, vec![told(3)]).await.unwrap());
    assert_eq!(second.run(&run.id, None).await.unwrap().stages[2].done, 3);
    let handing = Handing { ended: handed.ended, files: handed.files };
    assert!(first.hand_in("alpha", &order.attempt, handing).await.unwrap());
    let done = second.run(&run.id, None).await.unwrap();
    assert_eq!((done.state, done.attempts, done.results[0].n), (State::Done, 1, 300));
    assert!(done.stages.iter().all(|stage| stage.state == State::Done), "{:?}", done.stages);
    assert!(!done.results[0].preliminary && first.run(&run.id, None).await.unwrap().results == done.results);
    // A beat that comes late changes no stage.
    assert!(!second.beat_of("alpha", &order.attempt, vec![told(4)]).await.unwrap());
    // What was found on the way went with the attempt.
    assert_eq!(kept().await, 0);

    // Cancelled at one, which the machine hears from the other.
    let run = first.submit(spec(30, 2), Some("me")).await.unwrap();
    let order = common::next(&first, "alpha", &facts, wait).await.unwrap().unwrap();
    second.cancel(&run.id, Some("me")).await.unwrap();
    assert!(!first.beat_of("alpha", &order.attempt, Vec::new()).await.unwrap());
    let late = Handing { ended: Ended::PutBack, files: Vec::new() };
    assert!(!first.hand_in("alpha", &order.attempt, late).await.unwrap());
    assert_eq!(first.run(&run.id, None).await.unwrap().state, State::Cancelled);
    for engine in [first, second] {
        engine.shutdown().await;
    }
}
