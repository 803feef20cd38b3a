//! The public benchmark: what every public plugin is measured on, and how far that is.

use ocb_core::configuration::Separation;
use ocb_core::query::Query;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The suite of this service: every scene at every separation, asked every question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SuiteInfo {
    /// Its version: another one for every change.
    pub version: u32,
    /// SHA-256 (hex) of its file.
    pub sha256: String,
    /// Objects A and B of each scene.
    pub scenes: Vec<[String; 2]>,
    /// How far apart, or how deep in each other.
    pub separations: Vec<Separation>,
    /// What is asked.
    pub queries: Vec<Query>,
    /// Configurations of each scenario.
    pub configurations: u32,
    /// Fresh processes for each algorithm.
    pub passes: u32,
    /// Scenarios: scenes times separations times queries.
    pub scenarios: u32,
    /// The hardware class for which the progress is told.
    pub hardware_class: String,
    /// All hardware classes on which the suite is measured.
    pub hardware_classes: Vec<String>,
    /// Version of the oracle that judges.
    pub oracle: u32,
    /// The service measures missing results while it is idle.
    pub idle: bool,
    /// How far each public algorithm has come, by id.
    pub progress: Vec<SuiteProgress>,
}

/// How far an algorithm has come with the suite.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct SuiteProgress {
    /// Algorithm id.
    pub algorithm: String,
    /// Display name.
    pub name: String,
    /// Scenarios with a result of its file here.
    pub measured: u32,
    /// Scenarios that are in the queue.
    pub waiting: u32,
    /// Scenarios that the service tried while idle, without a result; it does not try them again.
    pub failed: u32,
    /// Scenarios whose question it answers.
    pub of: u32,
}

/// The part of a suite that a board shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct BoardSuite {
    /// Its version.
    pub version: u32,
    /// SHA-256 (hex) of its file.
    pub sha256: String,
    /// Scenarios that the filters leave; who was not measured on all of them has no place.
    pub scenarios: u32,
    /// The hardware class of all these results, in words.
    pub hardware: String,
    /// When the oldest of these results was measured.
    pub oldest_us: i64,
    /// When the newest was.
    pub newest_us: i64,
}
