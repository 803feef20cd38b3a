//! Which algorithms there are, and checking a plugin file before it is submitted.

use std::path::Path;

use ocb_lab::check::{Extent, Term, check_plugin};

use crate::engine::Engine;
use crate::measure::Stop;
use crate::model::{AlgorithmInfo, PluginReport};
use crate::{EngineError, Result, boxed};

impl Engine {
    /// All algorithms of all plugins that this viewer may ask for, by id.
    pub fn algorithms(&self, viewer: Option<&str>) -> Vec<AlgorithmInfo> {
        self.inner.registry.algorithms(viewer)
    }

    /// Checks a plugin file: format, loading in the jail, ABI, descriptor, answers on smoke configurations.
    ///
    /// Faults of the plugin are in the report; an error means that the check itself could not be made.
    #[boxed]
    pub async fn check_plugin(&self, file: &Path, extent: Extent) -> Result<PluginReport> {
        let (runner, file) = (self.inner.registry.runner().clone(), file.to_owned());
        // A thread of its own: a jail ends with the thread that started it.
        let (sender, report) = tokio::sync::oneshot::channel();
        let limit = self.inner.config.check_limit;
        std::thread::spawn(move || {
            let stop = Stop::default();
            let term = Term::new(&stop, limit);
            sender.send(check_plugin(&runner, &file, &extent, &term, &mut |_| true))
        });
        let report = report.await.map_err(|_| EngineError::Fault("The plugin check failed.".into()))?;
        Ok(report?)
    }
}
