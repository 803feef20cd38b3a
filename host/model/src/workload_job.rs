//! Recordings that visitors bring, and how far their replay is.

use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::State;
use crate::reduction::ReduceTerms;
use crate::workload::{PairTime, Track, WorkloadResult};

/// How a recording is replayed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WorkloadSpec {
    /// Names of algorithms, with settings; empty: the usual ones. `all` stands for every algorithm.
    pub algorithms: Vec<String>,
    /// The orders in which the queries are put.
    pub tracks: Vec<Track>,
    /// Processes per algorithm, order and pair of objects.
    pub passes: u32,
    /// Measuring time per algorithm and order, in seconds.
    pub budget_seconds: f64,
    /// Seed of the orders and of the equivalent instances; drawn when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Also look for the simplest scene that keeps the answers on these terms, and measure what it saves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reduce: Option<ReduceTerms>,
}

impl Default for WorkloadSpec {
    fn default() -> Self {
        let tracks = vec![Track::Shuffled, Track::Recorded, Track::Scene];
        Self { algorithms: Vec::new(), tracks, passes: 3, budget_seconds: 10.0, seed: None, reduce: None }
    }
}

impl WorkloadSpec {
    /// How often each algorithm measures: a reduced scene is compared with its objects, in the first order.
    pub fn turns(&self) -> usize {
        self.tracks.len() + self.reduce.map_or(0, |terms| terms.replays() + 1)
    }

    /// # Errors
    /// What is wrong with it, in one sentence.
    pub fn check(&self) -> Result<(), String> {
        let Self { tracks, passes, budget_seconds, .. } = self;
        if !(1..=64).contains(passes) {
            return Err(format!("The number of processes must be 1 to 64, not {passes}."));
        }
        // Written so that NaN fails.
        if !(*budget_seconds > 0.0 && *budget_seconds <= 86_400.0) {
            return Err(format!("The budget must be above 0 and at most 86400 s, not {budget_seconds}."));
        }
        self.reduce.map_or(Ok(()), |terms| terms.check())?;
        let twice = (1..tracks.len()).any(|i| tracks[..i].contains(&tracks[i]));
        if tracks.is_empty() || twice {
            return Err("The orders must be some of \"shuffled\", \"recorded\" and \"scene\", each once.".to_owned());
        }
        Ok(())
    }
}

/// A recording that is replayed, and how far that is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorkloadInfo {
    /// Id; only the owner may look.
    pub id: String,
    /// What was asked.
    pub spec: WorkloadSpec,
    /// The recording.
    pub recording: RecordingInfo,
    /// State.
    pub state: State,
    /// Queries whose pair of objects is done.
    pub done: u64,
    /// All queries.
    pub total: u64,
    /// Replays under way, or carried out before this one if nothing else is requested; 0 when it does not wait.
    pub runs_ahead: u32,
    /// Why it failed or was cancelled, or what it does behind the replay, one sentence.
    pub message: Option<String>,
    /// When it was asked for.
    pub created_us: i64,
    /// When it ended.
    pub finished_us: Option<i64>,
    /// What was found; absent in lists and before the end.
    pub result: Option<WorkloadResult>,
}

/// What a recording says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RecordingInfo {
    /// The name of its file.
    pub file: String,
    /// SHA-256 (hex) of the file.
    pub sha256: String,
    /// Its bytes.
    pub bytes: u64,
    /// The recorded program.
    pub program: String,
    /// Its libraries, with their versions.
    pub libraries: Vec<String>,
    /// Objects of the scene.
    pub objects: u64,
    /// Queries in it.
    pub queries: u64,
    /// Queries that the recorder saw.
    pub seen: u64,
}

/// The recording in its own order, cut between groups into parts of about equally many queries.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Timeline {
    /// Number of the first query of each part.
    pub from: Vec<u64>,
    /// Replayed queries in each part.
    pub queries: Vec<u64>,
    /// Of these, certainly colliding.
    pub hits: Vec<u64>,
    /// Each algorithm in each order.
    pub series: Vec<TimelineSeries>,
}

/// One algorithm along the recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TimelineSeries {
    /// Algorithm id.
    pub algorithm: String,
    /// The order in which it was asked.
    pub track: Track,
    /// Queries asked in each part.
    pub n: Vec<u64>,
    /// Their time together, nanoseconds.
    pub ns: Vec<f64>,
    /// Wrong answers among them.
    pub wrong: Vec<u64>,
}

/// A stretch of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct Stretch {
    /// Number of its first query; the first of the recording when absent.
    pub from: Option<u64>,
    /// Number of the query behind its last one; the end of the recording when absent.
    pub to: Option<u64>,
}

impl Stretch {
    /// Does it hold the query of this number?
    pub fn contains(self, sequence: u64) -> bool {
        sequence >= self.from.unwrap_or(0) && self.to.is_none_or(|to| sequence < to)
    }
}

/// What each algorithm does within a stretch of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StretchResult {
    /// One entry per algorithm and order.
    pub algorithms: Vec<AlgorithmOnStretch>,
}

/// One algorithm within a stretch of a recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AlgorithmOnStretch {
    /// Algorithm id.
    pub algorithm: String,
    /// The order in which it was asked.
    pub track: Track,
    /// Queries asked.
    pub n: u64,
    /// Their time together, nanoseconds.
    pub ns: f64,
    /// Wrong answers.
    pub wrong: u64,
    /// Collisions that it missed; part of `wrong`.
    pub missed: u64,
    /// Each pair of objects, the most expensive first.
    pub pairs: Vec<PairTime>,
}

/// A group of a recording as it stands in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PosedGroup {
    /// The group.
    pub group: u64,
    /// Number of its first query.
    pub from: u64,
    /// Number of its last query, plus one.
    pub to: u64,
    /// Its queries.
    pub queries: u64,
    /// Its objects.
    pub objects: Vec<PosedObject>,
}

/// An object in its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PosedObject {
    /// Its place in the scene.
    pub object: u32,
    /// Its pose in the world, a 4x4 matrix, row-major, in the unit of the scene.
    pub pose: [f64; 16],
}

/// A group of a recording, by one of its queries or its own number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct WhichGroup {
    /// Number of one of its queries.
    pub sequence: Option<u64>,
    /// Its number; not asked for when a query is given.
    pub group: Option<u64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_replayed_so_is_said() {
        let told = |change: fn(&mut WorkloadSpec)| {
            let mut spec = WorkloadSpec::default();
            change(&mut spec);
            spec.check().err().unwrap_or_default()
        };
        assert_eq!(told(|_| {}), "");
        assert!(told(|spec| spec.passes = 0).contains("1 to 64, not 0"));
        assert!(told(|spec| spec.budget_seconds = f64::NAN).contains("at most 86400 s, not NaN"));
        assert!(told(|spec| spec.tracks.clear()).contains("each once"));
        assert!(told(|spec| spec.tracks[0] = Track::Recorded).contains("each once"));
        let terms = |tolerance, near| Some(ReduceTerms { tolerance, near, outside_only: false, frontier: false });
        let reduce = |reduce| WorkloadSpec { reduce, ..WorkloadSpec::default() }.check().err().unwrap_or_default();
        assert_eq!(reduce(terms(0.1, 0.04)), "");
        assert!(reduce(terms(f64::NAN, 0.0)).contains("a positive length"));
        assert!(reduce(terms(0.1, 0.05)).contains("less than half"));
        assert_eq!(told(|spec| spec.tracks = vec![Track::Scene]), "");
    }
}
