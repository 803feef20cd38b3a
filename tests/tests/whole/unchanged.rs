//! Visitors change nothing in what is measured. The same run is measured again and again: twice without visitors and once with
//! two hundred of them, in turns. The two kinds without visitors show how far medians differ on this machine by themselves.
//!
//! The service holds the machine's measuring lock during each run, so no other measurement falls into one.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::unistd::Pid;
use ocb_tests::service::{Guest, Service};
use serde_json::{Value, json};
use tokio::runtime::{Builder, Runtime};

use crate::load::{Seen, VISITORS, browse, follow};
use crate::{alone, asked, empty};

/// Medians that differ by more than this share are a change.
const CHANGE: f64 = 0.2;
/// How often the page of a run is looked at by the test itself, which is a visitor as well.
const LOOK: Duration = Duration::from_millis(400);

/// The same questions every time.
fn spec() -> Value {
    json!({
        "object_a": "stock:torus-knot@8000", "query": "proximity", "passes": 5, "budget_seconds": 5.0, "seed": 7,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 300 } }, "algorithms": ["box-tree"],
    })
}

#[test]
fn visitors_change_nothing_in_what_is_measured() {
    let _alone = alone();
    let rounds = asked("OCB_LOAD_ROUNDS", 4) as usize;
    assert!(cpus().len() > 1, "not run: a measurement beside visitors needs two CPUs");
    let service = Service::start_with(&empty("unchanged"), &["libocb_box_tree.so"]);
    // The visitors' own work stays off the CPU that is measured on, as it does when they are elsewhere; so does what this
    // thread starts from now on.
    stay_on_the_first_cpu();
    let guest = Guest::default();
    let visitors =
        Builder::new_multi_thread().worker_threads(2).on_thread_start(stay_on_the_first_cpu).enable_all().build();
    let visitors = visitors.expect("a runtime");
    // The first one finds the configurations, which the others use again.
    let first = guest.submit(&service, &spec());
    ended(&guest, &service, &first);
    // Two kinds without visitors, and one with.
    let mut times: [Vec<f64>; 3] = Default::default();
    for round in 0..rounds {
        // Each kind is the first of a round as often as the others.
        for kind in (0..3).map(|place| (place + round) % 3) {
            times[kind].push(if kind == 2 {
                among_visitors(&guest, &service, &visitors, &first)
            } else {
                let run = guest.submit(&service, &spec());
                ended(&guest, &service, &run)
            });
        }
    }
    println!("medians without visitors, without visitors, with {VISITORS}, ns: {times:.0?}");
    match judge(&times) {
        Verdict::Unchanged => {}
        Verdict::Changed => panic!("visitors change what is measured: {times:.0?}"),
        Verdict::TooBusy => panic!("not run: the machine is too busy to show it"),
    }
}

/// The median time of a run during which two hundred visitors look at pages and follow its events.
fn among_visitors(guest: &Guest, service: &Service, visitors: &Runtime, earlier: &str) -> f64 {
    let (seen, far) = (Arc::<Seen>::default(), Instant::now() + Duration::from_secs(600));
    let half = VISITORS / 2;
    let mut here: Vec<_> = (0..half)
        .map(|visitor| browse(service.pages().to_owned(), earlier.to_owned(), 2 * visitor, far, seen.clone()))
        .map(|visit| visitors.spawn(visit))
        .collect();
    let answers = || seen.answers.load(Ordering::Relaxed);
    while answers() < half as u64 {
        assert!(here.iter().all(|visit| !visit.is_finished()), "a visitor saw an error");
        std::thread::sleep(Duration::from_millis(20));
    }
    let (run, before) = (guest.submit(service, &spec()), answers());
    let followers = (0..half).map(|_| follow(service.pages().to_owned(), run.clone(), far, seen.clone()));
    here.extend(followers.map(|visit| visitors.spawn(visit)));
    let time = ended(guest, service, &run);
    here.iter().for_each(|visit| visit.abort());
    assert!(answers() > before, "nobody looked at a page during the run");
    time
}

/// Waits for the end of a run; the median of its times, nanoseconds.
fn ended(guest: &Guest, service: &Service, run: &str) -> f64 {
    let end = Instant::now() + Duration::from_secs(180);
    loop {
        std::thread::sleep(LOOK);
        let now = guest.get(service, &format!("/runs/{run}"));
        if now["state"] == "done" {
            let time = &now["results"][0]["time"]["median_ns"]["value"];
            return time.as_f64().unwrap_or_else(|| panic!("no median in {now}"));
        }
        assert!(now["state"] == "queued" || now["state"] == "running", "{now}");
        assert!(Instant::now() < end, "the run does not end: {now}");
    }
}

fn cpus() -> Vec<usize> {
    let own = sched_getaffinity(Pid::from_raw(0)).expect("the own CPUs");
    (0..CpuSet::count()).filter(|cpu| own.is_set(*cpu).unwrap_or(false)).collect()
}

/// The service measures on another one, and keeps its own threads off that.
fn stay_on_the_first_cpu() {
    let mut first = CpuSet::new();
    first.set(cpus()[0]).expect("a CPU");
    sched_setaffinity(Pid::from_raw(0), &first).expect("fewer CPUs can be had");
}

#[derive(Debug, PartialEq)]
enum Verdict {
    Unchanged,
    Changed,
    TooBusy,
}

/// Compares medians over the runs of each kind: two without visitors, then those with.
fn judge([one, other, visited]: &[Vec<f64>; 3]) -> Verdict {
    let apart = |x: f64, y: f64| x.max(y) / x.min(y) - 1.0;
    let alike = apart(median(one), median(other));
    let change = apart(median(visited), median(&[&one[..], other].concat()));
    // What is the same differs by half of what counts: then nothing can be told, except what is far more.
    match (change > CHANGE.max(4.0 * alike), alike > CHANGE / 2.0) {
        (true, _) => Verdict::Changed,
        (false, true) => Verdict::TooBusy,
        (false, false) if change > CHANGE => Verdict::TooBusy,
        (false, false) => Verdict::Unchanged,
    }
}

/// The middle one, or the mean of the two middle ones.
fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    f64::midpoint(times[(times.len() - 1) / 2], times[times.len() / 2])
}

#[test]
fn a_change_is_told_from_a_busy_machine() {
    let judged = |one: [f64; 3], other: [f64; 3], visited: [f64; 3]| judge(&[one, other, visited].map(Vec::from));
    let (quiet, alike) = ([100.0, 101.0, 180.0], [99.0, 102.0, 98.0]);
    assert_eq!(judged(quiet, alike, [103.0, 60.0, 110.0]), Verdict::Unchanged);
    assert_eq!(judged(quiet, alike, [130.0, 125.0, 128.0]), Verdict::Changed);
    assert_eq!(judged(quiet, alike, [70.0, 75.0, 72.0]), Verdict::Changed);
    let busy = [120.0, 119.0, 125.0];
    assert_eq!(judged(quiet, busy, [105.0, 110.0, 108.0]), Verdict::TooBusy);
    assert_eq!(judged(quiet, busy, [140.0, 141.0, 139.0]), Verdict::TooBusy);
    assert_eq!(judged(quiet, busy, [900.0, 800.0, 850.0]), Verdict::Changed);
}
