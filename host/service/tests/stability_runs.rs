//! Stability runs as jobs of the service.

mod common;

use std::path::Path;
use std::time::{Duration, Instant};

use ocb_lab::machine::MeasuringRight;
use ocb_service::model::{AlgorithmInfo, Page, Role, StabilityRunInfo, StabilitySpec, State};
use ocb_service::{Ceilings, Engine, EngineConfig, EngineError, StabilitySelection, Stop, Visitor};

/// A family that is tried quickly.
const FAMILY: &str = "vertex-face";

fn config(data: &Path, plugin: &str) -> EngineConfig {
    let plain = common::config(data);
    EngineConfig { plugins: vec![plain.runner.with_file_name(plugin)], ..plain }
}

async fn opened(data: &Path, dispatch: bool) -> Engine {
    Engine::open(EngineConfig { dispatch, ..config(data, "libocb_box_tree.so") }).await.unwrap()
}

fn visitor(owner: &str) -> Visitor {
    Visitor { owner: owner.into(), address: None }
}

async fn started(engine: &Engine, owner: &str, algorithm: &str, parts: &[&str], seeds: Option<u32>) -> String {
    let parts = parts.iter().map(|part| (*part).to_owned()).collect();
    let spec = StabilitySpec { algorithm: algorithm.into(), parts, seeds };
    engine.start_stability(spec, &visitor(owner), None).await.unwrap().0.id
}

/// Waits until the run is as it should be.
async fn until(engine: &Engine, id: &str, so: impl Fn(&StabilityRunInfo) -> bool) -> StabilityRunInfo {
    let begun = Instant::now();
    loop {
        let now = engine.stability_run(id).await.unwrap();
        if so(&now) {
            return now;
        }
        assert!(begun.elapsed() < Duration::from_secs(120), "{now:?}");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

async fn ended(engine: &Engine, id: &str) -> StabilityRunInfo {
    until(engine, id, |now| !matches!(now.state, State::Queued | State::Running)).await
}

fn families(run: &StabilityRunInfo) -> Vec<&str> {
    run.result.iter().flat_map(|found| &found.families).map(|found| found.family.as_str()).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_of_one_family_ends_with_a_result_for_its_owner_alone() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), true).await;
    let id = started(&engine, "me", "box-tree", &[FAMILY], Some(1)).await;
    let run = ended(&engine, &id).await;
    assert_eq!((run.state, run.done, run.total), (State::Done, 1, 1), "{:?}", run.message);
    assert_eq!(families(&run), [FAMILY]);
    assert!(run.result.is_some_and(|found| found.complete && found.families[0].tally.asked() > 0));
    let listed = async |owner| engine.stability_runs(owner, &Page::default()).await.unwrap().entries.len();
    assert_eq!((listed("me").await, listed("other").await), (1, 0));
    assert!(engine.stability_run_is_for(&id, Some("me")).await.is_ok());
    for stranger in [Some("other"), None] {
        let unseen = engine.stability_run_is_for(&id, stranger).await.unwrap_err();
        assert!(matches!(unseen, EngineError::NotFound(_)), "{unseen:?}");
        let refused = engine.cancel_stability(&id, stranger).await.unwrap_err();
        assert!(matches!(refused, EngineError::Forbidden(_)), "{refused:?}");
    }
    engine.remove_stability(&id, Some("me")).await.unwrap();
    assert_eq!(listed("me").await, 0);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_that_was_stopped_goes_on_behind_the_last_part() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), true).await;
    let table = engine.stability().await.unwrap();
    let parts: Vec<&str> = table.families.iter().map(|family| family.id.as_str()).take(8).collect();
    let id = started(&engine, "me", "box-tree", &parts, Some(1)).await;
    until(&engine, &id, |now| now.done > 0).await;
    engine.shutdown().await;

    let engine = opened(data.path(), false).await;
    let stopped = engine.stability_run(&id).await.unwrap();
    let before = stopped.done as usize;
    assert!(stopped.state == State::Running && (1..8).contains(&before), "{stopped:?}");
    assert_eq!((families(&stopped), stopped.step.as_deref()), (parts[..before].to_vec(), Some(parts[before])));
    // What is kept of the first part is marked, to see that it is not tried again.
    let database = common::database(data.path()).await;
    let mark = "UPDATE stability_runs SET found = json_set(found, '$.families[0].tally.agrees', 987654)";
    sqlx::query(mark).execute(&database).await.unwrap();
    let attempts: i64 = sqlx::query_scalar("SELECT attempts FROM stability_runs").fetch_one(&database).await.unwrap();
    assert_eq!(attempts, 0, "a stop is no failed attempt");
    database.close().await;
    // Nobody has more than three at a time.
    for _ in 0..2 {
        started(&engine, "me", "box-tree", &[FAMILY], Some(1)).await;
    }
    let fourth = engine.start_stability(stopped.spec, &visitor("me"), None).await.unwrap_err();
    assert!(matches!(fourth, EngineError::TooMuch { .. }), "{fourth:?}");
    engine.shutdown().await;

    let engine = opened(data.path(), true).await;
    let run = ended(&engine, &id).await;
    assert_eq!((run.state, families(&run)), (State::Done, parts), "{:?}", run.message);
    assert_eq!(run.result.map(|found| found.families[0].tally.agrees), Some(987_654));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn owners_take_turns_and_each_run_knows_its_place() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), false).await;
    let mut ids = Vec::new();
    for owner in ["me", "me", "me", "other"] {
        ids.push(started(&engine, owner, "box-tree", &[FAMILY], Some(1)).await);
    }
    let mut places = Vec::new();
    for id in &ids {
        places.push(engine.stability_run(id).await.unwrap().runs_ahead);
    }
    assert_eq!(places, [0, 2, 3, 1]);
    engine.cancel_stability(&ids[3], Some("other")).await.unwrap();
    let listed = engine.stability_runs("me", &Page::default()).await.unwrap().entries;
    assert_eq!(listed.iter().map(|run| run.runs_ahead).collect::<Vec<_>>(), [2, 1, 0], "newest first");
    assert_eq!(engine.stability_run(&ids[3]).await.unwrap().runs_ahead, 0, "it does not wait any more");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_cancelled_run_ends_at_once_and_the_next_one_begins() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), true).await;
    let id = started(&engine, "me", "box-tree", &[], Some(10)).await;
    let next = started(&engine, "other", "box-tree", &[FAMILY], Some(1)).await;
    until(&engine, &id, |now| now.state == State::Running).await;
    assert_eq!(engine.stability_run(&next).await.unwrap().runs_ahead, 1);
    let run = engine.cancel_stability(&id, Some("me")).await.unwrap();
    assert_eq!((run.state, run.step), (State::Cancelled, None));
    assert!(run.done < run.total && run.finished_us.is_some());
    let done = run.done;
    assert_eq!(ended(&engine, &next).await.state, State::Done);
    let run = engine.stability_run(&id).await.unwrap();
    assert_eq!((run.state, run.done), (State::Cancelled, done), "nothing is added to it");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_guests_run_ends_when_its_time_is_over_and_keeps_what_it_found() {
    let data = tempfile::tempdir().unwrap();
    let ceilings = Ceilings { guest_run: Duration::from_millis(1500), ..Ceilings::default() };
    let config = EngineConfig { ceilings, ..config(data.path(), "libocb_box_tree.so") };
    let engine = Engine::open(config).await.unwrap();
    let guest = "0193f1a0-0000-4000-8000-000000000000";
    // While others measure, its time does not pass.
    let right = tokio::task::spawn_blocking(|| MeasuringRight::wait(|| false, || {}).unwrap().unwrap()).await.unwrap();
    let id = started(&engine, guest, "box-tree", &[], Some(10)).await;
    tokio::time::sleep(Duration::from_secs(2)).await;
    let run = engine.stability_run(&id).await.unwrap();
    assert!(matches!(run.state, State::Queued | State::Running), "{run:?}");
    drop(right);
    let begun = Instant::now();
    let run = ended(&engine, &id).await;
    assert_eq!(run.state, State::Cancelled, "{run:?}");
    assert!(run.message.as_deref().is_some_and(|told| told.contains("time limit for guests")), "{:?}", run.message);
    assert_eq!(families(&run).len(), run.done as usize);
    assert!(run.done < run.total, "{run:?}");
    // Other programs may measure meanwhile; the whole would take minutes.
    let took = begun.elapsed();
    assert!((1.4..60.0).contains(&took.as_secs_f64()), "it ended after {took:?}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_curator_ends_anybodys_run_without_seeing_its_result() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), false).await;
    let id = started(&engine, "me", "box-tree", &[], None).await;
    let user = engine.add_account("user", "a long enough password", Role::Developer).await.unwrap();
    let curator = engine.add_account("curator", "a long enough password", Role::Curator).await.unwrap();
    for refused in [
        engine.open_stability_runs(&user).await.unwrap_err(),
        engine.cancel_stability_of_others(&id, &user).await.unwrap_err(),
    ] {
        assert!(matches!(refused, EngineError::Forbidden(_)), "{refused:?}");
    }
    let open = engine.open_stability_runs(&curator).await.unwrap();
    assert_eq!(open.iter().map(|run| run.id.as_str()).collect::<Vec<_>>(), [id.as_str()]);
    let run = engine.cancel_stability_of_others(&id, &curator).await.unwrap();
    assert_eq!((run.state, run.message.as_deref()), (State::Cancelled, Some("Cancelled by a curator.")));
    assert!(engine.open_stability_runs(&curator).await.unwrap().is_empty());
    assert!(engine.stability_run_is_for(&id, Some(&curator.owner())).await.is_err());
    engine.shutdown().await;
}

/// What an engine with this plugin knows of its algorithm.
async fn described(plugin: &str) -> AlgorithmInfo {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(EngineConfig { dispatch: false, ..config(data.path(), plugin) }).await.unwrap();
    let info = engine.algorithms(None).remove(0);
    engine.shutdown().await;
    info
}

#[tokio::test(flavor = "multi_thread")]
async fn only_a_whole_run_of_a_public_algorithm_takes_its_place_in_the_table() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), false).await;
    let database = common::database(data.path()).await;
    let author = engine.add_account("author", "a long enough password", Role::Developer).await.unwrap();
    let file = common::config(data.path()).runner.with_file_name("libocb_sphere_tree.so");
    let manifest = serde_json::json!({
        "name": "Tree", "version": "1", "authors": "Somebody", "license": "MIT", "queries": ["proximity"],
    });
    let (bytes, manifest) = (std::fs::read(&file).unwrap(), serde_json::from_value(manifest).unwrap());
    engine.submit_plugin(&author, "tree.so", bytes, manifest, None).await.unwrap();
    let info = serde_json::to_string(&[described("libocb_sphere_tree.so").await]).unwrap();
    let validated = "UPDATE submissions SET state = 'validated', algorithms = $1";
    sqlx::query(validated).bind(info).execute(&database).await.unwrap();
    engine.shutdown().await;

    // One family of each.
    let owner = author.owner();
    let all = [("box-tree", "me"), ("sphere-tree@1", owner.as_str())];
    let engine = opened(data.path(), true).await;
    let mut first = Vec::new();
    for (algorithm, owner) in all {
        let id = started(&engine, owner, algorithm, &[FAMILY], Some(1)).await;
        let run = ended(&engine, &id).await;
        assert_eq!(run.state, State::Done, "{:?}", run.message);
        first.push(id);
    }
    assert!(engine.stability().await.unwrap().methods.is_empty(), "a part takes nobody's place");
    engine.shutdown().await;

    // All of each, of which one family is left to be tried.
    let engine = opened(data.path(), false).await;
    let table = engine.stability().await.unwrap();
    let families = table.families.iter().map(|family| family.id.as_str());
    let names = families.chain(table.relations.iter().map(|relation| relation.id.as_str()));
    let done: Vec<&str> = names.chain(["reported", "tessellations", "search"]).filter(|name| *name != FAMILY).collect();
    let mut whole = Vec::new();
    for ((algorithm, owner), first) in all.iter().zip(first) {
        let id = started(&engine, owner, algorithm, &[], None).await;
        let most = "UPDATE stability_runs SET done = $1, found = (SELECT found FROM stability_runs WHERE id = $2) \
                    WHERE id = $3";
        let done = serde_json::to_string(&done).unwrap();
        sqlx::query(most).bind(done).bind(first).bind(&id).execute(&database).await.unwrap();
        whole.push(id);
    }
    database.close().await;
    engine.shutdown().await;
    let engine = opened(data.path(), true).await;
    for id in &whole {
        let run = ended(&engine, id).await;
        assert!(run.state == State::Done && run.result.is_some_and(|found| found.complete), "{:?}", run.message);
    }
    let methods = engine.stability().await.unwrap().methods;
    let ids: Vec<&str> = methods.iter().map(|method| method.algorithm.as_str()).collect();
    assert_eq!(ids, ["box-tree"], "nobody but its author sees what a plugin does that is not public");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fault_of_the_database_does_not_end_a_run() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), true).await;
    let database = common::database(data.path()).await;
    let refuse = "CREATE TRIGGER refuse BEFORE UPDATE ON stability_runs WHEN NEW.found IS NOT NULL \
                  BEGIN SELECT RAISE(ABORT, 'disk I/O error'); END";
    sqlx::query(refuse).execute(&database).await.unwrap();
    let id = started(&engine, "me", "box-tree", &[FAMILY], Some(1)).await;
    let begun = Instant::now();
    // The first attempt has failed when the second begins.
    while sqlx::query_scalar::<_, i64>("SELECT attempts FROM stability_runs").fetch_one(&database).await.unwrap() < 2 {
        assert!(begun.elapsed() < Duration::from_secs(60), "it is not tried again");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    sqlx::query("DROP TRIGGER refuse").execute(&database).await.unwrap();
    let run = ended(&engine, &id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_local_run_waits_for_a_measurement_and_says_so() {
    let data = tempfile::tempdir().unwrap();
    let engine = opened(data.path(), false).await;
    let right = tokio::task::spawn_blocking(|| MeasuringRight::wait(|| false, || {}).unwrap().unwrap()).await.unwrap();
    let (sender, mut steps) = tokio::sync::mpsc::unbounded_channel();
    let selection = StabilitySelection { parts: vec![FAMILY.into()], seeds: 1, ..StabilitySelection::default() };
    let at = move |step: &str| drop(sender.send(step.to_owned()));
    let run = engine.try_stability("box-tree", selection, Stop::default(), at);
    let first = async {
        let first = steps.recv().await.unwrap();
        drop(right);
        first
    };
    let (found, first) = tokio::join!(run, first);
    assert!(found.unwrap().complete);
    let second = steps.recv().await;
    assert_eq!([first, second.unwrap()], ["waiting: another process is measuring on this machine", FAMILY]);
    engine.shutdown().await;
}
