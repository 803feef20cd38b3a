//! The public benchmark: which results of the suite there are, which are missing, and queueing those.
//!
//! The runs of the suite are ordinary runs, so everything that shows, repeats and deletes runs works for them as well. Our own
//! algorithms are measured when the operator runs `ocb suite run` and while the service is idle (`crate::idle`), a developer's
//! plugin when it becomes public.

use std::collections::{HashMap, HashSet};

use crate::boxed;
use crate::engine::{Engine, Inner};
use crate::idle::sql::Tried;
use crate::locks::Lock;
use crate::model::{AlgorithmInfo, Environment, PluginState, RunInfo, RunSpec, State, SuiteInfo, SuiteProgress};
use crate::plugins::registry::Registry;
use crate::runs::RunContext;
use crate::runs::priority::BACKGROUND;
use crate::runs::sql::RunRow;
use crate::suite::scenario_of;
use crate::{EngineError, Result};

/// Algorithms of one run: whoever comes meanwhile waits for no more than these.
pub(crate) const AT_ONCE: usize = 4;

/// What is known of one algorithm in one scenario, here and now.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Known {
    Measured,
    Waiting,
}

impl Engine {
    /// The suite, and how far each public algorithm has come with it on this hardware class, or on the usual one.
    ///
    /// # Errors
    /// `Invalid` when no machine has this class.
    #[boxed]
    pub async fn suite(&self, class: Option<&str>) -> Result<SuiteInfo> {
        let suite = &self.inner.suite;
        let class = self.inner.classes.measures_on(class)?;
        let (known, tried) = (self.inner.known(&class).await?, self.inner.store.tried().await?);
        let scenarios = suite.scenarios();
        let progress = |algorithm: AlgorithmInfo| -> Result<SuiteProgress> {
            let answered = scenarios.iter().filter(|spec| algorithm.queries.contains(&spec.query));
            let of = |what| {
                let has = |spec: &&RunSpec| known.of(&algorithm, spec) == Some(what);
                answered.clone().filter(has).count() as u32
            };
            let (measured, waiting, of) = (of(Known::Measured), of(Known::Waiting), answered.clone().count() as u32);
            let mut failed = 0;
            for spec in answered.filter(|spec| known.of(&algorithm, spec).is_none()) {
                let what = self.inner.of_the_suite(spec, &class)?;
                failed += u32::from(tried.contains(&Tried::of(&what, &algorithm)));
            }
            Ok(SuiteProgress { algorithm: algorithm.id, name: algorithm.name, measured, waiting, failed, of })
        };
        let document = &suite.document;
        Ok(SuiteInfo {
            version: document.version,
            sha256: suite.sha256.clone(),
            scenes: document.scenes.clone(),
            separations: document.separations.clone(),
            queries: document.queries.clone(),
            configurations: document.configurations,
            passes: document.passes,
            scenarios: scenarios.len() as u32,
            hardware_class: class.clone(),
            hardware_classes: self.inner.classes.names(),
            oracle: ocb_core::oracle::VERSION,
            idle: self.inner.config.idle,
            progress: self.inner.registry.public().into_iter().map(progress).collect::<Result<_>>()?,
        })
    }

    /// Queues what these public algorithms have not been measured on yet, on each hardware class and by this oracle; of all of
    /// them when none is named. Whatever anybody waits for goes before it.
    #[boxed]
    pub async fn measure_suite(&self, only: &[String]) -> Result<Vec<RunInfo>> {
        let _alone = self.inner.store.locks.alone(Lock::Planning).await?;
        let mut queued = Vec::new();
        for class in self.inner.classes.names() {
            queued.extend(self.queue_missing(only, &self.inner.known(&class).await?, &class).await?);
        }
        Ok(queued)
    }

    /// Queues what is not known of these, or of all, on a class. Whoever calls it is planning alone.
    async fn queue_missing(&self, only: &[String], known: &AllKnown, class: &str) -> Result<Vec<RunInfo>> {
        let inner = &self.inner;
        let public = inner.registry.public();
        if let Some(unknown) = only.iter().find(|id| public.iter().all(|a| a.id != **id)) {
            return Err(EngineError::Invalid(format!(
                "There is no public algorithm {unknown:?}; the suite measures public algorithms with default settings."
            )));
        }
        inner.keep_suite().await?;
        let mut queued = Vec::new();
        for spec in inner.suite.scenarios() {
            let wanted = |a: &&AlgorithmInfo| {
                (only.is_empty() || only.contains(&a.id))
                    && a.queries.contains(&spec.query)
                    && known.of(a, &spec).is_none()
            };
            let missing: Vec<String> = public.iter().filter(wanted).map(|a| a.id.clone()).collect();
            for some in missing.chunks(AT_ONCE) {
                let spec =
                    RunSpec { algorithms: some.to_vec(), hardware_class: inner.classes.named(class), ..spec.clone() };
                let asking =
                    RunContext { priority: BACKGROUND, suite: Some(&inner.suite.sha256), ..RunContext::default() };
                queued.push(self.queue(spec, asking).await?.0);
            }
        }
        Ok(queued)
    }

    /// Ends those of these runs of the suite that have not ended.
    #[boxed]
    pub async fn end_suite_runs(&self, runs: &[RunInfo]) -> Result<()> {
        for run in runs {
            let row = self.inner.store.run_row(&run.id).await?;
            if row.suite.is_some() {
                self.end(&row, None).await?;
            }
        }
        Ok(())
    }

    /// Submitted plugins that are public are measured on the suite, also where the service ended before it was queued. What
    /// was measured on another hardware class, suite or oracle is for a campaign, which a curator begins.
    pub(crate) async fn catch_up_with_the_suite(&self) -> Result<()> {
        if !self.inner.config.catch_up {
            return Ok(());
        }
        let rows = self.inner.store.plugins().await?;
        let public = rows.iter().filter(|row| row.state == PluginState::Public);
        let only = public_of(&self.inner.registry, public.flat_map(|row| &row.algorithms));
        if only.is_empty() {
            return Ok(());
        }
        let _alone = self.inner.store.locks.alone(Lock::Planning).await?;
        let known = self.inner.known_anywhere().await?;
        self.queue_missing(&only, &known, &self.inner.classes.usual()).await.map(drop)
    }

    /// Queues what is missing of these, as far as they are public.
    pub(crate) async fn measure_submitted(&self, submitted: impl Iterator<Item = &AlgorithmInfo>) -> Result<()> {
        let only = public_of(&self.inner.registry, submitted);
        if only.is_empty() { Ok(()) } else { self.measure_suite(&only).await.map(drop) }
    }
}

/// Which plugin file of an algorithm has come how far in a scenario; a run that waits takes whatever is there then.
#[derive(Default)]
pub(crate) struct AllKnown {
    files: HashMap<[String; 2], Vec<KnownFile>>,
    /// Plugin files of which nothing is missing, whatever the scenario.
    settled: HashSet<String>,
}

/// The hash of a plugin file, once it is measured, and how far it is.
type KnownFile = (Option<String>, Known);

impl AllKnown {
    pub(crate) fn add(&mut self, spec: &RunSpec, algorithm: &str, file: Option<String>, known: Known) -> Result<()> {
        self.files.entry([scenario(spec)?, algorithm.to_owned()]).or_default().push((file, known));
        Ok(())
    }

    pub(crate) fn of(&self, algorithm: &AlgorithmInfo, spec: &RunSpec) -> Option<Known> {
        if self.settled.contains(&algorithm.plugin_sha256) {
            return Some(Known::Measured);
        }
        let all = self.files.get(&[scenario(spec).ok()?, algorithm.id.clone()])?;
        let same = |file: &Option<String>| file.as_ref().is_none_or(|file| *file == algorithm.plugin_sha256);
        let here = || all.iter().filter(|(file, _)| same(file)).map(|(_, known)| *known);
        here().find(|known| *known == Known::Measured).or_else(|| here().next())
    }
}

pub(crate) fn scenario(spec: &RunSpec) -> Result<String> {
    serde_json::to_string(&scenario_of(spec)).map_err(|e| EngineError::fault("Naming a scenario failed", e))
}

/// The ids of these, as far as they are public.
fn public_of<'a>(registry: &Registry, these: impl Iterator<Item = &'a AlgorithmInfo>) -> Vec<String> {
    let these: Vec<&str> = these.map(|algorithm| algorithm.id.as_str()).collect();
    let mut only: Vec<String> = registry.public().into_iter().map(|algorithm| algorithm.id).collect();
    only.retain(|id| these.contains(&id.as_str()));
    only
}

impl Inner {
    /// Keeps the suite, so that results may lie under its hash.
    pub(crate) async fn keep_suite(&self) -> Result<()> {
        if self.store.keep_suite(&self.suite).await? {
            return Ok(());
        }
        Err(EngineError::Invalid(format!(
            "A different suite with version {} was measured here; give this one a new version.",
            self.suite.document.version
        )))
    }

    /// What is known of the suite on this class now.
    pub(crate) async fn known(&self, class: &str) -> Result<AllKnown> {
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
    async fn known_anywhere(&self) -> Result<AllKnown> {
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
    pub(crate) fn is_of_now(&self, row: &RunRow, class: &str) -> bool {
        let here = |machine: &Environment| {
            machine.hardware_class == class && machine.profile == self.registry.profile().as_str()
        };
        row.environment.as_ref().is_some_and(here)
            && row.set.as_ref().is_some_and(|set| set.oracle == Some(ocb_core::oracle::VERSION))
    }
}
