//! Killing the service at each stage and starting it again finishes the run.
//!
//! Without the usual harness, because the test needs itself as a second program: the service that is killed.

mod common;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use futures::StreamExt;
use ocb_service::Engine;
use ocb_service::model::{AccountInfo, AlgorithmResult, Page, PluginState, Role, RunSpec, StageKind, State};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.get(1).map(String::as_str) {
        Some("--service") => service(Path::new(&arguments[2])),
        Some("--check") => check(Path::new(&arguments[2])),
        // Cargo asks for the list of tests with this flag.
        Some("--list") => println!("killed_service: test"),
        _ => {
            for stage in [StageKind::Object, StageKind::Configurations, StageKind::Measuring, StageKind::Heatmap] {
                killed_at(stage);
                println!("killed at {stage:?}: the run was finished ... ok");
            }
            killed_too_often();
            println!("killed three times: the run is given up ... ok");
            checked_too_often();
            println!("killed three times: the check is given up, and its author is told once ... ok");
        }
    }
}

/// Long enough in each stage to be met there.
fn spec() -> RunSpec {
    RunSpec {
        algorithms: vec!["box-tree".into(), "parry".into()],
        budget_seconds: 2.0,
        ..common::spec("proximity", 1500, 11)
    }
}

/// The service: works on the folder and prints what happens. Queues one run when there is none.
#[tokio::main]
async fn service(data: &Path) {
    let engine = Engine::open(common::config(data)).await.expect("the folder opens");
    let run = match engine.runs("me", &Page::default()).await.expect("the runs can be read").entries.pop() {
        Some(run) => run,
        None => engine.submit(spec(), Some("me")).await.expect("the run is queued"),
    };
    // What was there before this start is not news.
    let seen = engine.events(&run.id, 0).await.expect("events").last().map_or(0, |e| e.seq);
    let after = if run.attempts == 0 { 0 } else { seen };
    let mut events = Box::pin(engine.follow(&run.id, after).await.expect("events"));
    while let Some(event) = events.next().await {
        if let Some(stage) = event.expect("an event").stage {
            println!("{:?} {:?} {}", stage.kind, stage.state, stage.done);
        }
    }
    let run = engine.run(&run.id, None).await.expect("the run is there");
    println!("end {}", serde_json::to_string(&run).expect("JSON"));
    engine.shutdown().await;
}

/// The author of the plugin that is checked.
async fn author(engine: &Engine) -> AccountInfo {
    let (name, password) = ("author", "a long enough password");
    match engine.account_with(name, password).await {
        Ok(author) => author,
        Err(_) => engine.add_account(name, password, Role::Developer).await.expect("an account"),
    }
}

/// A service with a plugin to check, which prints its state over and over.
#[tokio::main]
async fn check(data: &Path) {
    let engine = Engine::open(common::config(data)).await.expect("the folder opens");
    let author = author(&engine).await;
    let plugins = engine.plugins(Some(&author), &Page::default()).await.expect("the plugins can be read").entries;
    let id = match plugins.into_iter().next() {
        Some(plugin) => plugin.id,
        None => {
            let file = common::config(data).runner.with_file_name("libocb_sphere_tree.so");
            let manifest = serde_json::from_value(serde_json::json!({
                "name": "Tree", "version": "1", "authors": "Somebody", "license": "MIT", "queries": ["proximity"],
            }));
            let bytes = std::fs::read(file).expect("a plugin");
            let sent = engine.submit_plugin(&author, "tree.so", bytes, manifest.expect("a manifest"), None).await;
            sent.expect("it is taken").0.id
        }
    };
    loop {
        let plugin = engine.plugin(&id, Some(&author)).await.expect("the plugin is there");
        println!("{}", plugin.state.name());
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

#[expect(clippy::disallowed_methods, reason = "the test starts itself as the service that it kills")]
fn start(how: &str, data: &Path) -> (Child, impl Iterator<Item = String>) {
    let mut child = Command::new(std::env::current_exe().expect("own file"))
        .arg(how)
        .arg(data)
        .stdout(Stdio::piped())
        .spawn()
        .expect("the service starts");
    let lines = BufReader::new(child.stdout.take().expect("piped")).lines().map_while(Result::ok);
    (child, lines)
}

/// Kills the service as soon as it prints that it is in this stage.
fn kill_in(stage: StageKind, data: &Path) {
    let (child, lines) = start("--service", data);
    let wanted = format!("{stage:?} Running");
    // Measuring has begun only when an answer has come.
    let there = |line: &String| line.starts_with(&wanted) && !(stage == StageKind::Measuring && line.ends_with(" 0"));
    assert!(kill_at(child, lines, there), "the service never came to the stage {stage:?}");
}

/// Kills the service as soon as it prints such a line; false when it never did.
fn kill_at(mut child: Child, mut lines: impl Iterator<Item = String>, there: impl Fn(&String) -> bool) -> bool {
    let met = lines.find(there);
    child.kill().expect("SIGKILL");
    child.wait().expect("reaped");
    met.is_some()
}

fn run_to_the_end(data: &Path) -> ocb_service::model::RunInfo {
    let (mut child, lines) = start("--service", data);
    let end = lines.filter_map(|line| line.strip_prefix("end ").map(str::to_owned)).last();
    assert!(child.wait().expect("reaped").success());
    serde_json::from_str(&end.expect("the service tells the end")).expect("JSON")
}

fn killed_at(stage: StageKind) {
    let data = tempfile::tempdir().expect("a folder");
    kill_in(stage, data.path());
    let run = run_to_the_end(data.path());
    assert_eq!(run.state, State::Done, "killed at {stage:?}: {:?}", run.message);
    assert!(run.stages.iter().all(|s| s.state == State::Done), "{:?}", run.stages);
    assert_eq!(run.results.len(), 2);
    // The slower one may need more than its budget on a busy machine.
    let whole = |r: &AlgorithmResult| r.n > 0 && r.wrong == 0 && (r.n == r.of || r.budget_limited);
    assert!(run.results.iter().all(whole), "{:?}", run.results);
    let saved = run.stages[1].message.as_deref().is_some_and(|m| m.contains("Saved positions"));
    match stage {
        StageKind::Object => {}
        StageKind::Configurations => assert!(run.attempts == 2 && !saved, "{run:?}"),
        StageKind::Measuring => assert!(run.attempts == 2 && saved, "what was found before the kill is used again"),
        // Aggregating is quick: the run may have ended in the moment of the kill.
        StageKind::Heatmap => assert!(run.attempts == 1 || saved, "{run:?}"),
    }
    std::io::stdout().flush().expect("stdout");
}

fn killed_too_often() {
    let data = tempfile::tempdir().expect("a folder");
    for _ in 0..3 {
        kill_in(StageKind::Measuring, data.path());
    }
    let run = run_to_the_end(data.path());
    assert_eq!((run.state, run.attempts), (State::Failed, 3));
    assert!(run.message.as_deref().is_some_and(|m| m.contains("3 times")), "{:?}", run.message);
}

#[tokio::main]
async fn checked_too_often() {
    let data = tempfile::tempdir().expect("a folder");
    for _ in 0..3 {
        let (child, lines) = start("--check", data.path());
        // A state that only a check that began in this service has.
        assert!(kill_at(child, lines, |state| state == "vetted"), "the check never began");
    }
    // What became of it is there before anything else begins, and once.
    for _ in 0..2 {
        let engine = Engine::open(common::config(data.path())).await.expect("the folder opens");
        let author = author(&engine).await;
        let plugins = engine.plugins(Some(&author), &Page::default()).await.expect("the plugins can be read").entries;
        let plugin = engine.plugin(&plugins[0].id, Some(&author)).await.expect("the plugin is there");
        assert!(plugin.state == PluginState::Failed && plugin.reason.contains("3 times"), "{plugin:?}");
        let noted: Vec<&str> = plugin.history.iter().map(|entry| entry.action.as_str()).collect();
        assert_eq!(noted, ["submitted", "failed the check"]);
        let told = engine.notices(&author, &Page::default()).await.expect("notices").entries;
        assert!(matches!(&told[..], [one] if one.text.contains("3 times")), "{told:?}");
        engine.shutdown().await;
    }
}
