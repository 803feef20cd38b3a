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
    /// Too much at once for one person or one address; the same works later (429).
    #[error("{message}")]
    TooMuch {
        /// The limit, and how to proceed.
        message: String,
        /// Seconds until a retry is useful.
        retry_seconds: u32,
    },
    /// Not now: somebody else holds what is needed (409).
    #[error("{0}")]
    Busy(String),
    /// A program of ours came to a bad end at its work; the sentence says nothing of this machine (500).
    #[error("{0}")]
    Ended(String),
    /// Ours or the machine's fault, never the caller's (500).
    #[error("{0}")]
    Fault(String),
}

impl EngineError {
    /// Hides the cause of a fault from visitors: it goes to the log under a number, because it may name files and addresses of this
    /// machine.
    pub(crate) fn for_visitors(self) -> Self {
        let Self::Fault(cause) = self else { return self };
        let number = uuid::Uuid::new_v4().simple().to_string();
        tracing::error!(number, %cause, "background work failed");
        Self::Fault(format!("Internal error; the cause is in the service's log under {number}."))
    }

    /// What this program was compiled without.
    pub fn left_out(what: &str) -> Self {
        Self::Invalid(format!("This ocb was built without {what}, as by `make serve`; `make build` includes it."))
    }

    /// A fault with the step at which it happened.
    pub(crate) fn fault(step: &str, cause: impl std::fmt::Display) -> Self {
        Self::Fault(format!("{step}: {cause}."))
    }
}

impl From<ocb_lab::LabError> for EngineError {
    fn from(e: ocb_lab::LabError) -> Self {
        match e {
            ocb_lab::LabError::Invalid(sentence) => Self::Invalid(sentence),
            ocb_lab::LabError::Busy(sentence) => Self::Busy(sentence),
            ocb_lab::LabError::Stopped => Self::Busy(e.to_string()),
            ocb_lab::LabError::Ended(sentence) => Self::Ended(sentence),
            ocb_lab::LabError::Fault(sentence) => Self::Fault(sentence),
        }
    }
}

impl From<ocb_model::BadPage> for EngineError {
    fn from(ocb_model::BadPage(sentence): ocb_model::BadPage) -> Self {
        Self::Invalid(sentence)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visitors_see_no_causes_of_faults() {
        let told = EngineError::Fault("disk /srv/secret is full".into()).for_visitors().to_string();
        assert!(told.contains("Internal error") && !told.contains("secret"), "{told}");
        assert_eq!(
            EngineError::Invalid("The step must be finite.".into()).for_visitors().to_string(),
            "The step must be finite."
        );
    }
}
