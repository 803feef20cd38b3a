//! The run that a visitor sees before asking for anything: measured here, never a canned picture.

use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::query::{Query, Semantics};

use crate::Result;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::RunSpec;
use crate::runs::asking::RunContext;
use crate::runs::priority::BACKGROUND;

/// Configurations of the quick run.
const CONFIGURATIONS: u32 = 2000;
/// Seconds per algorithm: the start page should not stay empty for long.
const BUDGET_SECONDS: f64 = 6.0;

impl Engine {
    /// Queues the quick run when it is wanted and there is none.
    pub(crate) async fn feature_a_run(&self) -> Result<()> {
        let _alone = self.inner.store.locks.alone(Lock::Planning).await?;
        if !self.inner.config.featured || self.inner.store.featured_count().await? > 0 {
            return Ok(());
        }
        let algorithms = self.inner.registry.algorithms(None);
        let answered = |query: &Query| algorithms.iter().any(|a| a.queries.contains(query));
        let Some(query) = [Query::Proximity, Query::CollisionFirst].into_iter().find(answered) else {
            return Ok(());
        };
        let objects = self.inner.objects.stock().await?;
        let wanted = ["stock:bunny", "stock:castle@"];
        let object = wanted.iter().find_map(|id| objects.iter().find(|o| o.id.starts_with(id))).or(objects.first());
        let Some(object) = object else { return Ok(()) };
        let spec = RunSpec {
            object_a: object.id.clone(),
            object_b: None,
            query,
            semantics: Semantics::Surface,
            method: Method::Sphere { sampling: Sampling::Count { count: CONFIGURATIONS }, seed: 0 },
            separation: Separation::Relative { distance: 0.0 },
            algorithms: Vec::new(),
            passes: 3,
            budget_seconds: BUDGET_SECONDS,
            seed: None,
            precision: None,
            at_most: None,
            hardware_class: None,
        };
        self.queue(spec, RunContext { priority: BACKGROUND, featured: true, ..RunContext::default() }).await?;
        Ok(())
    }
}
