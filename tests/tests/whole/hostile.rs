//! One honest visitor goes on beside hostile ones: floods of requests without cookies, slow senders, names that nobody has, and a
//! queue that is already long.
//!
//! `OCB_HOSTILE_MINUTES` says for how long. Without it a slice is tried, in which no time is judged.

use std::collections::BTreeMap;
use std::io::Write;
use std::net::TcpStream;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use ocb_service::{Engine, EngineConfig};
use ocb_tests::place::built;
use ocb_tests::service::{Guest, Service};
use serde_json::{Value, json};

use crate::{alone, asked, empty};

const PLUGINS: [&str; 2] = ["libocb_box_tree.so", "libocb_brute_force.so"];
/// Runs that wait when the hostile visitors come: of so many owners, and of each as many as a guest may have.
const OWNERS: [u64; 2] = [2, 500];
const RUNS_OF_EACH: u64 = 20;
/// Networks of the hostile visitors, in a slice and in the campaign.
const ADDRESSES: [u64; 2] = [4, 8];
const SLOW_SENDERS: usize = 50;
/// What the honest visitor looks at, below the address of the service.
const LOOKED_AT: [&str; 6] =
    ["/", "/board", "/api/v1/status", "/api/v1/objects", "/api/v1/algorithms", "/api/v1/featured"];
/// What it asks then.
const ESTIMATES: &str = "/estimates";
/// Milliseconds of its looks and of its question.
type Journey = [f64; LOOKED_AT.len() + 1];
/// The hostile visitors reach a limit within this time, however soon the honest one's run is done.
const TO_A_LIMIT: Duration = Duration::from_secs(60);
/// The honest visitor's journeys before the hostile ones come, in a slice and in the campaign, which compares them.
const QUIET_JOURNEYS: [usize; 2] = [20, 60];
/// Before each journey, where they are compared: a machine answers sooner what it has just answered.
const PAUSE: Duration = Duration::from_millis(500);
/// The service has no more memory than this at any time, KiB.
const MEMORY_KIB: u64 = 250 << 10;

/// How many requests of the hostile visitors were answered with which status.
type Answers = Mutex<BTreeMap<u16, u64>>;

#[test]
fn one_honest_visitor_goes_on_beside_hostile_ones() {
    let _alone = alone();
    let minutes = asked("OCB_HOSTILE_MINUTES", 0);
    let [owners, addresses] = [OWNERS, ADDRESSES].map(|of| of[usize::from(minutes > 0)]);
    let data = empty("hostile");
    let service = Service::start_with(&data, &PLUGINS);
    let honest = Guest::from_address("198.51.100.7");
    // Something is measured then, too.
    let mut asked_for = run(20_000, 60.0);
    asked_for["passes"] = json!(20);
    let long = honest.submit(&service, &asked_for);
    honest.wait(&service, &long, "it is measured", |run| run["state"] == "running");
    let pause = if minutes > 0 { PAUSE } else { Duration::ZERO };
    let mut quiet = Vec::new();
    for _ in 0..QUIET_JOURNEYS[usize::from(minutes > 0)] {
        std::thread::sleep(pause);
        quiet.push(journey(&honest, &service));
    }
    honest.wait(&service, &long, "it is still measured", |run| run["state"] == "running");
    honest.post(&service, &format!("/runs/{long}/cancel"), &json!({}));
    service.kill();
    fill_the_queue(&data, owners);

    let service = Service::start_with(&data, &PLUGINS);
    let (stop, answers) = (AtomicBool::new(false), Answers::default());
    let (beside, turns) = std::thread::scope(|scope| {
        for number in 0..addresses {
            let (service, stop, answers) = (&service, &stop, &answers);
            scope.spawn(move || flood(service, number, stop, answers));
        }
        scope.spawn(|| send_slowly(&service, &stop));
        // Also when something fails below.
        let _ended = Ended(&stop);
        let turns = scope.spawn(|| turns(&service, owners + addresses, minutes, &stop, &answers));
        let mut beside = Vec::new();
        while !turns.is_finished() {
            beside.push(journey(&honest, &service));
            std::thread::sleep(PAUSE);
        }
        (beside, turns.join().expect("the honest visitor's runs"))
    });
    let peak = memory_kib(&service);
    let answers = answers.into_inner().unwrap_or_else(PoisonError::into_inner);
    let (before, during) = (median(whole(&quiet)), median(whole(&beside)));
    println!(
        "{} hostile visitors, {} runs waiting: a journey of the honest one took {before:.1} ms before (n = {}), {during:.1} ms \
         beside them (n = {}); {turns} runs of theirs had their turn; the others were answered {answers:?}; at most {} MiB",
        addresses + SLOW_SENDERS as u64,
        owners * RUNS_OF_EACH,
        quiet.len(),
        beside.len(),
        peak >> 10
    );
    for (at, part) in LOOKED_AT.iter().chain([&ESTIMATES]).enumerate() {
        let [before, during] = [&quiet, &beside].map(|all| median(all.iter().map(|times| times[at]).collect()));
        println!("{part}: {before:.1} ms before, {during:.1} ms beside them");
    }
    assert!(answers.keys().all(|status| *status < 500), "{answers:?}");
    assert!(answers.get(&429).is_some_and(|refused| *refused > 0), "nobody was refused anything: {answers:?}");
    assert!(peak < MEMORY_KIB, "{} MiB", peak >> 10);
    if minutes > 0 {
        assert!(during <= 2.0 * before, "{during:.1} ms instead of {before:.1} ms");
    }
}

/// Ends the hostile visitors.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

fn run(count: u64, budget_seconds: f64) -> Value {
    json!({
        "object_a": "stock:torus-knot@600", "query": "collision_first", "algorithms": ["box-tree"], "passes": 1,
        "budget_seconds": budget_seconds,
        "method": {"kind": "sphere", "seed": 1, "sampling": {"kind": "count", "count": count}},
    })
}

/// As guests of earlier days left it.
fn fill_the_queue(data: &Path, owners: u64) {
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    runtime.block_on(async {
        let engine = Engine::open(EngineConfig {
            runner: built("ocb-runner"),
            plugins: PLUGINS.map(built).to_vec(),
            dispatch: false,
            ..EngineConfig::beside_executable(data)
        });
        let engine = engine.await.expect("the data folder");
        let spec: ocb_service::model::RunSpec = serde_json::from_value(run(20, 1.0)).expect("a request");
        for number in 0..owners * RUNS_OF_EACH {
            let owner = format!("0193f1a0-0000-4000-8000-{:012}", number % owners);
            engine.submit(spec.clone(), Some(&owner)).await.expect("it is queued");
        }
        engine.shutdown().await;
    });
}

/// Milliseconds in which the honest visitor has looked at each page, and asked what a run would take.
fn journey(honest: &Guest, service: &Service) -> Journey {
    let mut times = Journey::default();
    let mut begun = Instant::now();
    for (at, time) in times.iter_mut().enumerate() {
        if let Some(path) = LOOKED_AT.get(at) {
            honest.page(service, path);
        } else {
            let (status, told) = honest.post(service, ESTIMATES, &run(20, 1.0));
            assert_eq!(status, 200, "{told}");
        }
        *time = 1e3 * begun.elapsed().as_secs_f64();
        begun = Instant::now();
    }
    times
}

fn whole(journeys: &[Journey]) -> Vec<f64> {
    journeys.iter().map(|times| times.iter().sum()).collect()
}

/// Runs of a second honest visitor, one after the other, each of which has to start in its turn; how many there were.
fn turns(service: &Service, others: u64, minutes: u64, stop: &AtomicBool, answers: &Answers) -> usize {
    let honest = Guest::from_address("198.51.100.8");
    // Every other visitor has one turn before it, and one run is under way; one more may come between two looks.
    let most = others + 2;
    let (begun, mut done) = (Instant::now(), 0);
    let refused = || answers.lock().unwrap_or_else(PoisonError::into_inner).contains_key(&429);
    let lasting = || begun.elapsed() < Duration::from_secs(60 * minutes) || !refused() && begun.elapsed() < TO_A_LIMIT;
    while done == 0 || lasting() {
        let id = honest.submit(service, &run(20, 1.0));
        let end = Instant::now() + Duration::from_secs(600 + 10 * most);
        loop {
            let now = honest.get(service, &format!("/runs/{id}"));
            let ahead = now["runs_ahead"].as_u64().expect("a number");
            assert!(ahead <= most, "{ahead} runs before it, and there are {most} visitors");
            if now["state"] == "done" {
                break;
            }
            assert!(now["state"] == "queued" || now["state"] == "running", "{now}");
            assert!(Instant::now() < end, "its turn does not come: {now}");
            std::thread::sleep(Duration::from_millis(100));
        }
        done += 1;
    }
    stop.store(true, Ordering::Relaxed);
    done
}

/// A visitor who never shows a cookie, from one network: runs, objects, advice, and names that nobody has.
fn flood(service: &Service, number: u64, stop: &AtomicBool, answers: &Answers) {
    let address = format!("203.0.113.{number}");
    let advice = json!({"object_a": "stock:torus-knot@600", "question": {"kind": "distance", "tolerance": 0.01}});
    for turn in 0_usize.. {
        if stop.load(Ordering::Relaxed) {
            return;
        }
        let stranger = Guest::from_address(&address);
        let name = "x".repeat(1 + (turn * 997) % 60_000);
        let told = match turn % 4 {
            0 => stranger.send(service, "/runs", &run(20, 1.0)),
            1 => stranger.send_object(service, "o.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
            2 => stranger.send(service, "/advice", &advice),
            _ => stranger.send(service, "/account/login", &json!({"name": name, "password": "a wrong password"})),
        };
        if let Some((status, _)) = told {
            *answers.lock().unwrap_or_else(PoisonError::into_inner).entry(status).or_default() += 1;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// Fifty connections that send an object at 40 KB/s each, and begin again when they are cut.
fn send_slowly(service: &Service, stop: &AtomicBool) {
    let address = service.pages().trim_start_matches("http://");
    let begin = || {
        let mut stream = TcpStream::connect(address).ok()?;
        let head = "POST /api/v1/objects HTTP/1.1\r\nHost: localhost\r\nX-Forwarded-For: 203.0.113.99\r\n\
                    Content-Type: multipart/form-data; boundary=b\r\nContent-Length: 100000000\r\n\r\n\
                    --b\r\nContent-Disposition: form-data; name=\"file\"; filename=\"slow.obj\"\r\n\r\n";
        stream.write_all(head.as_bytes()).ok()?;
        Some(stream)
    };
    let mut streams: Vec<Option<TcpStream>> = (0..SLOW_SENDERS).map(|_| begin()).collect();
    while !stop.load(Ordering::Relaxed) {
        for stream in &mut streams {
            let sent = stream.as_mut().is_some_and(|stream| stream.write_all(&[b'#'; 4000]).is_ok());
            if !sent {
                *stream = begin();
            }
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

fn memory_kib(service: &Service) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", service.pid())).expect("the service runs");
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("its most memory");
    line.trim().trim_end_matches("kB").trim().parse().expect("a number")
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
