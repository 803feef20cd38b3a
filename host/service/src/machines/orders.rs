//! What a measuring machine is told of a run.

use ocb_lab::algorithm::Algorithm;

use super::under_way::Orders;
use crate::attempts::Attempt;
use crate::model::{Draw, OrderedAlgorithm, WorkOrder};
use crate::runs::sql::RunRow;
use crate::runs::{draw, looking, spec};
use crate::suite::drawn_anew;
use crate::{EngineError, Result};

impl Orders {
    /// What a machine is told of this run; nothing when it must be prepared again, because its configurations were drawn for other
    /// plugin files.
    pub async fn order(&self, attempt: &Attempt, row: &RunRow) -> Result<Option<WorkOrder>> {
        let algorithms = self.live.registry.algorithms_of(row)?;
        let suite = &self.suite;
        if suite.document.seed.is_none()
            && row.suite.as_ref() == Some(&suite.sha256)
            && row.spec != drawn_anew(&row.spec, draw::configurations(row, &algorithms))
        {
            return Ok(None);
        }
        let unprepared = || EngineError::Fault(format!("The prepared run {} has no set.", row.id));
        let set = row.set.clone().ok_or_else(unprepared)?;
        let draw = Draw { secret: None, ..draw::drawn(row, draw::seed(row, &set.sha256, &algorithms)) };
        let mesh_a = self.objects.mesh(row.object_a()).await?.sha256();
        let mesh_b = match &row.spec.object_b {
            Some(id) => Some(self.objects.mesh(id).await?.sha256()),
            None => None,
        };
        // What preparing took is a part of its time.
        let most_seconds = match self.ceilings.longest_run(row) {
            Some(longest) => {
                Some((longest.as_secs_f64() - self.live.store.prepared_in_seconds(&row.id).await?).max(0.0))
            }
            None => None,
        };
        Ok(Some(WorkOrder {
            attempt: attempt.id.clone(),
            run: row.id.clone(),
            spec: row.spec.clone(),
            mesh_a,
            mesh_b,
            set,
            draw,
            algorithms: algorithms.iter().map(|it| ordered(it)).collect(),
            reference: spec::reference(&row.spec, &self.live.registry).map(|it| ordered(&it)),
            look: looking::seed(row, &algorithms),
            most_seconds,
        }))
    }
}

/// The algorithm without its file.
pub fn ordered(algorithm: &Algorithm) -> OrderedAlgorithm {
    OrderedAlgorithm {
        info: algorithm.info.clone(),
        id_in_plugin: algorithm.id_in_plugin.clone(),
        settings: algorithm.settings.clone(),
        threads: algorithm.threads,
    }
}
