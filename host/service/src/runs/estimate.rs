//! What a run would cost, from what earlier ones did.

use ocb_lab::algorithm::Algorithm;

use crate::configurations::set_key;
use crate::engine::Engine;
use crate::measure::{self, Cost};
use crate::model::{AlgorithmSeconds, Estimate, RunSpec};
use crate::runs::asking::Runs;
use crate::runs::priority::INTERACTIVE;
use crate::runs::spec;
use crate::runs::spec::Checked;
use crate::store::now_us;
use crate::{EngineError, Result, boxed};

/// Seconds per configuration before anything was found on this machine.
const FIRST_CONFIGURATION: f64 = 2e-3;
/// Seconds per query before an algorithm was measured.
const FIRST_QUERY: f64 = 1e-4;
/// Starting a runner and building both structures, per pass.
const START: f64 = 0.5;

impl Engine {
    /// Number of configurations, expected time and wait of a run that is not asked for yet; checks the spec as `submit`.
    #[boxed]
    pub async fn estimate(&self, spec: &RunSpec, viewer: Option<&str>) -> Result<Estimate> {
        let runs = &self.inner.runs;
        runs.estimate(&runs.check(spec, viewer).await?).await
    }

    /// The same for a visitor, with what their limits say of it.
    #[boxed]
    pub async fn estimate_for(&self, spec: &RunSpec, owner: &str) -> Result<Estimate> {
        let runs = &self.inner.runs;
        let checked = runs.check(spec, Some(owner)).await?;
        let expected = runs.estimate(&checked).await?;
        match runs.ceilings.may_be_asked_for(owner, &checked.spec, expected.total_seconds) {
            Ok(()) => Ok(expected),
            Err(EngineError::Invalid(why)) => Ok(Estimate { refused: Some(why), ..expected }),
            Err(e) => Err(e),
        }
    }
}

impl Runs {
    /// What a spec asks for, if it can be measured here.
    pub async fn check(&self, spec: &RunSpec, viewer: Option<&str>) -> Result<Checked> {
        self.classes.measures_on(spec.hardware_class.as_deref())?;
        spec::check(spec, &self.objects, &self.registry, &self.store, &self.blobs, viewer).await
    }

    /// Expected numbers of a checked request, and of what would be before it in the queue.
    async fn estimate(&self, checked: &Checked) -> Result<Estimate> {
        let (runs_ahead, wait_seconds) = self.queue_ahead(&checked.spec).await?;
        Ok(Estimate { runs_ahead, wait_seconds, ..self.estimate_alone(checked).await? })
    }

    /// Expected numbers of a checked request, as if nothing waited.
    pub async fn estimate_alone(&self, checked: &Checked) -> Result<Estimate> {
        let spec = &checked.spec;
        let triangles = u64::from(checked.object_a.triangles) + u64::from(checked.object_b.triangles);
        let key = set_key(&checked.object_a.sha256, &checked.object_b.sha256, spec)?;
        let stored = self.store.set(&key).await?;
        let configurations = stored.as_ref().map_or(checked.configurations, |s| u64::from(s.info.configurations));
        let configurations_stored = stored.is_some();
        let configuration_seconds = match stored {
            Some(_) => 0.0,
            None => configurations as f64 * nearest(&self.store.set_rates().await?, triangles, FIRST_CONFIGURATION),
        };
        let measured = configurations.min(spec.at_most.map_or(u64::MAX, u64::from));
        let cost = |algorithm: &Algorithm, counted: bool, rates: &[(u64, f64)]| {
            let query = nearest(rates, triangles, FIRST_QUERY);
            let Cost { seconds, budget_limited } =
                measure::cost(measured, spec.passes, spec.budget_seconds, counted, query, START);
            AlgorithmSeconds { algorithm: algorithm.info.id.clone(), seconds, budget_limited }
        };
        let class = self.classes.waiting_for(spec);
        let mut measuring_seconds = Vec::new();
        for algorithm in &checked.algorithms {
            let rates = self.store.result_rates(&algorithm.info.id, spec.query, &class).await?;
            measuring_seconds.push(cost(algorithm, algorithm.info.counters, &rates));
        }
        // It takes part in every round, whether it was asked for or not.
        let reference = spec::reference(spec, &self.registry).filter(|it| !spec.algorithms.contains(&it.info.id));
        let reference_seconds = match reference {
            Some(it) => cost(&it, false, &self.store.result_rates(&it.info.id, spec.query, &class).await?).seconds,
            None => 0.0,
        };
        let total_seconds =
            configuration_seconds + measuring_seconds.iter().map(|m| m.seconds).sum::<f64>() + reference_seconds;
        Ok(Estimate {
            configurations,
            configurations_stored,
            configuration_seconds,
            measuring_seconds,
            total_seconds,
            runs_ahead: 0,
            wait_seconds: 0.0,
            refused: None,
        })
    }

    /// Runs ahead of such an interactive one that is asked for now, and the seconds until they are done.
    async fn queue_ahead(&self, spec: &RunSpec) -> Result<(u32, f64)> {
        let class = self.classes.waiting_for(spec);
        let running = self.store.running(&class).await?;
        let (ahead, seconds) = self.store.waiting(INTERACTIVE, &class).await?;
        let left = |(started_us, expected): &(i64, f64)| (expected - (now_us() - started_us) as f64 / 1e6).max(1.0);
        Ok((running.len() as u32 + ahead, running.iter().map(left).sum::<f64>() + seconds))
    }
}

/// The rate seen with the most similar number of triangles. Rates are not scaled: how an algorithm grows with its
/// objects is what the benchmark is there to find out.
fn nearest(rates: &[(u64, f64)], triangles: u64, otherwise: f64) -> f64 {
    let distance = |seen: u64| ((seen.max(1) as f64) / (triangles.max(1) as f64)).ln().abs();
    rates.iter().min_by(|x, y| distance(x.0).total_cmp(&distance(y.0))).map_or(otherwise, |rate| rate.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_similar_size_tells_the_rate() {
        let rates = [(100, 1.0), (10_000, 2.0), (1_000_000, 3.0)];
        assert_eq!(nearest(&rates, 9_000, 9.0), 2.0);
        assert_eq!(nearest(&rates, 1, 9.0), 1.0);
        assert_eq!(nearest(&[], 1, 9.0), 9.0);
    }
}
