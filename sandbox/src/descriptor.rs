//! What a plugin says of one of its algorithms.

use ocb_core::query::Query;
use serde::{Deserialize, Serialize};

/// What a plugin says of one of its algorithms. Text is bounded and free of control characters, and unverified.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descriptor {
    /// Unique id, e.g. `box-tree`.
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
    /// Computes in f32: its answers are judged in the wider band.
    pub single_precision: bool,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
}

/// A knob of an algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
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
