//! Selected configurations, and the worst ones.

use ocb_core::record::Verdict;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

/// How many configurations a selection holds, and what they cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Selected {
    /// The selection as it was understood.
    #[serde(rename = "where")]
    pub selection: String,
    /// Configurations in it.
    pub n: u32,
    /// Configurations in the set.
    pub of: u32,
    /// Every algorithm of the run that has records.
    pub algorithms: Vec<SelectedOf>,
}

/// The selected configurations of one algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SelectedOf {
    /// Algorithm id.
    pub algorithm: String,
    /// Selected configurations on which it was measured.
    pub n: u32,
    /// Wrong answers among them.
    pub wrong: u32,
    /// Median time, nanoseconds; absent without any.
    pub median_ns: Option<f64>,
    /// 99th percentile of the time.
    pub p99_ns: Option<f64>,
    /// Largest time.
    pub max_ns: Option<f64>,
}

/// What counts as worse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum WorstBy {
    /// The longer time.
    #[default]
    Time,
    /// The larger error of the distance.
    Error,
}

/// Which list of the worst.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct WorstRequest {
    /// Algorithm id.
    pub algorithm: String,
    /// What counts as worse, after wrong answers, which always come first.
    #[serde(default)]
    #[param(inline)]
    pub by: WorstBy,
    /// How many at most, 1 to 1000 [default: 100].
    #[serde(default = "hundred")]
    pub limit: u32,
    /// Only among the configurations of this selection.
    #[serde(default, rename = "where")]
    #[param(rename = "where")]
    pub selection: Option<String>,
}

fn hundred() -> u32 {
    100
}

/// One of the worst configurations of an algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WorstCase {
    /// Index of the configuration in the set.
    pub configuration: u32,
    /// Time of the query, nanoseconds.
    pub time_ns: f64,
    /// What the answer is worth.
    pub verdict: Verdict,
    /// The answer: do they collide; absent when a distance was asked, or nothing answered.
    pub hit: Option<bool>,
    /// The answer: how far apart.
    pub distance: Option<f64>,
    /// How far that lies outside the certified interval, in u S.
    pub error: Option<f64>,
    /// Answers to equivalent instances that contradict the first one; absent in old records.
    pub flips: Option<u32>,
    /// The truth: do they collide.
    pub true_hit: bool,
    /// The truth: certified bounds of the distance.
    pub true_distance: [f64; 2],
    /// How far every vertex may move and the crossing still holds.
    pub margin: f64,
    /// Pose of A: object to world, row-major 4x4.
    pub pose_a: Vec<f64>,
    /// Pose of B.
    pub pose_b: Vec<f64>,
    /// Certified witness points in the world, on A and on B; a common point twice when they collide.
    pub points: [[f64; 3]; 2],
    /// The triangles of A and B that hold them.
    pub triangles: [u32; 2],
    /// What a wrong answer points at, to be held against the certified points; absent when the answer is right or names
    /// nothing.
    pub claim: Option<Claim>,
}

/// What an answer says to be where two objects meet, or are nearest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Claim {
    /// Triangles of A and B.
    pub triangles: Option<[u32; 2]>,
    /// Points in the world, on A and on B.
    pub points: Option<[[f64; 3]; 2]>,
}

/// All pairs of triangles that meet in one configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Meeting {
    /// Index of the configuration in the set.
    pub configuration: u32,
    /// Pairs that meet.
    pub total: u32,
    /// The pairs (triangle of A, triangle of B), at most 100,000.
    pub pairs: Vec<[u32; 2]>,
}
