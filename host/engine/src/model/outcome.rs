//! How the measuring of one algorithm ended.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::AlgorithmResult;

const COMPLETED: &str = "Completed";
const OUT_OF_BUDGET: &str = "OutOfBudget";
const NOT_MEASURED: &str = "NotMeasured";

/// How a runner ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct OutcomeInfo {
    /// Name of the outcome as in the glossary, e.g. `Completed`, `OutOfBudget`, `TimedOut`, `SandboxFault`.
    pub name: String,
    /// One sentence.
    pub message: String,
    /// Our fault, never the plugin's.
    pub ours: bool,
}

impl OutcomeInfo {
    /// Nothing went wrong, and `n` configurations have a time. Without any, nothing was completed.
    pub fn without_failure(n: usize, budget_limited: bool) -> Self {
        let (name, message) = match (n, budget_limited) {
            (0, true) => (OUT_OF_BUDGET, "The time budget ended before the first question was answered; give it more."),
            (0, false) => (NOT_MEASURED, "Nothing was measured: no answer has a time."),
            _ => (COMPLETED, "The plugin answered everything it was asked."),
        };
        Self { name: name.into(), message: message.into(), ours: false }
    }

    /// All that was asked was answered.
    pub fn completed(&self) -> bool {
        self.name == COMPLETED
    }
}

impl AlgorithmResult {
    /// The time budget ended before its first answer: nothing is known of it.
    pub fn had_no_time(&self) -> bool {
        self.outcome.name == OUT_OF_BUDGET
    }

    /// As this version names its outcome: older ones called a result without any answer completed.
    pub fn renamed(mut self) -> Self {
        if self.n == 0 && self.outcome.completed() {
            self.outcome = OutcomeInfo::without_failure(0, self.budget_limited);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(n: u32, budget_limited: bool, name: &str) {
        let result = serde_json::json!({
            "algorithm": "x", "name": "X", "outcome": { "name": "Completed", "message": "m", "ours": false }, "n": n, "of": 9,
            "budget_limited": budget_limited, "time": null, "verdicts": [], "wrong": 0, "bv_tests_mean": null,
            "primitive_tests_mean": null, "build_ms": null, "memory_bytes": null,
        });
        let result: AlgorithmResult = serde_json::from_value(result).unwrap();
        assert_eq!(OutcomeInfo::without_failure(n as usize, budget_limited).name, name);
        assert_eq!(result.renamed().outcome.name, name);
    }

    #[test]
    fn nothing_is_completed_without_an_answer() {
        check(9, false, "Completed");
        check(1, true, "Completed");
        check(0, true, "OutOfBudget");
        check(0, false, "NotMeasured");
    }
}
