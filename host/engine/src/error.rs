//! What can go wrong, by whose hand it is mended.

/// One clear sentence: what is wrong, where, and how to mend it.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// There is no such thing (404).
    #[error("{0}")]
    NotFound(String),
    /// The caller's input is bad; nothing was stored (422, exit code 2).
    #[error("{0}")]
    Invalid(String),
    /// Only the owner may do this (403).
    #[error("{0}")]
    Forbidden(String),
    /// Not now: somebody else holds what is needed (409).
    #[error("{0}")]
    Busy(String),
    /// Ours or the machine's fault, never the caller's (500).
    #[error("{0}")]
    Fault(String),
}

impl EngineError {
    /// A fault with the step at which it happened.
    pub(crate) fn fault(step: &str, cause: impl std::fmt::Display) -> Self {
        Self::Fault(format!("{step}: {cause}."))
    }
}

impl From<sqlx::Error> for EngineError {
    fn from(e: sqlx::Error) -> Self {
        Self::fault("The database refused", e)
    }
}

impl From<object_store::Error> for EngineError {
    fn from(e: object_store::Error) -> Self {
        Self::fault("The blob storage refused", e)
    }
}

/// Shorthand of this crate.
pub type Result<T> = std::result::Result<T, EngineError>;
