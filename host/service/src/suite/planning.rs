//! The public benchmark: which results of the suite there are, which are missing, and queueing those.
//!
//! The runs of the suite are ordinary runs, so everything that shows, repeats and deletes runs works for them as well. Our own
//! algorithms are measured when the operator runs `ocb suite run` and while the service is idle (`crate::idle`), a developer's
//! plugin when it becomes public.

use crate::boxed;
use crate::engine::Engine;
use crate::idle::sql::Tried;
use crate::locks::Lock;
use crate::model::{AlgorithmInfo, PluginState, RunInfo, RunSpec, SuiteInfo, SuiteProgress};
use crate::plugins::registry::Registry;
use crate::runs::asking::RunContext;
use crate::runs::priority::BACKGROUND;
use crate::suite::known::{AllKnown, Known};
use crate::{EngineError, Result};

/// Algorithms of one run: whoever comes meanwhile waits for no more than these.
pub(crate) const AT_ONCE: usize = 4;

impl Engine {
    /// The suite, and how far each public algorithm has come with it on this hardware class, or on the usual one.
    ///
    /// # Errors
    /// `Invalid` when no machine has this class.
    #[boxed]
    pub async fn suite(&self, class: Option<&str>) -> Result<SuiteInfo> {
        let suite = &self.inner.suite;
        let class = self.inner.classes.measures_on(class)?;
        let (known, tried) = (self.inner.suite_runs.known(&class).await?, self.inner.store.tried().await?);
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
                let what = self.inner.suite_runs.of_the_suite(spec, &class)?;
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
            queued.extend(self.queue_missing(only, &self.inner.suite_runs.known(&class).await?, &class).await?);
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
        inner.suite_runs.keep_suite().await?;
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
        let known = self.inner.suite_runs.known_anywhere().await?;
        self.queue_missing(&only, &known, &self.inner.classes.usual()).await.map(drop)
    }

    /// Queues what is missing of these, as far as they are public.
    pub(crate) async fn measure_submitted(&self, submitted: impl Iterator<Item = &AlgorithmInfo>) -> Result<()> {
        let only = public_of(&self.inner.registry, submitted);
        if only.is_empty() { Ok(()) } else { self.measure_suite(&only).await.map(drop) }
    }
}

/// The ids of these, as far as they are public.
fn public_of<'a>(registry: &Registry, these: impl Iterator<Item = &'a AlgorithmInfo>) -> Vec<String> {
    let these: Vec<&str> = these.map(|algorithm| algorithm.id.as_str()).collect();
    let mut only: Vec<String> = registry.public().into_iter().map(|algorithm| algorithm.id).collect();
    only.retain(|id| these.contains(&id.as_str()));
    only
}
