//! The examples of the start page: measured on this machine while the service is idle, never stored pictures.

use std::path::Path;
use std::sync::LazyLock;

use crate::boxed;
use crate::engine::Engine;
use crate::idle::sql::{Tried, TriedSet};
use crate::model::{Example, ExampleInfo, ExampleWork};
use crate::plugins::registry::Registry;
use crate::{EngineError, Result};

static EXAMPLES: LazyLock<Vec<Example>> =
    LazyLock::new(|| serde_json::from_str(include_str!("examples/examples.json")).expect("examples.json is tested"));

impl Engine {
    /// The examples that this service has measured or will measure, each with its run where there is one.
    #[boxed]
    pub async fn examples(&self) -> Result<Vec<ExampleInfo>> {
        let (store, config) = (&self.inner.store, &self.inner.config);
        let mut all = Vec::new();
        for example in possible_examples(&self.inner.registry, &config.advisor) {
            match store.run_that_tried(&as_tried(&self.inner.machine.hardware_class, &example)).await? {
                Some(id) => match self.found(example, &id).await {
                    Ok(found) => all.push(found),
                    // It could not be queued, or was deleted.
                    Err(EngineError::NotFound(_)) => {}
                    Err(e) => return Err(e),
                },
                // Without idle work it never comes.
                None if !config.idle => {}
                None => all.push(ExampleInfo { example, run: None, advice: None }),
            }
        }
        Ok(all)
    }

    async fn found(&self, example: Example, id: &str) -> Result<ExampleInfo> {
        let (mut run, mut advice) = (None, None);
        match example.work {
            ExampleWork::Run { .. } => run = Some(self.run(id, None).await?),
            ExampleWork::Advice { .. } => advice = Some(self.advice(id).await?),
        }
        Ok(ExampleInfo { example, run, advice })
    }
}

/// The next example that was not tried on this machine, and its entry in the list of tried work. Advice takes longer than
/// runs, and comes after them.
pub fn next_example(
    registry: &Registry,
    advisor: &Path,
    hardware_class: &str,
    tried: &TriedSet,
) -> Option<(ExampleWork, Tried)> {
    let all = possible_examples(registry, advisor)
        .into_iter()
        .map(|example| (as_tried(hardware_class, &example), example.work));
    let (runs, advice): (Vec<_>, Vec<_>) =
        all.filter(|(entry, _)| !tried.contains(entry)).partition(|(_, work)| matches!(work, ExampleWork::Run { .. }));
    runs.into_iter().chain(advice).next().map(|(entry, work)| (work, entry))
}

/// Those whose algorithms are installed, or the advisor's program.
fn possible_examples(registry: &Registry, advisor: &Path) -> Vec<Example> {
    let installed = registry.installed();
    let has = |id: &String| installed.iter().any(|algorithm| algorithm.id == *id);
    let possible = |example: &&Example| match &example.work {
        ExampleWork::Run { spec, .. } => spec.algorithms.iter().all(has),
        ExampleWork::Advice { .. } => advisor.exists(),
    };
    EXAMPLES.iter().filter(possible).cloned().collect()
}

fn as_tried(hardware_class: &str, example: &Example) -> Tried {
    Tried::apart(&format!("example {}, class {hardware_class}", example.id))
}

#[cfg(test)]
mod tests {
    use ocb_core::sampling;

    use super::*;

    #[test]
    fn each_example_can_be_asked_and_shows_an_algorithm_of_its_own() {
        assert_eq!(EXAMPLES.len(), 5);
        for example in EXAMPLES.iter() {
            if let ExampleWork::Run { algorithm, spec, .. } = &example.work {
                assert!(spec.algorithms.contains(algorithm), "{example:?}");
                assert!(sampling::count(&spec.method).is_ok() && sampling::check_separation(spec.separation).is_ok());
            }
            assert!(example.title.ends_with('?') && example.text.ends_with('.'), "{example:?}");
        }
    }
}
