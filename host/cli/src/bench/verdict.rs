//! What a run's results mean for the exit code.

use ocb_service::model::{AlgorithmResult, RunInfo, State};

use crate::failure::{NOT_ALL_WELL, OUR_FAULT};

/// Our faults first: a script must not take them for a bad algorithm.
pub fn exit_code(run: &RunInfo) -> u8 {
    let right = |result: &AlgorithmResult| result.wrong == 0 && !result.guessed();
    let well = |result: &AlgorithmResult| result.outcome.completed() && right(result);
    if run.results.iter().any(|result| result.outcome.ours) {
        OUR_FAULT
    } else if run.state == State::Done && run.results.iter().all(well) {
        0
    } else {
        NOT_ALL_WELL
    }
}

#[cfg(test)]
mod tests {
    use ocb_service::model::Controls;

    use super::*;
    use serde_json::json;

    fn run(state: &str, outcome: &str, ours: bool, wrong: u32) -> RunInfo {
        serde_json::from_value(json!({
            "id": "r", "object_a_name": "a", "object_b_name": "a", "state": state, "message": null, "runs_ahead": 0,
            "spec": { "object_a": "a", "query": "proximity", "method": { "kind": "file", "sha256": "0" } },
            "stages": [], "set": null, "environment": null, "attempts": 1, "mine": true, "created_us": 0,
            "finished_us": null,
            "results": [{
                "algorithm": "x", "name": "X", "outcome": { "name": outcome, "message": "m", "ours": ours }, "n": 9, "of": 9,
                "budget_limited": false, "time": null, "verdicts": [], "wrong": wrong, "bv_tests_mean": null,
                "primitive_tests_mean": null, "build_ms": null, "memory_bytes": null,
            }],
        }))
        .expect("a run")
    }

    #[test]
    fn each_ending_has_its_code() {
        assert_eq!(exit_code(&run("done", "Completed", false, 0)), 0);
        assert_eq!(exit_code(&run("done", "Completed", false, 1)), NOT_ALL_WELL);
        let mut guessing = run("done", "Completed", false, 0);
        guessing.results[0].controls = Some(Controls { n: 24, of: 24, crossing: 12, wrong: 1, silent: 0, guess: 1e-3 });
        assert_eq!(exit_code(&guessing), NOT_ALL_WELL);
        assert_eq!(exit_code(&run("done", "TimedOut", false, 0)), NOT_ALL_WELL);
        assert_eq!(exit_code(&run("done", "OutOfBudget", false, 0)), NOT_ALL_WELL);
        assert_eq!(exit_code(&run("failed", "Completed", false, 0)), NOT_ALL_WELL);
        assert_eq!(exit_code(&run("done", "SandboxFault", true, 0)), OUR_FAULT);
    }
}
