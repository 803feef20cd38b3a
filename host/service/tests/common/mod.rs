//! What the tests of the whole engine share.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use ocb_core::query::Query;
use ocb_service::model::{Ended, MachineFacts, Manifest, NextWork, RunEvent, RunInfo, RunSpec, Sentinel, WorkOrder};
use ocb_service::worker::{Handed, Report, Seen, Worker};
use ocb_service::{Engine, EngineConfig, EngineError, Handing, LabError, Runner, Stop};
use tokio::runtime::Handle;

/// The folder where cargo puts binaries and plugins; test binaries lie in `deps` below it.
pub fn built() -> PathBuf {
    let exe = std::env::current_exe().expect("a test knows its own file");
    exe.ancestors().nth(2).expect("target/release").to_path_buf()
}

/// An engine over this folder with the plugins that ship with the service.
pub fn config(data: &Path) -> EngineConfig {
    let built = built();
    let plugins = ["brute_force", "box_tree", "parry"].map(|name| built.join(format!("libocb_{name}.so")));
    for file in plugins.iter().chain([&built.join("ocb-runner")]) {
        assert!(file.is_file(), "{} is missing: run `make test`, or `cargo build --release` first", file.display());
    }
    EngineConfig {
        runner: built.join("ocb-runner"),
        advisor: built.join("ocb-advisor"),
        plugins: plugins.to_vec(),
        ..EngineConfig::beside_executable(data)
    }
}

/// An engine that offers no algorithm and measures nothing.
pub fn idle_config(data: &Path) -> EngineConfig {
    let advisor = built().join("ocb-advisor");
    EngineConfig { advisor, plugins: Vec::new(), dispatch: false, ..EngineConfig::beside_executable(data) }
}

/// A small run: `count` configurations of a torus knot of 600 triangles against itself.
pub fn spec(query: &str, count: u32, seed: u64) -> RunSpec {
    serde_json::from_value(serde_json::json!({
        "object_a": "stock:torus-knot@600", "query": query, "passes": 2, "budget_seconds": 20.0,
        "method": {"kind": "sphere", "seed": seed, "sampling": {"kind": "count", "count": count}},
    }))
    .expect("a spec")
}

/// Follows the run to its end.
pub async fn finish(engine: &Engine, id: &str) -> (RunInfo, Vec<RunEvent>) {
    use futures::StreamExt;
    let events = engine.follow(id, 0).await.expect("the run is there");
    let events: Vec<RunEvent> = events.map(|e| e.expect("an event")).collect().await;
    (engine.run(id, None).await.expect("the run is there"), events)
}

/// Copies a folder with all that is in it.
pub fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").map(|entry| entry.expect("an entry")) {
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &to);
        } else {
            fs::copy(path, to).expect("a copy");
        }
    }
}

/// Files below a folder.
pub fn files(folder: &Path) -> usize {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    entries.flatten().map(|e| if e.path().is_dir() { files(&e.path()) } else { 1 }).sum()
}

/// A right plugin that takes so many milliseconds to build an object and to answer, under so many names.
#[expect(clippy::disallowed_methods, reason = "the test compiles a plugin")]
pub fn slow(folder: &Path, build: u32, query: u32, algorithms: u32) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join(format!("slow-{build}-{query}-{algorithms}.so"));
    let mut cc = std::process::Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden"]);
    cc.args([("BUILD_MS", build), ("QUERY_MS", query), ("OFFERED", algorithms)].map(|(k, v)| format!("-D{k}={v}")));
    cc.arg("-I").arg(here.join("../../plugin-api/include")).arg("-I").arg(here.join("../../plugin-api/templates/c"));
    assert!(cc.arg(here.join("tests/fixtures/slow.c")).arg("-o").arg(&file).status().unwrap().success());
    file
}

/// A check of a second.
pub fn quick() -> ocb_service::Extent {
    ocb_service::Extent { quick: true, ..ocb_service::Extent::default() }
}

/// The database of an engine's data folder, to make it fail.
pub async fn database(data: &Path) -> sqlx::AnyPool {
    sqlx::any::install_default_drivers();
    let file = data.join("opencollbench.sqlite");
    sqlx::AnyPool::connect(&format!("sqlite://{}", file.display())).await.expect("the database")
}

/// This process as a measuring machine of such a service.
pub fn here(config: &EngineConfig) -> Worker {
    observed(config, None)
}

/// The same with a note, which makes it one of another hardware class.
pub fn noted(config: &EngineConfig, note: &str) -> Worker {
    observed(config, Some(note))
}

fn observed(config: &EngineConfig, note: Option<&str>) -> Worker {
    let runner = Runner { program: config.runner.clone(), profile: config.profile };
    Worker::observe(runner, &config.plugins, note).unwrap()
}

/// The file of a suite with one scenario.
pub fn small_suite(data: &Path) -> PathBuf {
    let object = "stock:torus-knot@600";
    let document = serde_json::json!({
        "version": 3, "scenes": [[object, object]], "separations": [{ "kind": "relative", "distance": 0.1 }],
        "queries": ["collision_first"], "configurations": 30, "passes": 1, "budget_seconds": 5.0,
    });
    let file = data.join("suite.json");
    std::fs::write(&file, document.to_string()).unwrap();
    file
}

/// The next order for a machine, on which the sentinel always takes the same.
pub async fn next(
    engine: &Engine,
    machine: &str,
    facts: &MachineFacts,
    wait: Duration,
) -> Result<Option<WorkOrder>, EngineError> {
    loop {
        match engine.next_order(machine, facts, wait).await? {
            NextWork::Run(order) => return Ok(Some(*order)),
            // What an idle service asks of its machines besides runs.
            NextWork::Errand(errand) => {
                engine.hand_in(machine, &errand.attempt, Handing { ended: Ended::PutBack, files: Vec::new() }).await?;
                if wait.is_zero() {
                    return Ok(None);
                }
                tokio::time::sleep(Duration::from_millis(50)).await;
            }
            NextWork::Nothing => return Ok(None),
            NextWork::Sentinel(_) => engine.sentinel_of(machine, Sentinel::Measured { median_ns: 1000.0 }).await?,
        }
    }
}

/// Measures what is ordered in this process, and shows what there is to see meanwhile.
pub async fn measured(engine: &Engine, machine: &str, worker: Worker, order: &WorkOrder) -> (Worker, Handed) {
    let (shows, machine_that_shows, attempt) = (engine.clone(), machine.to_owned(), order.attempt.clone());
    let show = move |seen| {
        let shown = Handle::current().block_on(shows.seen_of(&machine_that_shows, &attempt, seen));
        assert!(shown.unwrap(), "the attempt is current");
    };
    watched(engine, machine, worker, order, show).await
}

/// The same, with whoever looks at what there is to see.
pub async fn watched(
    engine: &Engine,
    machine: &str,
    worker: Worker,
    order: &WorkOrder,
    mut look: impl FnMut(Seen) + Send + 'static,
) -> (Worker, Handed) {
    let (engine, machine, order, handle) = (engine.clone(), machine.to_owned(), order.clone(), Handle::current());
    // Other tests may measure for longer than a lease.
    let (beats, of) = (engine.clone(), (machine.clone(), order.attempt.clone()));
    let beating = tokio::spawn(async move {
        loop {
            tokio::time::sleep(Duration::from_secs(2)).await;
            let _ = beats.beat_of(&of.0, &of.1, Vec::new()).await;
        }
    });
    let work = move || {
        let fetch = |name: &str| {
            let file = handle.block_on(engine.file_of_order(&machine, &order.attempt, name));
            file.map_err(|e| LabError::Fault(e.to_string()))
        };
        let mut tell = |report| {
            if let Report::Seen(seen) = report {
                look(*seen);
            }
        };
        let handed = worker.measure(&order, &Stop::default(), &fetch, &mut tell).unwrap().unwrap();
        (worker, handed)
    };
    let done = tokio::task::spawn_blocking(work).await;
    beating.abort();
    done.unwrap()
}

/// What the author of [`slow`] says of it.
pub fn manifest() -> Manifest {
    Manifest {
        name: "Slow".into(),
        version: "1.0".into(),
        authors: "Somebody".into(),
        license: "MIT OR Apache-2.0".into(),
        paper: String::new(),
        source: String::new(),
        queries: vec![Query::CollisionFirst],
        threads: false,
    }
}
