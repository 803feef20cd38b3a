//! The examples of the start page: measured on this machine while the service is idle, never stored pictures.

use std::sync::LazyLock;

use crate::boxed;
use crate::engine::{Engine, Inner};
use crate::idle::sql::{Tried, TriedSet};
use crate::model::{Example, ExampleInfo, RunSpec};
use crate::{EngineError, Result};

static EXAMPLES: LazyLock<Vec<Example>> =
    LazyLock::new(|| serde_json::from_str(include_str!("examples/examples.json")).expect("examples.json is tested"));

impl Engine {
    /// The examples that this service has measured or will measure, each with its run where there is one.
    #[boxed]
    pub async fn examples(&self) -> Result<Vec<ExampleInfo>> {
        let mut all = Vec::new();
        for example in self.inner.possible_examples() {
            let run = match self.inner.store.run_that_tried(&self.inner.as_tried(&example)).await? {
                Some(id) => match self.run(&id, None).await {
                    Ok(run) => Some(run),
                    // It could not be queued, or was deleted.
                    Err(EngineError::NotFound(_)) => continue,
                    Err(e) => return Err(e),
                },
                // Without idle work it never comes.
                None if !self.inner.config.idle => continue,
                None => None,
            };
            all.push(ExampleInfo { example, run });
        }
        Ok(all)
    }
}

impl Inner {
    /// The next example that was not tried on this machine, and its entry in the list of tried work.
    pub(crate) fn next_example(&self, tried: &TriedSet) -> Option<(RunSpec, Tried)> {
        let mut all =
            self.possible_examples().into_iter().map(|example| (example.spec.clone(), self.as_tried(&example)));
        all.find(|(_, entry)| !tried.contains(entry))
    }

    /// Those whose algorithms are installed.
    fn possible_examples(&self) -> Vec<Example> {
        let installed = self.registry.installed();
        let has = |id: &String| installed.iter().any(|algorithm| algorithm.id == *id);
        EXAMPLES.iter().filter(|example| example.spec.algorithms.iter().all(has)).cloned().collect()
    }

    fn as_tried(&self, example: &Example) -> Tried {
        Tried::apart(&format!("example {}, class {}", example.id, self.machine.hardware_class))
    }
}

#[cfg(test)]
mod tests {
    use ocb_core::sampling;

    use super::*;

    #[test]
    fn each_example_can_be_asked_and_shows_an_algorithm_of_its_own() {
        assert_eq!(EXAMPLES.len(), 5);
        for example in EXAMPLES.iter() {
            let spec = &example.spec;
            assert!(spec.algorithms.contains(&example.algorithm), "{example:?}");
            assert!(sampling::count(&spec.method).is_ok() && sampling::check_separation(spec.separation).is_ok());
            assert!(example.title.ends_with('?') && example.text.ends_with('.'), "{example:?}");
        }
    }
}
