//! The public benchmark as data: which scenes, how far apart and what is asked, under a version and a hash.

pub(crate) mod known;
pub mod planning;
pub mod sql;

use std::path::Path;

use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::query::{Query, Semantics};
use serde::Deserialize;

use crate::model::{ObjectId, RunSpec};
use crate::sha256_hex;
use crate::{EngineError, Result};

/// The one that ships. It is never changed once results lie under its hash: a change is another version.
const NEWEST: &str = include_str!("suite/2.json");

/// Scenarios of a suite at most, and bytes of its file: it is to be affordable.
const MAX_SCENARIOS: usize = 1000;
const MAX_BYTES: u64 = 1 << 20;

/// A suite: every scene at every separation, asked every question.
#[derive(Clone, Debug)]
pub struct Suite {
    /// What its file says.
    pub document: Document,
    /// SHA-256 (hex) of the file.
    pub sha256: String,
    /// The file.
    pub text: String,
}

/// The file of a suite.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Another one for every change.
    pub version: u32,
    /// Objects A and B of each scene: stock objects with their triangle counts.
    pub scenes: Vec<[String; 2]>,
    /// How far apart, or how deep in each other.
    pub separations: Vec<Separation>,
    /// What is asked.
    pub queries: Vec<Query>,
    /// Configurations of each scenario, by the sphere method.
    pub configurations: u32,
    /// Seed of the configurations. Without it each run has its own, drawn once its plugins are fixed, so that no plugin can
    /// bring the answers with it.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Fresh processes for each algorithm.
    pub passes: u32,
    /// Measuring time for each algorithm in each scenario.
    pub budget_seconds: f64,
}

impl Suite {
    /// The one in this file, or the newest that ships.
    pub fn open(file: Option<&Path>) -> Result<Self> {
        let Some(file) = file else { return Self::read(NEWEST) };
        let bad = |why: String| EngineError::Invalid(format!("The suite {} cannot be used: {why}", file.display()));
        let bytes = ocb_sandbox::given::read(file, MAX_BYTES).map_err(|e| bad(format!("{e}.")))?;
        let text = String::from_utf8(bytes).map_err(|_| bad("it is not text.".into()))?;
        Self::read(&text).map_err(|e| bad(e.to_string()))
    }

    /// From the text of its file.
    pub fn read(text: &str) -> Result<Self> {
        let document: Document = serde_json::from_str(text)
            .map_err(|e| EngineError::Invalid(format!("It is not a description of a suite: {e}.")))?;
        let Document { scenes, separations, queries, .. } = &document;
        let scenarios = scenes.len() * separations.len() * queries.len();
        if !(1..=MAX_SCENARIOS).contains(&scenarios) {
            return Err(EngineError::Invalid(format!(
                "A suite has 1 to {MAX_SCENARIOS} scenarios (scenes times separations times queries), not {scenarios}."
            )));
        }
        if let Some(other) =
            scenes.iter().flatten().find(|id| !matches!(ObjectId::of(id), ObjectId::Stock { triangles: Some(_), .. }))
        {
            return Err(EngineError::Invalid(format!(
                "The objects of a suite are stock objects with their triangles, such as stock:castle@5000, not {other:?}."
            )));
        }
        Ok(Self { document, sha256: sha256_hex(text.as_bytes()), text: text.to_owned() })
    }

    /// Every scenario as a run without algorithms: by questions, then scenes, then separations.
    pub fn scenarios(&self) -> Vec<RunSpec> {
        let Document { scenes, separations, queries, .. } = &self.document;
        let mut all = Vec::new();
        for query in queries {
            for scene in scenes {
                all.extend(separations.iter().map(|separation| self.scenario(*query, scene, *separation)));
            }
        }
        all
    }

    fn scenario(&self, query: Query, [a, b]: &[String; 2], separation: Separation) -> RunSpec {
        let Document { configurations: count, seed, passes, budget_seconds, .. } = self.document;
        RunSpec {
            object_a: a.clone(),
            object_b: Some(b.clone()).filter(|b| b != a),
            query,
            semantics: Semantics::Surface,
            method: Method::Sphere { sampling: Sampling::Count { count }, seed: seed.unwrap_or_default() },
            separation,
            algorithms: Vec::new(),
            passes,
            budget_seconds,
            seed: None,
            precision: None,
            at_most: None,
            hardware_class: None,
        }
    }
}

/// The scenario of a run: equal for two runs that differ in algorithms, hardware class and drawn configurations only.
pub fn scenario_of(spec: &RunSpec) -> RunSpec {
    RunSpec { algorithms: Vec::new(), hardware_class: None, ..drawn_anew(spec, 0) }
}

/// The same with configurations of this seed.
pub fn drawn_anew(spec: &RunSpec, seed: u64) -> RunSpec {
    let mut spec = spec.clone();
    if let Method::Sphere { seed: old, .. } = &mut spec.method {
        *old = seed;
    }
    spec
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_version_that_was_published_is_not_changed() {
        let suite = Suite::open(None).unwrap();
        let published = [(2, "387285b6f896d2990e99fa9f588a65362c328220278c7b514272a9d3308c2299")];
        assert!(
            published.contains(&(suite.document.version, suite.sha256.as_str())),
            "results are stored by the hash of a version: give the changed suite a new version ({}: {})",
            suite.document.version,
            suite.sha256
        );
    }

    #[test]
    fn every_scene_is_asked_everything_at_every_distance() {
        let suite = Suite::open(None).unwrap();
        let scenarios = suite.scenarios();
        assert_eq!(scenarios.len(), 4 * 3 * 2);
        assert!(scenarios.iter().enumerate().all(|(i, one)| scenarios[..i].iter().all(|other| other != one)));
        // Some of it collides: a method that never answers "hit" must not get through.
        assert!(
            scenarios.iter().any(|spec| spec.separation == Separation::Ladder && spec.query == Query::CollisionFirst)
        );
        let measured = RunSpec { algorithms: vec!["box-tree".into()], ..scenarios[3].clone() };
        assert_eq!(scenario_of(&measured), scenarios[3]);
        let drawn = drawn_anew(&measured, 99);
        assert_ne!(drawn.method, measured.method);
        assert_eq!(scenario_of(&drawn), scenarios[3]);
    }

    #[test]
    fn what_is_no_suite_is_refused_with_a_reason() {
        let with = |from: &str, to: &str| Suite::read(&NEWEST.replace(from, to)).unwrap_err().to_string();
        assert!(with("\"passes\": 5,", "").contains("passes"));
        assert!(with("\"collision_first\", \"proximity\"", "").contains("not 0"));
        assert!(with("stock:gear@4000", "stock:gear").contains("\"stock:gear\""));
        let told = Suite::open(Some(Path::new("/nonexistent/suite.json"))).unwrap_err().to_string();
        assert!(told.contains("/nonexistent/suite.json"), "{told}");
    }
}
