//! What can go wrong while something is measured or checked.

/// One clear sentence: what is wrong, where, and how to mend it.
#[derive(Debug, thiserror::Error)]
pub enum LabError {
    /// What was given is bad.
    #[error("{0}")]
    Invalid(String),
    /// Not now: another process holds what is needed.
    #[error("{0}")]
    Busy(String),
    /// Whoever asked for it ended it; nothing is wrong.
    #[error("Stopped before its end; what was not finished was discarded.")]
    Stopped,
    /// A program of ours came to a bad end at its work; the sentence says nothing of this machine.
    #[error("{0}")]
    Ended(String),
    /// Ours or the machine's fault.
    #[error("{0}")]
    Fault(String),
}

impl LabError {
    /// A fault with the step at which it happened.
    pub fn fault(step: &str, cause: impl std::fmt::Display) -> Self {
        Self::Fault(format!("{step}: {cause}."))
    }
}

/// Shorthand of this crate.
pub type Result<T, E = LabError> = std::result::Result<T, E>;
