//! The service is killed at every stage of a run and started again; a runner is killed while it is measured.

use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use ocb_tests::service::{Guest, Service, descendants, runner_below};
use serde_json::{Value, json};

/// One data folder for all of these tests, one after the other.
static DATA: LazyLock<Mutex<PathBuf>> = LazyLock::new(|| {
    let data = Path::new(env!("CARGO_TARGET_TMPDIR")).join("restart");
    if data.exists() {
        std::fs::remove_dir_all(&data).expect("the folder of the last time goes");
    }
    Mutex::new(data)
});

/// Those that are measured.
const PLUGINS: [&str; 3] = ["libocb_brute_force.so", "libocb_box_tree.so", "libocb_parry.so"];

fn spec(count: u32) -> Value {
    json!({
        "object_a": "stock:torus-knot@2000", "query": "proximity", "passes": 2, "budget_seconds": 0.5,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": count } },
        "algorithms": ["brute-force", "box-tree", "parry"],
    })
}

fn stage_state<'a>(run: &'a Value, kind: &str, algorithm: Option<&str>) -> &'a str {
    let stages = run["stages"].as_array().expect("stages");
    let stage = stages.iter().find(|s| s["kind"] == kind && algorithm.is_none_or(|a| s["algorithm"] == a));
    stage.unwrap_or_else(|| panic!("no stage {kind} {algorithm:?} in {run}"))["state"].as_str().expect("a state")
}

/// Every algorithm has its whole result, once, and nothing is wrong with it.
fn assert_complete(run: &Value) {
    assert_eq!(run["state"], "done", "{run}");
    let of = run["set"]["configurations"].as_u64().expect("configurations");
    let results = run["results"].as_array().expect("results");
    let names: Vec<_> = results.iter().map(|r| r["algorithm"].as_str().expect("name")).collect();
    assert_eq!(names, ["brute-force", "box-tree", "parry"]);
    for result in results {
        assert_eq!(result["outcome"]["name"], "Completed", "{result}");
        assert_eq!(result["wrong"], 0, "{result}");
        assert!(result["budget_limited"] == true || result["n"] == of, "{result}");
    }
}

/// Runs until `there` says that the moment has come, kills the service, starts it again and wants the run finished.
///
/// A stage may pass between two looks: then the next run gets its turn, at most twenty times.
fn finishes_after_a_kill(what: &str, count: u32, there: impl Fn(&Value) -> bool) {
    let data = DATA.lock().unwrap_or_else(PoisonError::into_inner);
    let guest = Guest::default();
    for _ in 0..20 {
        let service = Service::start_with(&data, &PLUGINS);
        let id = guest.submit(&service, &spec(count));
        let seen = guest.catch(&service, &id, what, |run| there(run) || run["state"] == "done");
        let runners = descendants(service.pid());
        service.kill();
        assert_gone(&runners);
        let service = Service::start_with(&data, &PLUGINS);
        let run =
            guest.wait(&service, &id, "the run to end", |r| !["queued", "running"].iter().any(|s| r["state"] == *s));
        assert_complete(&run);
        assert_eq!(
            guest.get(&service, "/runs").as_array().expect("runs").iter().filter(|r| r["id"] == id.as_str()).count(),
            1
        );
        if seen["state"] != "done" {
            assert_eq!(run["mine"], true, "the guest's cookie still owns the run");
            return;
        }
    }
    panic!("the service was never killed while {what}");
}

/// Runners die with the service: nothing goes on burning a CPU that the next measurement needs.
fn assert_gone(pids: &[u32]) {
    let end = Instant::now() + Duration::from_secs(10);
    while let Some(pid) = pids.iter().find(|p| Path::new(&format!("/proc/{p}")).exists()) {
        assert!(Instant::now() < end, "process {pid} outlives the killed service");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn killed_while_queued() {
    finishes_after_a_kill("the run is queued", 100, |_| true);
}

#[test]
fn killed_while_reading_the_object() {
    finishes_after_a_kill("the object is read", 100, |r| stage_state(r, "object", None) != "queued");
}

#[test]
fn killed_while_finding_configurations() {
    finishes_after_a_kill("configurations are found", 2000, |r| stage_state(r, "configurations", None) == "running");
}

#[test]
fn killed_while_measuring_the_first_algorithm() {
    finishes_after_a_kill("brute-force is measured", 100, |r| {
        stage_state(r, "measuring", Some("brute-force")) == "running"
    });
}

#[test]
fn killed_while_measuring_the_last_algorithm() {
    finishes_after_a_kill("parry is measured", 2000, |r| stage_state(r, "measuring", Some("parry")) == "running");
}

#[test]
fn killed_while_aggregating() {
    finishes_after_a_kill("the heatmap is made", 500, |r| {
        stage_state(r, "measuring", Some("parry")) == "done" && r["state"] == "running"
    });
}

#[test]
fn a_killed_runner_is_marked_and_the_next_algorithm_goes_on() {
    let data = DATA.lock().unwrap_or_else(PoisonError::into_inner);
    let (guest, service) = (Guest::default(), Service::start_with(&data, &PLUGINS));
    let id = guest.submit(&service, &spec(300));
    guest.wait(&service, &id, "brute-force is measured", |r| {
        stage_state(r, "measuring", Some("brute-force")) == "running"
    });
    let end = Instant::now() + Duration::from_secs(5);
    let runner = loop {
        // One that has been there for a while asks questions; killed while it is still being closed off it would be our fault.
        let seen = runner_below(service.pid());
        std::thread::sleep(Duration::from_millis(100));
        if let Some(pid) = seen.filter(|_| runner_below(service.pid()) == seen) {
            break pid;
        }
        assert!(Instant::now() < end, "no runner was seen");
    };
    let runner = Pid::from_raw(i32::try_from(runner).expect("a pid"));
    kill(runner, Signal::SIGKILL).expect("the runner was alive");

    let run = guest.wait(&service, &id, "the run to end", |r| !["queued", "running"].iter().any(|s| r["state"] == *s));
    assert_eq!(run["state"], "done", "{run}");
    let result = |name: &str| {
        run["results"].as_array().expect("results").iter().find(|r| r["algorithm"] == name).cloned().expect(name)
    };
    let killed = result("brute-force");
    assert_eq!(killed["outcome"]["name"], "Signaled", "{killed}");
    for other in ["box-tree", "parry"] {
        assert_eq!(result(other)["outcome"]["name"], "Completed", "{}", result(other));
    }
}
