//! Work of measuring machines other than runs.

use serde::{Deserialize, Serialize};

use crate::{Asked, Manifest, OrderedAlgorithm, RecordingInfo, Stability, StabilitySpec, WorkloadSpec};

/// Work for a machine other than a run: everything that determines it. Files are fetched by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errand {
    /// Id of the attempt; it opens the files of this errand alone.
    pub attempt: String,
    /// Id of the plugin, the stability run, the workload or the advice.
    pub job: String,
    /// What is wanted.
    pub wanted: Wanted,
    /// It is stopped after so many seconds of work.
    pub most_seconds: Option<f64>,
}

/// What a machine is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "wanted", rename_all = "snake_case")]
pub enum Wanted {
    /// The check of a submitted plugin.
    Check {
        /// SHA-256 of its file.
        plugin_sha256: String,
        /// What its author says of it.
        manifest: Box<Manifest>,
        /// Only the short part of the questions.
        quick: bool,
        /// Time of the whole check.
        limit_seconds: f64,
    },
    /// A part of a stability run.
    Stability {
        /// The algorithm.
        algorithm: Box<OrderedAlgorithm>,
        /// What was asked.
        spec: StabilitySpec,
        /// The part.
        part: String,
        /// What the parts before have found.
        found: Box<Stability>,
    },
    /// The replay of a recording.
    Replay {
        /// The recording.
        recording: Box<RecordingInfo>,
        /// How it is replayed; its seed is there.
        spec: Box<WorkloadSpec>,
        /// The algorithms.
        algorithms: Vec<OrderedAlgorithm>,
    },
    /// Advice about levels of detail.
    Advise {
        /// What is asked.
        question: Asked,
        /// Names of the objects.
        names: [String; 2],
        /// SHA-256 of their meshes; the same twice for one object.
        meshes: [String; 2],
        /// Configurations to choose by, and others to check by.
        counts: [u32; 2],
    },
}

impl Wanted {
    /// In words, for the log of the machine.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Check { .. } => "the check of the plugin",
            Self::Stability { .. } => "a part of the stability run",
            Self::Replay { .. } => "the replay of the recording",
            Self::Advise { .. } => "the advice",
        }
    }

    /// SHA-256 of the plugin files that it needs.
    pub fn plugins(&self) -> Vec<&str> {
        match self {
            Self::Check { plugin_sha256, .. } => vec![plugin_sha256],
            Self::Stability { algorithm, .. } => vec![&algorithm.info.plugin_sha256],
            Self::Replay { algorithms, .. } => algorithms.iter().map(|it| it.info.plugin_sha256.as_str()).collect(),
            Self::Advise { .. } => Vec::new(),
        }
    }
}
