//! Orders: what a measuring machine is told of a run, and the log of each run that is measured elsewhere.

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use ocb_lab::algorithm::Algorithm;
use tokio::runtime::Handle;

use super::runner_hash;
use crate::attempts::Attempt;
use crate::engine::Inner;
use crate::model::{Draw, OrderedAlgorithm, WorkOrder};
use crate::runs::log::RunLog;
use crate::runs::sql::RunRow;
use crate::runs::{draw, spec};
use crate::{EngineError, Result};

/// The logs of runs that machines measure now, by attempt. One that this process does not know is made anew from the database.
#[derive(Default)]
pub struct Orders {
    logs: Mutex<HashMap<String, Arc<Mutex<RunLog>>>>,
    runner: OnceLock<Option<String>>,
}

impl Orders {
    /// SHA-256 of the runner's file.
    pub fn runner(&self, program: &Path) -> Option<String> {
        self.runner.get_or_init(|| runner_hash(program)).clone()
    }

    /// The log of this attempt; blocks.
    pub fn log(&self, inner: &Inner, attempt: &Attempt, row: &RunRow, handle: &Handle) -> Result<Arc<Mutex<RunLog>>> {
        let mut logs = self.logs.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(log) = logs.get(&attempt.id) {
            return Ok(log.clone());
        }
        let told = (inner.store.clone(), inner.run_events.clone(), inner.under_way.clone());
        let log = RunLog::go_on(attempt, &row.spec.algorithms, told, handle.clone())?;
        let log = Arc::new(Mutex::new(log));
        logs.insert(attempt.id.clone(), log.clone());
        Ok(log)
    }

    /// The attempt has ended.
    pub fn forget(&self, attempt: &str) {
        self.logs.lock().unwrap_or_else(PoisonError::into_inner).remove(attempt);
    }
}

/// The seed of a prepared run, and how it came about.
pub fn draw_of(inner: &Inner, row: &RunRow) -> Result<Draw> {
    let unprepared = || EngineError::Fault(format!("The run {} has no stored configurations.", row.id));
    let set = row.set.as_ref().ok_or_else(unprepared)?;
    Ok(draw::drawn(row, draw::seed(row, &set.sha256, &inner.algorithms_of(row)?)))
}

/// What a machine is told of this run.
pub async fn order(inner: &Inner, attempt: &Attempt, row: &RunRow) -> Result<WorkOrder> {
    let draw = Draw { secret: None, ..draw_of(inner, row)? };
    let mesh_a = inner.objects.mesh(row.object_a()).await?.sha256();
    let mesh_b = match &row.spec.object_b {
        Some(id) => Some(inner.objects.mesh(id).await?.sha256()),
        None => None,
    };
    Ok(WorkOrder {
        attempt: attempt.id.clone(),
        run: row.id.clone(),
        spec: row.spec.clone(),
        mesh_a,
        mesh_b,
        set: row.set.clone().ok_or_else(|| EngineError::Fault("A prepared run has no set.".into()))?,
        draw,
        algorithms: inner.algorithms_of(row)?.iter().map(|it| ordered(it)).collect(),
        reference: spec::reference(&row.spec, &inner.registry).map(|it| ordered(&it)),
        most_seconds: inner.longest_run(row).map(|longest| longest.as_secs_f64()),
    })
}

fn ordered(algorithm: &Algorithm) -> OrderedAlgorithm {
    OrderedAlgorithm {
        info: algorithm.info.clone(),
        id_in_plugin: algorithm.id_in_plugin.clone(),
        settings: algorithm.settings.clone(),
        threads: algorithm.threads,
    }
}
