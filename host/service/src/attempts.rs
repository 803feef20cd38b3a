//! Attempts: which worker has a job, and for how long.
//!
//! A job is a run, the next part of a stability run, the replay of a recording, the check of a plugin, or advice. It has at most one current attempt. The worker
//! renews the lease of its attempt while it lives. The lease is counted by the database's clock, so the clocks of machines may differ
//! or jump. An attempt ends once: its result is accepted; it is put back because its service stops or other work comes first; it is
//! lost with its worker; or it is withdrawn because the job was ended at another service. Only the current attempt can write, so a
//! worker that was given up and continues changes nothing.

pub mod beat;
pub mod lost;
pub mod sql;
pub mod turns;
pub mod worker;

use std::time::Duration;

use crate::EngineError;

/// The lease: a worker that is silent for so long is believed lost.
pub const LEASE_US: i64 = 20_000_000;
/// A job that so many attempts lost is not tried again: it may be what ends the service.
pub const MOST_LOST: i64 = 3;

/// After a fault of the database a worker waits so long.
pub const BACK_OFF: Duration = Duration::from_secs(2);

/// What is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A run up to its configurations, for a measuring machine.
    Prepare,
    /// A run, from its objects to its results; on a measuring machine, a prepared one.
    Measure,
    /// The check of a submitted plugin.
    Check,
    /// The next part of a stability run.
    Stability,
    /// The replay of a recording.
    Replay,
    /// Advice about levels of detail.
    Advise,
}

/// How an attempt ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Its result counts, whatever that says.
    Accepted,
    /// It was stopped for other reasons than its own, and the job waits again.
    PutBack,
    /// Its worker is gone.
    Lost,
    /// Its job was ended at another service.
    Withdrawn,
}

/// One attempt at a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attempt {
    /// UUIDv7.
    pub id: String,
    pub kind: Kind,
    /// Id of the run, stability run, workload, plugin or advice.
    pub job: String,
    /// Counts the attempts at this job from one.
    pub number: i64,
}

impl Kind {
    const ALL: [Self; 6] = [Self::Prepare, Self::Measure, Self::Check, Self::Stability, Self::Replay, Self::Advise];

    /// As it is stored.
    pub fn name(self) -> &'static str {
        match self {
            Self::Prepare => "prepare",
            Self::Measure => "measure",
            Self::Check => "check",
            Self::Stability => "stability",
            Self::Replay => "replay",
            Self::Advise => "advise",
        }
    }

    fn named(name: &str) -> crate::Result<Self> {
        let unknown = || EngineError::Fault(format!("The database holds an attempt of the unknown kind {name:?}."));
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(unknown)
    }
}

impl Outcome {
    /// As it is stored.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::PutBack => "put back",
            Self::Lost => "lost",
            Self::Withdrawn => "withdrawn",
        }
    }
}

/// The worker goes on although another has the job now; nothing that it says is kept.
pub fn superseded() -> EngineError {
    EngineError::Busy("This attempt was given up, because its worker was silent for too long.".into())
}
