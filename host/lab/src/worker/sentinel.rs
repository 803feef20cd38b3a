//! The sentinel: a short measurement that is the same on every machine and at any time, so that a machine whose times drift is
//! noticed. It is no result of a run.

use std::slice;
use std::sync::Arc;

use ocb_core::statistics::select_quantile;
use ocb_core::stock;
use serde_json::json;

use super::Worker;
use crate::configurations::{Gauge, make};
use crate::measure::{Part, Stop, Task, to_end};
use crate::model::{OrderedAlgorithm, RunSpec};
use crate::pairing::Pairing;
use crate::{LabError, Result};

/// Its object, and the triangles that it has about.
const OBJECT: (&str, u32) = ("torus-knot", 2000);
const CONFIGURATIONS: u32 = 400;

/// What is measured: distances, in five processes with the same order and the same equivalent instances each time.
fn spec() -> Result<RunSpec> {
    let (name, triangles) = OBJECT;
    let spec = json!({
        "object_a": format!("stock:{name}@{triangles}"), "query": "proximity", "passes": 5, "budget_seconds": 20.0, "seed": 1,
        "method": { "kind": "sphere", "seed": 1, "sampling": { "kind": "count", "count": CONFIGURATIONS } },
    });
    serde_json::from_value(spec).map_err(|e| LabError::fault("The sentinel is no run", e))
}

impl Worker {
    /// Nanoseconds that this algorithm, which is installed here, takes for the median query of the sentinel; `None` when stopped. Waits
    /// for the right to measure; `waits` is called once if another process has it.
    ///
    /// # Errors
    /// `Fault` when the algorithm is not installed or does not answer.
    pub fn sentinel(&self, algorithm: &OrderedAlgorithm, stop: &Stop, waits: impl FnOnce()) -> Result<Option<f64>> {
        let missing = || LabError::Fault(format!("{} is not installed on this machine.", algorithm.info.id));
        let file = self.plugins.get(&algorithm.info.plugin_sha256).ok_or_else(missing)?;
        let algorithm = self.with_file(algorithm, file.clone());
        let (spec, algorithms) = (spec()?, slice::from_ref(&algorithm));
        let mesh =
            stock::generate(OBJECT.0, OBJECT.1).ok_or_else(|| LabError::Fault("The sentinel has no object.".into()))?;
        let pairing = Pairing::new(Arc::new(mesh), None);
        let Some(set) = make(&pairing, &spec, None, &Gauge::default(), None)? else { return Ok(None) };
        let task = Task::of(&spec, (&pairing, &set, Part::of(&spec, &set)), algorithms, None);
        let task = Task { seed: spec.seed.unwrap_or_default(), rounds_only: true, ..task };
        let Some(_right) = stop.right_to_measure(waits)? else { return Ok(None) };
        let measured = to_end(&task, &self.runner, &self.machine, stop)?;
        let Some((_, measured)) = measured.and_then(|mut all| all.pop()) else { return Ok(None) };
        if let Some(outcome) = &measured.outcome {
            return Err(LabError::Fault(format!("{} does not answer. {}", algorithm.info.id, outcome.message)));
        }
        let of_each = measured.times.iter().filter(|times| !times.is_empty());
        let median =
            |times: &Vec<(u32, f64)>| select_quantile(&mut times.iter().map(|(_, ns)| *ns).collect::<Vec<_>>(), 0.5);
        let mut medians: Vec<f64> = of_each.map(median).collect();
        if medians.len() < CONFIGURATIONS as usize / 2 {
            return Err(LabError::Fault(format!("{} answers too slowly.", algorithm.info.id)));
        }
        Ok(Some(select_quantile(&mut medians, 0.5)))
    }
}
