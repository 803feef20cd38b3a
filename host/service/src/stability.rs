//! Where methods fail.

mod errands;
mod runs;
pub mod runs_sql;
pub mod sql;
pub mod work;

use crate::boxed;
use crate::engine::Engine;
use crate::measure::Stop;
use crate::model::{Stability, StabilityTable};
use crate::{EngineError, Result};
use ocb_lab::LabError;
use ocb_lab::stability::{self, Selection};

impl Engine {
    /// All families, relations and reported failures, with the newest result of every method that was tried.
    #[boxed]
    pub async fn stability(&self) -> Result<StabilityTable> {
        Ok(StabilityTable { methods: self.inner.store.stability().await?, ..stability::table() })
    }

    /// Tries one algorithm, by its name with settings; `at` hears which part is begun. A whole run is kept for the tables.
    pub async fn try_stability(
        &self,
        algorithm: &str,
        selection: Selection,
        stop: Stop,
        at: impl Fn(&str) + Send + 'static,
    ) -> Result<Stability> {
        selection.check()?;
        let algorithm = self.inner.registry.named(algorithm, None)?;
        let whole = selection.parts.is_empty() && selection.at.is_none() && selection.seed.is_none();
        let (registry, machine) = (self.inner.registry.clone(), self.inner.machine.clone());
        // A thread of its own: a jail ends with the thread that started it.
        let (sender, found) = tokio::sync::oneshot::channel();
        std::thread::spawn(move || {
            let right = stop.right_to_measure(|| at("waiting: another process is measuring on this machine"));
            let tried = right
                .and_then(|right| right.ok_or(LabError::Stopped))
                .and_then(|_right| stability::run(registry.runner(), &machine, &algorithm, &selection, &stop, &at));
            // Who asked may have gone.
            drop(sender.send(tried));
        });
        let found = found.await.map_err(|_| EngineError::Fault("The stability run failed.".into()))??;
        if whole {
            self.inner.store.keep_stability(&found).await?;
        }
        Ok(found)
    }
}
