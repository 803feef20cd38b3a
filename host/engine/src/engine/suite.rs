//! The public benchmark: which results of the suite there are, which are missing, and queueing those.

use std::collections::HashMap;

use super::runs::Asking;
use super::{BACKGROUND, Engine, Inner};
use crate::boxed;
use crate::model::{AlgorithmInfo, Environment, PluginState, RunInfo, RunSpec, State, SuiteInfo, SuiteProgress};
use crate::store::RunRow;
use crate::suite::scenario_of;
use crate::{EngineError, Result};

/// Algorithms of one run: whoever comes meanwhile waits for no more than these.
const AT_ONCE: usize = 4;

/// What is known of one algorithm in one scenario, here and now.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    Measured,
    Waiting,
}

impl Engine {
    /// The suite, and how far each public algorithm has come with it on this machine.
    #[boxed]
    pub async fn suite(&self) -> Result<SuiteInfo> {
        let suite = &self.inner.suite;
        let known = self.inner.known().await?;
        let scenarios = suite.scenarios();
        let progress = |algorithm: AlgorithmInfo| {
            let answered = scenarios.iter().filter(|spec| algorithm.queries.contains(&spec.query));
            let of = |what| {
                let has = |spec: &&RunSpec| known.of(&algorithm, spec) == Some(what);
                answered.clone().filter(has).count() as u32
            };
            let (measured, waiting, of) = (of(Known::Measured), of(Known::Waiting), answered.clone().count() as u32);
            SuiteProgress { algorithm: algorithm.id, name: algorithm.name, measured, waiting, of }
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
            hardware_class: self.inner.machine.hardware_class.clone(),
            oracle: ocb_core::oracle::VERSION,
            progress: self.inner.public().into_iter().map(progress).collect(),
        })
    }

    /// Queues what these public algorithms have not been measured on yet, on this machine and by this oracle; of all of
    /// them when none is named. Whatever anybody waits for goes before it.
    #[boxed]
    pub async fn measure_suite(&self, only: &[String]) -> Result<Vec<RunInfo>> {
        let inner = &self.inner;
        let _alone = inner.planning.lock().await;
        let public = inner.public();
        if let Some(unknown) = only.iter().find(|id| public.iter().all(|a| a.id != **id)) {
            return Err(EngineError::Invalid(format!(
                "There is no public algorithm {unknown:?}; the suite is for public ones, as they are when nothing is set."
            )));
        }
        if !inner.store.keep_suite(&inner.suite).await? {
            return Err(EngineError::Invalid(format!(
                "Another suite of the version {} was measured here; give this one another version.",
                inner.suite.document.version
            )));
        }
        let known = inner.known().await?;
        let mut queued = Vec::new();
        for spec in inner.suite.scenarios() {
            let wanted = |a: &&AlgorithmInfo| {
                (only.is_empty() || only.contains(&a.id))
                    && a.queries.contains(&spec.query)
                    && known.of(a, &spec).is_none()
            };
            let missing: Vec<String> = public.iter().filter(wanted).map(|a| a.id.clone()).collect();
            for some in missing.chunks(AT_ONCE) {
                let spec = RunSpec { algorithms: some.to_vec(), ..spec.clone() };
                let asking = Asking { priority: BACKGROUND, suite: Some(&inner.suite.sha256), ..Asking::default() };
                queued.push(self.queue(spec, asking).await?.0);
            }
        }
        Ok(queued)
    }

    /// Ends those of these runs of the suite that have not ended.
    #[boxed]
    pub async fn end_suite_runs(&self, runs: &[RunInfo]) -> Result<()> {
        for run in runs {
            let row = self.inner.run_row(&run.id).await?;
            if row.suite.is_some() {
                self.end(&row).await?;
            }
        }
        Ok(())
    }

    /// What developers brought and is public is measured on the suite, also where the service ended before it was queued.
    pub(super) async fn catch_up_with_the_suite(&self) -> Result<()> {
        if !self.inner.config.featured {
            return Ok(());
        }
        let rows = self.inner.store.submissions().await?;
        let public = rows.iter().filter(|row| row.state == PluginState::Public);
        self.measure_brought(public.flat_map(|row| &row.algorithms)).await
    }

    /// Queues what is missing of these, as far as they are public.
    pub(super) async fn measure_brought(&self, brought: impl Iterator<Item = &AlgorithmInfo>) -> Result<()> {
        let brought: Vec<&str> = brought.map(|algorithm| algorithm.id.as_str()).collect();
        let mut only: Vec<String> = self.inner.public().into_iter().map(|algorithm| algorithm.id).collect();
        only.retain(|id| brought.contains(&id.as_str()));
        if only.is_empty() { Ok(()) } else { self.measure_suite(&only).await.map(drop) }
    }
}

/// Which plugin file of an algorithm has come how far in a scenario; a run that waits takes whatever is there then.
#[derive(Default)]
struct AllKnown(HashMap<[String; 2], Vec<KnownFile>>);

/// The hash of a plugin file, once it is measured, and how far it is.
type KnownFile = (Option<String>, Known);

impl AllKnown {
    fn add(&mut self, spec: &RunSpec, algorithm: &str, file: Option<String>, known: Known) -> Result<()> {
        self.0.entry([scenario(spec)?, algorithm.to_owned()]).or_default().push((file, known));
        Ok(())
    }

    fn of(&self, algorithm: &AlgorithmInfo, spec: &RunSpec) -> Option<Known> {
        let all = self.0.get(&[scenario(spec).ok()?, algorithm.id.clone()])?;
        let same = |file: &Option<String>| file.as_ref().is_none_or(|file| *file == algorithm.plugin_sha256);
        let here = || all.iter().filter(|(file, _)| same(file)).map(|(_, known)| *known);
        here().find(|known| *known == Known::Measured).or_else(|| here().next())
    }
}

fn scenario(spec: &RunSpec) -> Result<String> {
    serde_json::to_string(&scenario_of(spec)).map_err(|e| EngineError::fault("Naming a scenario failed", e))
}

impl Inner {
    /// The algorithms that everybody may ask for, each in its newest version.
    fn public(&self) -> Vec<AlgorithmInfo> {
        let mut all = self.registry.algorithms(None);
        all.retain(|algorithm| !algorithm.id.contains('@'));
        all
    }

    async fn known(&self) -> Result<AllKnown> {
        let mut all = AllKnown::default();
        for row in self.store.suite_runs().await?.iter().filter(|row| row.suite.as_ref() == Some(&self.suite.sha256)) {
            if row.state != State::Done {
                for algorithm in &row.spec.algorithms {
                    all.add(&row.spec, algorithm, None, Known::Waiting)?;
                }
            } else if self.is_of_now(row) {
                for stored in self.store.results(&row.id).await? {
                    // Whose time was over before its first answer is asked again.
                    if stored.result.had_no_time() {
                        continue;
                    }
                    let algorithm = &stored.result.algorithm;
                    all.add(&row.spec, algorithm, Some(stored.plugin_sha256.clone()), Known::Measured)?;
                }
            }
        }
        Ok(all)
    }

    /// Measured on this machine's class, judged by this oracle, in a jail like this.
    fn is_of_now(&self, row: &RunRow) -> bool {
        let here = |machine: &Environment| {
            machine.hardware_class == self.machine.hardware_class && machine.profile == self.registry.profile().as_str()
        };
        row.environment.as_ref().is_some_and(here)
            && row.set.as_ref().is_some_and(|set| set.oracle == Some(ocb_core::oracle::VERSION))
    }
}
