//! How the measuring of one algorithm ended.

use std::fmt;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::AlgorithmResult;

/// The outcomes of the glossary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub enum OutcomeName {
    /// All that was asked was answered.
    Completed,
    /// The time budget ended before the first answer.
    OutOfBudget,
    /// No answer has a time.
    NotMeasured,
    /// The plugin said that it cannot go on, or ended its process.
    Failed,
    /// The file could not be loaded as a plugin.
    LoadError,
    /// The file is not the one that was meant.
    FileReplaced,
    /// A signal ended it.
    Signaled,
    /// It took longer than allowed.
    TimedOut,
    /// It used more memory than allowed.
    OutOfMemory,
    /// It wrote more than allowed.
    OutputLimit,
    /// It made a forbidden system call.
    SyscallDenied,
    /// What its process said breaks the rules.
    ProtocolViolation,
    /// Its times do not fit together.
    TimingIntegrity,
    /// It was stopped on request.
    Cancelled,
    /// Our fault or the machine's.
    SandboxFault,
}

impl fmt::Display for OutcomeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// How a runner ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct OutcomeInfo {
    /// Which outcome.
    pub name: OutcomeName,
    /// Number of the signal that ended it; absent otherwise, and in runs of older versions.
    #[serde(default)]
    pub signal: Option<i32>,
    /// One sentence, for people: nothing is decided by it.
    pub message: String,
    /// Our fault, never the plugin's.
    pub ours: bool,
}

impl OutcomeInfo {
    /// Nothing went wrong, and `n` configurations have a time. Without any, nothing was completed.
    pub fn without_failure(n: usize, budget_limited: bool) -> Self {
        let (name, message) = match (n, budget_limited) {
            (0, true) => {
                (OutcomeName::OutOfBudget, "The time budget ended before the first answer; increase the budget.")
            }
            (0, false) => (OutcomeName::NotMeasured, "Nothing was measured: no answer has a time."),
            _ => (OutcomeName::Completed, "The plugin answered every query."),
        };
        Self { name, signal: None, message: message.into(), ours: false }
    }

    /// All that was asked was answered.
    pub fn completed(&self) -> bool {
        self.name == OutcomeName::Completed
    }
}

impl AlgorithmResult {
    /// The time budget ended before its first answer: nothing is known of it.
    pub fn had_no_time(&self) -> bool {
        self.outcome.name == OutcomeName::OutOfBudget
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

    fn check(n: u32, budget_limited: bool, name: OutcomeName) {
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
        check(9, false, OutcomeName::Completed);
        check(1, true, OutcomeName::Completed);
        check(0, true, OutcomeName::OutOfBudget);
        check(0, false, OutcomeName::NotMeasured);
    }
}
