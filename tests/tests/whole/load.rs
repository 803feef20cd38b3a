//! Two hundred visitors at once, on pages and on event streams, while a run is measured; fifty uploads at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use futures::StreamExt;
use futures::future::join_all;
use ocb_tests::service::{Guest, Service, add_account};
use reqwest::multipart::{Form, Part};
use reqwest::{Client, StatusCode};
use serde_json::{Value, json};

use crate::{alone, asked, empty};

pub const VISITORS: usize = 200;
const UPLOADS: usize = 50;

/// What a visitor looks at between two waits, below the address of the service; `{run}` is the run under way.
const LOOKED_AT: [&str; 10] = [
    "/",
    "/board",
    "/r/{run}",
    "/api/v1/status",
    "/api/v1/runs/{run}",
    "/api/v1/board",
    "/api/v1/objects",
    "/api/v1/algorithms",
    "/api/v1/plugins",
    "/api/v1/openapi.json",
];
/// How long somebody looks at a page.
const LOOK: Duration = Duration::from_millis(900);
/// So many pages somebody looks at, however slow the machine is.
const FEWEST_LOOKS: usize = 2;

/// A visitor's browser. The service is on this machine: to read the system's certificates for each would keep a CPU busy for long.
fn client() -> Client {
    let builder = Client::builder().tls_certs_only([]).cookie_store(true);
    builder.timeout(Duration::from_secs(60)).build().expect("a client")
}

/// What all visitors together did.
#[derive(Default)]
pub struct Seen {
    /// Answers that they got.
    pub answers: AtomicU64,
    events: AtomicU64,
    /// How long the slowest waited for the first event, in milliseconds.
    slowest: AtomicU64,
}

/// Looks at a few pages, and at more until `end`; every answer must be a good one.
pub async fn browse(service: String, run: String, first: usize, end: Instant, seen: Arc<Seen>) {
    let client = client();
    // They do not come in step.
    tokio::time::sleep(LOOK.mul_f64(first as f64 / VISITORS as f64)).await;
    for (looks, at) in (0..LOOKED_AT.len()).cycle().skip(first % LOOKED_AT.len()).enumerate() {
        if looks >= FEWEST_LOOKS && Instant::now() >= end {
            return;
        }
        let path = LOOKED_AT[at].replace("{run}", &run);
        let answer = client.get(format!("{service}{path}")).send().await.unwrap_or_else(|e| panic!("{path}: {e}"));
        assert_eq!(answer.status(), StatusCode::OK, "{path}");
        let body = answer.bytes().await.unwrap_or_else(|e| panic!("{path}: {e}"));
        assert!(!body.is_empty(), "{path}");
        seen.answers.fetch_add(1, Ordering::Relaxed);
        tokio::time::sleep(LOOK).await;
    }
}

/// Follows the run's events until it ends or until `end`; the first one comes, if late on a busy machine.
pub async fn follow(service: String, run: String, end: Instant, seen: Arc<Seen>) {
    let path = format!("{service}/api/v1/runs/{run}/events");
    let began = Instant::now();
    let answer = client().get(&path).send().await.unwrap_or_else(|e| panic!("{path}: {e}"));
    assert_eq!(answer.status(), StatusCode::OK, "{path}");
    let mut stream = answer.bytes_stream();
    let (mut told, mut heard) = (String::new(), false);
    loop {
        let next = stream.next();
        let next = if heard { tokio::time::timeout_at(end.into(), next).await.ok().flatten() } else { next.await };
        let Some(chunk) = next else { break };
        told.push_str(&String::from_utf8_lossy(&chunk.unwrap_or_else(|e| panic!("{path}: {e}"))));
        if !heard && told.contains("id: ") {
            heard = true;
            seen.slowest.fetch_max(began.elapsed().as_millis() as u64, Ordering::Relaxed);
        }
    }
    // Preliminary results are not kept, and have the number of the event before them.
    let kept = told.split("\n\n").filter(|event| !event.contains("\"preliminary\":true"));
    let number = |event: &str| event.lines().find_map(|line| line.strip_prefix("id: ")?.trim().parse().ok());
    let numbers: Vec<u64> = kept.filter_map(number).collect();
    assert!(!numbers.is_empty() && numbers.iter().zip(1..).all(|(number, at)| *number == at), "{numbers:?}");
    seen.events.fetch_add(numbers.len() as u64, Ordering::Relaxed);
}

/// Half of the visitors browse, half follow the run.
async fn visit(service: &Service, run: &str, duration: Duration) -> Arc<Seen> {
    let (seen, end) = (Arc::<Seen>::default(), Instant::now() + duration);
    let visitors = (0..VISITORS).map(|visitor| {
        let (service, run, seen) = (service.pages().to_owned(), run.to_owned(), seen.clone());
        if visitor % 2 == 0 {
            tokio::spawn(browse(service, run, visitor, end, seen))
        } else {
            tokio::spawn(follow(service, run, end, seen))
        }
    });
    for visitor in join_all(visitors).await {
        visitor.expect("no visitor sees an error");
    }
    seen
}

/// A run that measures for `seconds` with each of two algorithms.
fn spec(seconds: f64) -> Value {
    json!({
        "object_a": "stock:torus-knot@8000", "query": "proximity", "passes": 5, "budget_seconds": seconds, "seed": 7,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 300 } },
        "algorithms": ["box-tree", "brute-force"],
    })
}

#[test]
fn two_hundred_visitors_see_no_error_while_a_run_is_measured() {
    let _alone = alone();
    let seconds = asked("OCB_LOAD_SECONDS", 6);
    let data = empty("load");
    let service = Service::start_with(&data, &["libocb_box_tree.so", "libocb_brute_force.so"]);
    let guest = Guest::default();
    let run = guest.submit(&service, &spec((seconds as f64 / 6.0).min(3.0)));
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    let seen = runtime.block_on(visit(&service, &run, Duration::from_secs(seconds)));
    guest.wait(&service, &run, "the run is done", |run| run["state"] == "done");
    let (answers, events) = (seen.answers.load(Ordering::Relaxed), seen.events.load(Ordering::Relaxed));
    let first = seen.slowest.load(Ordering::Relaxed);
    println!(
        "{VISITORS} visitors for {seconds} s: {answers} answers and {events} events without an error, each first event \
         within {first} ms"
    );
    assert!(answers >= VISITORS as u64 && events >= VISITORS as u64, "{answers} answers, {events} events");
}

#[test]
fn fifty_uploads_at_once_are_all_taken() {
    let _alone = alone();
    let data = empty("uploads");
    add_account(&data, "developer");
    let service = Service::start_with(&data, &["libocb_box_tree.so", "libocb_brute_force.so"]);
    let developer = Guest::member(&service, "developer");
    let (objects, plugins) = (format!("{}/objects", service.url()), format!("{}/plugins", service.url()));
    let upload = |number: usize| {
        let to = objects.clone();
        async move {
            let text = format!("v 0 0 0\nv {} 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", number + 1);
            // Half of them are as large as an object may well be.
            let comment = "# nothing\n".repeat(if number.is_multiple_of(2) { 10 } else { 1_000_000 });
            let file = Part::text(format!("{comment}{text}")).file_name("own.obj");
            let answer = client().post(to).multipart(Form::new().part("file", file)).send().await.expect("an answer");
            let status = answer.status();
            let told: Value = answer.json().await.expect("JSON");
            assert_eq!(status, StatusCode::CREATED, "{told}");
            assert_eq!(told["triangles"], 4, "{told}");
        }
    };
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    runtime.block_on(async { join_all((0..UPLOADS).map(upload)).await });
    // Plugins at once: as many as may wait for their check are taken, the others hear why not.
    let manifest = json!({
        "name": "n", "version": "1", "authors": "a", "license": "MIT", "queries": ["proximity"],
    });
    let told: Vec<u16> = std::thread::scope(|scope| {
        let sending: Vec<_> = (0..UPLOADS)
            .map(|number| {
                let bytes = format!("\x7fELF {number}").into_bytes();
                let (developer, service, manifest) = (&developer, &service, &manifest);
                scope.spawn(move || developer.send_plugin(service, manifest, bytes).expect("an answer").0)
            })
            .collect();
        sending.into_iter().map(|sent| sent.join().expect("no panic")).collect()
    });
    let count = |status: u16| told.iter().filter(|told| **told == status).count();
    println!("{UPLOADS} plugins at once to {plugins}: {} taken, {} told to wait", count(201), count(409) + count(429));
    assert_eq!(count(201) + count(409) + count(429), UPLOADS, "{told:?}");
    let kept = developer.get(&service, "/plugins");
    let kept = kept.as_array().expect("plugins");
    assert_eq!(kept.len(), count(201), "what was refused is not kept");
    let waiting = kept.iter().filter(|plugin| plugin["state"] == "uploaded" || plugin["state"] == "vetted").count();
    assert!(waiting <= 5, "{waiting} of one account wait for their check");
}
