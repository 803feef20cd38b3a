//! An advisor that fails costs its advice and nothing else, and it dies with the service.
//!
//! This program has no test harness: it is also the advisor's program, and with `--service` the service that is killed.

mod common;

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use ocb_advice::work::{Order, Parts, Reply, Rung, Task};
use ocb_advice::{Certificate, Question, Unwatched, VERSION};
use ocb_core::mesh::Mesh;
use ocb_sandbox::inside::task;
use ocb_service::advising::Advisor;
use ocb_service::model::{AdviceInfo, AdviceSpec, Asked, State};
use ocb_service::truth::Machine;
use ocb_service::{Engine, EngineConfig, Visitor};

/// Objects of some 1200 triangles and of fewer.
const KNOT: &str = "stock:torus-knot@1200";
const SMALL: &str = "stock:torus-knot@600";

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.get(1).map(String::as_str) {
        Some("launch" | "run") => task::main(|order, _, _| misbehave(order)),
        Some("--service") => service(Path::new(&arguments[2])),
        Some("--list") => println!("advisor: test"),
        _ => {
            what_an_advisor_does_wrong_costs_its_advice_alone();
            println!("an advisor that fails ... ok");
            an_advisor_dies_with_its_service();
            println!("an advisor whose service is killed ... ok");
        }
    }
}

/// What the program does, by the object and by the tolerance of the question.
fn misbehave(order: &[u8]) -> Vec<u8> {
    let order: Order = serde_json::from_slice(order).unwrap();
    let scene = match order.task {
        Task::Ladder { object, .. } => {
            let object = object.mesh().unwrap();
            let levels = if object.triangles().len() < 800 { vec![lie(&object)] } else { Vec::new() };
            return serde_json::to_vec(&Reply::Ladder(levels)).unwrap();
        }
        // A hull without corners that are there.
        Task::Simplify(_) => {
            return br#"{"Simpler": {"levels": [], "hull": {"positions": [], "triangles": [[0, 1, 2]]}, "parts": []}}"#
                .to_vec();
        }
        Task::Advise(scene) => scene,
    };
    let Question::Distance { tolerance } = scene.question else { panic!("only distances are asked") };
    match tolerance / scene.a.mesh.mesh().unwrap().longest_side() {
        share if share < 0.015 => std::process::abort(),
        share if share < 0.025 => format!("{:?}", std::net::TcpStream::connect("127.0.0.1:9")).into_bytes(),
        share if share < 0.035 => b"{\"Advice\": {}".to_vec(),
        share if share < 0.045 => serde_json::to_vec(&Reply::Ladder(Vec::new())).unwrap(),
        _ => loop {
            std::hint::spin_loop();
        },
    }
}

/// A level of a single triangle, whose points are said to be nearer to the object than it is to itself.
fn lie(object: &Mesh) -> Rung {
    let reduced = Mesh::new(object.corners(0).to_vec(), vec![[0, 1, 2]]).unwrap();
    let (thickness, deviation) = (vec![-1.0], vec![0.0]);
    let certificate =
        Certificate { version: VERSION, object: object.sha256(), reduced: reduced.sha256(), thickness, deviation };
    Rung { mesh: Parts::of(&reduced), certificate }
}

fn config(data: &Path) -> EngineConfig {
    let advisor = data.join("failing-advisor");
    EngineConfig { advisor, quick_advice: true, dispatch: true, ..common::idle_config(data) }
}

/// From now on this is the advisor's program.
fn advisor(data: &Path, program: &Path) {
    let _ = std::fs::remove_file(data.join("failing-advisor"));
    std::os::unix::fs::symlink(program, data.join("failing-advisor")).unwrap();
}

/// This program is the advisor's.
fn this_program(data: &Path) {
    advisor(data, &std::env::current_exe().unwrap());
}

async fn ask(engine: &Engine, object: &str, tolerance: f64) -> String {
    let question = Asked::Distance { tolerance };
    let spec = AdviceSpec { object_a: object.to_owned(), object_b: None, question };
    let visitor = Visitor { owner: "me".to_owned(), address: None };
    engine.ask_advice(spec, &visitor, None).await.expect("it is asked").0.id
}

async fn ended(engine: &Engine, id: &str) -> AdviceInfo {
    loop {
        let info = engine.advice(id).await.expect("it is there");
        if !matches!(info.state, State::Queued | State::Running) {
            return info;
        }
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

#[tokio::main]
async fn what_an_advisor_does_wrong_costs_its_advice_alone() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path();
    let engine = Engine::open(config(data)).await.expect("the folder opens");
    this_program(data);
    for (object, tolerance, told) in [
        (KNOT, 0.01, "it crashed with signal 6"),
        (KNOT, 0.02, "it made the forbidden system call socket"),
        (KNOT, 0.03, "its reply makes no sense"),
        (KNOT, 0.04, "its reply makes no sense"),
        (SMALL, 0.01, "its reply makes no sense"),
    ] {
        let info = ended(&engine, &ask(&engine, object, tolerance).await).await;
        let told = format!("The advisor failed: {told}.");
        assert_eq!((info.state, info.message), (State::Failed, Some(told)), "{object}, {tolerance}");
    }
    let simplified = || {
        let knot = Arc::new(ocb_core::stock::generate("torus-knot", 2000).unwrap());
        let advisor = Advisor::new(&data.join("failing-advisor"), &Machine::observe().unwrap(), data);
        // A thread of its own, which lives as long as the work.
        std::thread::scope(|scope| scope.spawn(|| advisor.simplify("knot", &knot, &Unwatched)).join().unwrap())
    };
    assert!(simplified().unwrap_err().to_string().contains("its reply makes no sense"));
    // One that never ends is stopped.
    let id = ask(&engine, KNOT, 0.05).await;
    while engine.advice(&id).await.expect("it is there").state == State::Queued || processes().is_empty() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    engine.cancel_advice(&id, Some("me")).await.expect("its owner may");
    assert_eq!(ended(&engine, &id).await.state, State::Cancelled);
    assert_eq!(processes(), Vec::<i32>::new());
    // The next advice is as good as ever.
    advisor(data, &common::built().join("ocb-advisor"));
    let made = simplified().unwrap().unwrap();
    let triangles: Vec<usize> = made.levels.iter().map(|level| level.triangles().len()).collect();
    assert!(triangles.len() > 2 && triangles.is_sorted_by(|a, b| a > b) && made.hull.is_some(), "{triangles:?}");
    let info = ended(&engine, &ask(&engine, KNOT, 0.05).await).await;
    assert_eq!(info.state, State::Done, "{:?}", info.message);
    assert!(info.advice.is_some_and(|advice| advice.triangles_after < advice.triangles_before));
    engine.shutdown().await;
}

/// A service whose advisor never ends.
#[tokio::main]
async fn service(data: &Path) {
    let engine = Engine::open(config(data)).await.expect("the folder opens");
    let id = ask(&engine, KNOT, 0.05).await;
    println!("asked");
    ended(&engine, &id).await;
}

#[expect(clippy::disallowed_methods, reason = "the test kills a service")]
fn an_advisor_dies_with_its_service() {
    let folder = tempfile::tempdir().unwrap();
    this_program(folder.path());
    let mut service = Command::new(std::env::current_exe().unwrap());
    let mut service = service.arg("--service").arg(folder.path()).stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(service.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert_eq!(line, "asked\n");
    let until = |is: &dyn Fn() -> bool| {
        while !is() {
            std::thread::sleep(Duration::from_millis(10));
        }
    };
    until(&|| !processes().is_empty());
    service.kill().unwrap();
    service.wait().unwrap();
    until(&|| processes().is_empty());
}

/// Process ids of jailed programs that were started as these tests do it.
fn processes() -> Vec<i32> {
    let all = std::fs::read_dir("/proc").unwrap().flatten();
    let ids = all.filter_map(|entry| entry.file_name().to_str()?.parse::<i32>().ok());
    let is = |id: &i32| {
        std::fs::read(format!("/proc/{id}/cmdline")).is_ok_and(|line| line.starts_with(b"failing-advisor\0run\0"))
    };
    ids.filter(is).collect()
}
