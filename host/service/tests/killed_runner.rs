//! A runner that dies costs its algorithm the rest of its stage, and the other algorithms nothing.
//!
//! Alone in its binary: it kills whatever runner this process has.

mod common;

use std::time::{Duration, Instant};

use ocb_service::Engine;
use ocb_service::model::{OutcomeName, State};

#[tokio::test(flavor = "multi_thread")]
async fn a_killed_runner_gets_its_outcome_and_the_next_algorithm_is_measured() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let mut spec = common::spec("proximity", 3000, 6);
    (spec.algorithms, spec.passes) = (vec!["brute-force".into(), "box-tree".into()], 1);
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    // Not before it has answered: one that dies while its jail is being closed is no fault of its plugin.
    let answered = async || engine.run(&run.id, None).await.unwrap().stages[2].done > 0;
    let begun = Instant::now();
    while !answered().await {
        assert!(begun.elapsed() < Duration::from_secs(120), "it answers nothing");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    kill_the_runner_of_this_process();
    let (run, _) = common::finish(&engine, &run.id).await;
    let (killed, next) = (&run.results[0], &run.results[1]);
    assert_eq!(killed.outcome.name, OutcomeName::Signaled, "{}", killed.outcome.message);
    assert!(killed.n < killed.of, "what was measured before is kept: {} of {}", killed.n, killed.of);
    assert_eq!((next.outcome.name, next.n), (OutcomeName::Completed, next.of));
    assert_eq!((run.state, run.stages[2].state, run.stages[3].state), (State::Done, State::Failed, State::Done));
    engine.shutdown().await;
}

/// Kills the jailed process that this test process has now.
fn kill_the_runner_of_this_process() {
    use nix::sys::signal::{Signal, kill};
    use nix::unistd::Pid;
    // The deepest one holds the plugin; those above it keep the jail.
    let runner = descendants(std::process::id()).pop().expect("a runner");
    kill(Pid::from_raw(runner as i32), Signal::SIGKILL).expect("it was alive");
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
