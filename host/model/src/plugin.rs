//! Algorithms, and what the check of a plugin finds.

use ocb_core::query::Query;
use ocb_core::record::Verdict;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One algorithm of one plugin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AlgorithmInfo {
    /// Unique id, e.g. `box-tree`; in a result with the settings that were chosen, `box-tree:leaf_size=4`.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Version as the plugin says it.
    pub version: String,
    /// Authors.
    pub authors: String,
    /// SPDX licence expression.
    pub license: String,
    /// Home page or source.
    pub url: String,
    /// The paper the method comes from.
    pub paper: String,
    /// The questions it answers.
    pub queries: Vec<Query>,
    /// It reports BV and primitive tests.
    pub counters: bool,
    /// It reports witness points.
    pub witness_points: bool,
    /// It computes in f32: its answers are judged in the wider band.
    pub single_precision: bool,
    /// It also answers for solid bodies, where an object inside another one collides.
    pub solid: bool,
    /// It uses earlier answers: the order of the configurations matters to it.
    pub coherent: bool,
    /// It can use several CPUs: `threads=2` behind its id enters the multi-threaded track.
    pub threads: bool,
    /// A process of it can hold a scene of many objects: the extension `ocb.scene/1`. No when an older version looked.
    #[serde(default)]
    pub scene: bool,
    /// It is measured when no algorithm is named.
    pub usual: bool,
    /// Its parameters; a value is chosen behind the id, as in `box-tree:leaf_size=4`.
    pub parameters: Vec<ParameterInfo>,
    /// SHA-256 (hex) of the plugin file.
    pub plugin_sha256: String,
    /// How its code was compiled: the plugin file, then the libraries that it brings. Empty when an older version looked.
    #[serde(default)]
    pub builds: Vec<BuildInfo>,
}

/// How one file of an algorithm was compiled. A part of the result: the same source compiled for another processor may take half
/// the time.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct BuildInfo {
    /// Name of the file, without its folder.
    pub file: String,
    /// What the compilers wrote into it of themselves.
    pub compilers: Vec<String>,
    /// The options that they recorded (`-frecord-gcc-switches`), those that decide what code is made; empty when they did not.
    pub flags: Vec<String>,
    /// Extensions of x86-64 whose instructions were found in its code, e.g. `AVX2`. It may choose among them when it runs.
    pub instruction_sets: Vec<String>,
}

/// A knob of an algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ParameterInfo {
    /// Name.
    pub name: String,
    /// What it does.
    pub description: String,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
    /// Value when nothing is said.
    pub default: f64,
    /// Only whole numbers.
    pub integer: bool,
}

/// What `plugin check` found, line by line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PluginReport {
    /// File name, without its folder.
    pub file: String,
    /// SHA-256 (hex) of the file; absent when it could not be read.
    pub sha256: Option<String>,
    /// No line failed.
    pub passed: bool,
    /// The checks in order; those behind a fatal one are left out.
    pub lines: Vec<CheckLine>,
    /// The algorithms that the plugin describes.
    pub algorithms: Vec<AlgorithmInfo>,
}

/// One check of a plugin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CheckLine {
    /// What was checked, e.g. `load in the jail`.
    pub check: String,
    /// How it ended.
    pub verdict: CheckVerdict,
    /// What was seen, one sentence.
    pub evidence: String,
    /// How to mend it, when it did not pass.
    pub hint: Option<String>,
    /// The smallest question found that is answered wrongly.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repro: Option<Box<Repro>>,
}

/// One question that is answered wrongly; `ocb plugin check FILE.so --repro FILE.json` asks it again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Repro {
    /// Algorithm id.
    pub algorithm: String,
    /// The question.
    pub query: Query,
    /// Object A as OBJ text, reduced to as few triangles as still fail.
    pub object_a: String,
    /// Object B.
    pub object_b: String,
    /// Pose of A, a row-major 4x4 matrix.
    pub pose_a: [f64; 16],
    /// Pose of B.
    pub pose_b: [f64; 16],
    /// Triangles of A and of B.
    pub triangles: [u32; 2],
    /// What the oracle says.
    pub expected: String,
    /// What the plugin answered.
    pub got: String,
    /// What is wrong with it.
    pub verdict: Verdict,
    /// It fails also when it is the only question. If not, answers depend on the questions before, and nothing was reduced.
    pub alone: bool,
}

/// How one check ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum CheckVerdict {
    /// As it must be.
    Pass,
    /// Allowed, but the author may want to know.
    Note,
    /// Must be mended.
    Fail,
}
