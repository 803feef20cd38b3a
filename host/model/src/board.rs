//! Who is how fast and how right, over many runs.

use ocb_chart::Chart;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use super::{BoardSuite, BuildInfo, Estimated};

/// What to compare; the query string of the board. What is left out is chosen: the value with the most algorithms.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct BoardRequest {
    /// Version of the suite whose results are compared, or `none` for the runs of people. The newest suite that was measured
    /// when left out.
    pub suite: Option<String>,
    /// The question: `collision_first`, `collision_all` or `proximity`, with `+solid` behind it for solid bodies.
    pub question: Option<String>,
    /// Contract class, e.g. `first_contact-shuffled-1-f64`.
    pub class: Option<String>,
    /// Hardware class.
    pub hardware: Option<String>,
    /// Pair of objects, e.g. `bunny@3674~bunny@3674`; `all` takes every one, as is done for a suite when left out.
    pub scene: Option<String>,
    /// How far apart: a relative distance such as `0.1`, `step:0.0001`, `ladder`, `grid:0`, ...; `all` takes every one, as is done
    /// for a suite when left out.
    pub distance: Option<String>,
    /// What is needed: `any`, `none_seen` (no wrong answer), or the largest eps* that will do, e.g. `1e-6`.
    pub precision: Option<String>,
    /// What to chart speed against.
    #[serde(default)]
    #[param(inline)]
    pub accuracy: Accuracy,
}

/// A measure of accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Accuracy {
    /// Share of wrong answers of any kind.
    #[default]
    Wrong,
    /// Share of missed collisions.
    Missed,
    /// Share of false alarms.
    FalseAlarms,
    /// Decimal digits of the scene's size that are told apart, -log10 of eps*.
    Digits,
    /// Worst error of a distance, in roundings `u S`.
    Distance,
}

/// Results of many runs that may be compared with one another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Board {
    /// The filters in the order in which they are applied.
    pub filters: Vec<BoardFilter>,
    /// Results before any filter.
    pub results: u32,
    /// The suite whose results these are; absent for the runs of people.
    pub suite: Option<BoardSuite>,
    /// One per algorithm with its settings: places first, then what has none.
    pub rows: Vec<BoardRow>,
    /// What is to be seen, in one sentence.
    pub finding: String,
    /// Speed against accuracy.
    pub chart: Chart,
}

/// A filter, and what it left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BoardFilter {
    /// Its name in requests.
    pub name: String,
    /// The value in force.
    pub chosen: String,
    /// What could be chosen, as far as the filters before it allow.
    pub options: Vec<BoardOption>,
    /// How many results it took away.
    pub removed: u32,
}

/// A value of a filter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BoardOption {
    /// As requests name it.
    pub value: String,
    /// In words.
    pub words: String,
    /// Algorithms with a result there.
    pub algorithms: u32,
}

/// One algorithm with its settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BoardRow {
    /// Algorithm id, with its settings.
    pub algorithm: String,
    /// Display name.
    pub name: String,
    /// What its hierarchy is made of.
    pub family: String,
    /// Contract class, in words.
    pub class: String,
    /// Place by speed, from 1; overlapping intervals share one. Absent for what failed or answered wrongly.
    pub rank: Option<u32>,
    /// Shares its place.
    pub tied: bool,
    /// Why it has no place.
    pub reason: Option<String>,
    /// Nothing else is as accurate and faster.
    pub frontier: bool,
    /// Answers judged.
    pub n: u64,
    /// Wrong answers in all.
    pub wrong: u64,
    /// Missed collisions.
    pub missed: u64,
    /// False alarms.
    pub false_alarms: u64,
    /// Share of wrong answers with its 95 % interval; when none was seen, the upper end is 3 / n.
    pub wrong_share: Option<Estimated>,
    /// Of missed collisions.
    pub missed_share: Option<Estimated>,
    /// Of false alarms.
    pub false_alarm_share: Option<Estimated>,
    /// eps*, or its bound when no error was seen.
    pub eps: Option<f64>,
    /// `eps` is a value and no bound.
    pub eps_seen: bool,
    /// Worst error of a distance in roundings `u S`; absent when no distance was asked for.
    pub distance_error: Option<f64>,
    /// Questions per second, by the mean time; its 95 % interval is over the processes.
    pub rate: Option<Estimated>,
    /// Build time of both structures, milliseconds; the longest.
    pub build_ms: Option<f64>,
    /// Memory in bytes; the most.
    pub memory_bytes: Option<u64>,
    /// What the same plugin file did with hard questions, if it was tried.
    pub stability: Option<StabilityPassed>,
    /// Scenes and distances it was measured on.
    pub scenarios: u32,
    /// Of so many.
    pub of: u32,
    /// When the oldest of its measurements ended.
    pub finished_us: i64,
    /// The runs behind it.
    pub runs: Vec<String>,
    /// Version of the oracle that judged it.
    pub oracle: Option<u32>,
    /// Hardware class.
    pub hardware_class: String,
    /// SHA-256 of the plugin file.
    pub plugin_sha256: String,
    /// How its code was compiled; empty when it was measured by an older version.
    pub builds: Vec<BuildInfo>,
}

/// Stress families that a method got through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct StabilityPassed {
    /// Families without a wrong answer, a crash or a hang.
    pub passed: u32,
    /// Of those that it answers.
    pub of: u32,
}
