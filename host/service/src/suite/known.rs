//! The runs of the suite, and what is known from them.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::classes::Classes;
use crate::model::{AlgorithmInfo, Environment, RunSpec, State};
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::suite::{Suite, scenario_of};
use crate::{EngineError, Profile, Result};

/// What is known of one algorithm in one scenario, here and now.
#[derive(Clone, Copy, PartialEq)]
pub enum Known {
    Measured,
    Waiting,
}

/// The runs of a suite on one database.
pub struct SuiteRuns {
    pub store: Store,
    pub suite: Arc<Suite>,
    pub classes: Arc<Classes>,
    /// How plugins are jailed here.
    pub profile: Profile,
}

impl SuiteRuns {
    /// Keeps the suite, so that results may lie under its hash.
    pub async fn keep_suite(&self) -> Result<()> {
        if self.store.keep_suite(&self.suite).await? {
            return Ok(());
        }
        Err(EngineError::Invalid(format!(
            "A different suite with version {} was measured here; give this one a new version.",
            self.suite.document.version
        )))
    }

    /// What is known of the suite on this class now.
    pub async fn known(&self, class: &str) -> Result<AllKnown> {
        let mut all = AllKnown::default();
        for row in self.store.suite_runs().await?.iter().filter(|row| self.is_of_the_suite(row)) {
            let waits = row.state != State::Done && self.classes.waiting_for(&row.spec).class == class;
            if waits || row.state == State::Done && self.is_of_now(row, class) {
                self.note(&mut all, row).await?;
            }
        }
        Ok(all)
    }

    /// What was ever known of a suite, wherever it was measured.
    pub async fn known_anywhere(&self) -> Result<AllKnown> {
        let mut all = AllKnown::default();
        for row in self.store.suite_runs().await? {
            if self.is_of_the_suite(&row) {
                self.note(&mut all, &row).await?;
            } else {
                all.settled.extend(self.store.results(&row.id).await?.into_iter().map(|stored| stored.plugin_sha256));
            }
        }
        Ok(all)
    }

    async fn note(&self, all: &mut AllKnown, row: &RunRow) -> Result<()> {
        if row.state != State::Done {
            for algorithm in &row.spec.algorithms {
                all.add(&row.spec, algorithm, None, Known::Waiting)?;
            }
            return Ok(());
        }
        for stored in self.store.results(&row.id).await? {
            // Whose time was over before its first answer is asked again.
            if stored.result.had_no_time() {
                continue;
            }
            let algorithm = &stored.result.algorithm;
            all.add(&row.spec, algorithm, Some(stored.plugin_sha256.clone()), Known::Measured)?;
        }
        Ok(())
    }

    fn is_of_the_suite(&self, row: &RunRow) -> bool {
        row.suite.as_ref() == Some(&self.suite.sha256)
    }

    /// Measured on this class, judged by this oracle, in a jail like this.
    pub fn is_of_now(&self, row: &RunRow, class: &str) -> bool {
        let here = |machine: &Environment| machine.hardware_class == class && machine.profile == self.profile.as_str();
        row.environment.as_ref().is_some_and(here)
            && row.set.as_ref().is_some_and(|set| set.oracle == Some(ocb_core::oracle::VERSION))
    }

    /// A scenario of the suite on this class, judged by this oracle, in a jail like this.
    pub fn of_the_suite(&self, spec: &RunSpec, class: &str) -> Result<String> {
        let (suite, oracle, scenario) = (&self.suite.sha256, ocb_core::oracle::VERSION, scenario(spec)?);
        Ok(format!("suite {suite}, class {class}, {}, oracle {oracle}: {scenario}", self.profile.as_str()))
    }
}

/// Which plugin file of an algorithm has come how far in a scenario; a run that waits takes whatever is there then.
#[derive(Default)]
pub struct AllKnown {
    files: HashMap<[String; 2], Vec<KnownFile>>,
    /// Plugin files of which nothing is missing, whatever the scenario.
    settled: HashSet<String>,
}

/// The hash of a plugin file, once it is measured, and how far it is.
type KnownFile = (Option<String>, Known);

impl AllKnown {
    pub fn add(&mut self, spec: &RunSpec, algorithm: &str, file: Option<String>, known: Known) -> Result<()> {
        self.files.entry([scenario(spec)?, algorithm.to_owned()]).or_default().push((file, known));
        Ok(())
    }

    pub fn of(&self, algorithm: &AlgorithmInfo, spec: &RunSpec) -> Option<Known> {
        if self.settled.contains(&algorithm.plugin_sha256) {
            return Some(Known::Measured);
        }
        let all = self.files.get(&[scenario(spec).ok()?, algorithm.id.clone()])?;
        let same = |file: &Option<String>| file.as_ref().is_none_or(|file| *file == algorithm.plugin_sha256);
        let here = || all.iter().filter(|(file, _)| same(file)).map(|(_, known)| *known);
        here().find(|known| *known == Known::Measured).or_else(|| here().next())
    }
}

pub fn scenario(spec: &RunSpec) -> Result<String> {
    serde_json::to_string(&scenario_of(spec)).map_err(|e| EngineError::fault("Naming a scenario failed", e))
}
