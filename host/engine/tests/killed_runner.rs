//! A runner that dies costs its algorithm the rest of its lane, and nobody else anything.
//!
//! Alone in its binary: it kills whatever runner this process has.

mod common;

use ocb_engine::Engine;
use ocb_engine::model::State;

#[tokio::test(flavor = "multi_thread")]
async fn a_killed_runner_gets_its_outcome_and_the_next_algorithm_is_measured() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let mut spec = common::spec("proximity", 3000, 6);
    (spec.algorithms, spec.passes) = (vec!["brute-force".into(), "box-tree".into()], 1);
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    let killer = std::thread::spawn(kill_the_runner_of_this_process);
    let (run, _) = common::finish(&engine, &run.id).await;
    assert!(killer.join().unwrap(), "a runner was seen");
    let (killed, next) = (&run.results[0], &run.results[1]);
    assert_eq!(killed.outcome.name, "Signaled", "{}", killed.outcome.message);
    assert!(killed.n < killed.of, "what was measured before is kept: {} of {}", killed.n, killed.of);
    assert_eq!((next.outcome.name.as_str(), next.n), ("Completed", next.of));
    assert_eq!((run.state, run.stages[2].state, run.stages[3].state), (State::Done, State::Failed, State::Done));
    engine.shutdown().await;
}

/// Kills the first jailed process that this test process has, wherever it hangs in the tree below.
fn kill_the_runner_of_this_process() -> bool {
    use nix::sys::signal::{Signal, kill};
    use nix::unistd::Pid;
    let started = std::time::Instant::now();
    while started.elapsed().as_secs() < 60 {
        if !descendants(std::process::id()).is_empty() {
            // Long enough for the jail to be complete, and for some answers.
            std::thread::sleep(std::time::Duration::from_millis(700));
            // The deepest one holds the plugin; those above it keep the jail.
            if let Some(runner) = descendants(std::process::id()).pop()
                && kill(Pid::from_raw(runner as i32), Signal::SIGKILL).is_ok()
            {
                return true;
            }
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    false
}

fn descendants(pid: u32) -> Vec<u32> {
    let mut all = Vec::new();
    for task in std::fs::read_dir(format!("/proc/{pid}/task")).into_iter().flatten().flatten() {
        let children = std::fs::read_to_string(task.path().join("children")).unwrap_or_default();
        for child in children.split_whitespace().filter_map(|c| c.parse().ok()) {
            all.push(child);
            all.extend(descendants(child));
        }
    }
    all
}
