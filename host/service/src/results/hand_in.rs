//! Handing in what a run has measured, wherever that was: files in the store, and what the first look at the run needs.

use ocb_lab::job::{Found, Results as Measured};

use super::Results;
use super::sql::StoredResult;
use crate::Result;
use crate::locks::Keeping;
use crate::model::{AlgorithmResult, State};
use crate::runs::accept::{End, Handed};
use crate::runs::log::{FIRST_MEASURING, RunLog};
use crate::runs::sql::RunRow;

impl Results {
    /// Stores the files of the results, and prepares what the first look at the run needs. The run fails only when there is nothing
    /// to show at all.
    pub fn hand_in(&self, log: &mut RunLog, row: &RunRow, measured: Measured) -> Result<End> {
        let keeping: Keeping = log.wait(self.store.locks.keeping())?;
        let Measured { algorithms, environment, preview } = measured;
        let (mut nothing, mut any, mut kept) = (None, false, Vec::new());
        for (place, found) in algorithms.into_iter().enumerate() {
            let stored = self.keep_files(log, found)?;
            any |= stored.result.n > 0;
            nothing.get_or_insert_with(|| stored.result.outcome.message.clone());
            end_stage(log, FIRST_MEASURING + place, &stored.result)?;
            kept.push((place, stored));
        }
        // The outcomes are for the visitor and name no paths.
        let failed = nothing.filter(|_| !any).map(|cause| format!("No algorithm could be measured. {cause}"));
        let mut triangles = 0;
        for object in [row.object_a(), row.object_b()] {
            triangles += log.wait(self.objects.mesh(object))?.triangles().len() as u64;
        }
        let handed = Handed { results: kept, triangles, query: row.spec.query, environment, preview, failed };
        if handed.failed.is_none() {
            self.prepare_heatmaps(log, row, &handed)?;
        }
        Ok(End::Done { handed: Box::new(handed), _keeping: keeping })
    }

    /// Stores records and tests per triangle of one algorithm.
    fn keep_files(&self, log: &RunLog, found: Found) -> Result<StoredResult> {
        let keep = |bytes: Vec<u8>| -> Result<String> {
            let length = bytes.len();
            let blob = log.wait(self.blobs.put(bytes))?;
            log.wait(self.store.add_blob(&blob, length, "application/vnd.apache.parquet"))?;
            Ok(blob)
        };
        Ok(StoredResult {
            records: found.records.map(keep).transpose()?,
            triangle_tests: found.triangle_tests.map(keep).transpose()?,
            result: found.result,
            plugin_sha256: found.plugin_sha256,
            seconds_per_query: found.seconds_per_query,
        })
    }

    fn prepare_heatmaps(&self, log: &mut RunLog, row: &RunRow, handed: &Handed) -> Result<()> {
        let stage = FIRST_MEASURING + row.spec.algorithms.len();
        let row = log.wait(self.store.run_row(&row.id))?;
        let records: Vec<&String> = handed.results.iter().filter_map(|(_, stored)| stored.records.as_ref()).collect();
        let total = records.len() as u64;
        log.start(stage, total)?;
        log.wait(self.prepare_maps(&row))?;
        for (done, records) in (1..).zip(records) {
            log.wait(self.records_of(records))?;
            log.progress(stage, done, total)?;
        }
        log.end(stage, State::Done, None)
    }
}

fn end_stage(log: &mut RunLog, stage: usize, result: &AlgorithmResult) -> Result<()> {
    let failed = !result.outcome.completed();
    let message = if failed {
        Some(result.outcome.message.clone())
    } else {
        result
            .budget_limited
            .then(|| format!("The time limit was reached after {} of {} configurations.", result.n, result.of))
    };
    let state = if failed { State::Failed } else { State::Done };
    log.end(stage, state, message)
}
