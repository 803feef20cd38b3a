//! What a run's measuring is told and hands in, wherever it was measured: steps in its log, files in the store.

use ocb_lab::job::{Found, Results, Step};

use crate::Result;
use crate::blobs::Blobs;
use crate::engine::Inner;
use crate::locks::Keeping;
use crate::model::{AlgorithmResult, State};
use crate::results::{self, sql::StoredResult};
use crate::runs::accept::{End, Handed};
use crate::runs::log::{FIRST_MEASURING, RunLog};
use crate::runs::sql::RunRow;
use crate::store::Store;

/// Notes a step in the run's log; `reference` is the name of the reference algorithm.
pub fn tell(log: &mut RunLog, step: &Step, reference: &str) -> Result<()> {
    match *step {
        // It was told before, and arrives late.
        Step::Progress { place, .. } if log.has_ended(FIRST_MEASURING + place.min(log.algorithms() - 1)) => Ok(()),
        Step::Waiting(_) if log.has_ended(FIRST_MEASURING) => Ok(()),
        Step::Waiting(waiting) => {
            log.note(FIRST_MEASURING, waiting.then_some("Waiting: another process is measuring on this machine."))
        }
        Step::Progress { place, done, total, worked } if place < log.algorithms() => {
            // The reference has no stage of its own unless it was requested; the first such stage says that it is at work.
            if log.has_note(FIRST_MEASURING) {
                log.note(FIRST_MEASURING, None)?;
            }
            log.progress_after(FIRST_MEASURING + place, done, total, worked)
        }
        Step::Progress { done, total, .. } => {
            log.note(FIRST_MEASURING, Some(&turn_of_reference(reference, done, total)))
        }
        Step::Preliminary(..) => Ok(()),
    }
}

/// Stores the files of the results, and prepares what the first look at the run needs. The run fails only when there is nothing to
/// show at all.
pub fn keep(inner: &Inner, log: &mut RunLog, row: &RunRow, results: Results) -> Result<End> {
    let keeping: Keeping = log.wait(inner.store.locks.keeping())?;
    let Results { algorithms, environment, preview } = results;
    let (mut nothing, mut any, mut kept) = (None, false, Vec::new());
    for (place, found) in algorithms.into_iter().enumerate() {
        let stored = keep_files(&inner.store, &inner.blobs, log, found)?;
        any |= stored.result.n > 0;
        nothing.get_or_insert_with(|| stored.result.outcome.message.clone());
        end_stage(log, FIRST_MEASURING + place, &stored.result)?;
        kept.push((place, stored));
    }
    // The outcomes are for the visitor and name no paths.
    let failed = nothing.filter(|_| !any).map(|cause| format!("No algorithm could be measured. {cause}"));
    let mut triangles = 0;
    for object in [row.object_a(), row.object_b()] {
        triangles += log.wait(inner.objects.mesh(object))?.triangles().len() as u64;
    }
    let handed = Handed { results: kept, triangles, query: row.spec.query, environment, preview, failed };
    if handed.failed.is_none() {
        heatmaps(&inner.store, &inner.results, log, row, &handed)?;
    }
    Ok(End::Done { handed: Box::new(handed), _keeping: keeping })
}

/// Stores records and tests per triangle of one algorithm.
fn keep_files(store: &Store, blobs: &Blobs, log: &RunLog, found: Found) -> Result<StoredResult> {
    let keep = |bytes: Vec<u8>| -> Result<String> {
        let length = bytes.len();
        let blob = log.wait(blobs.put(bytes))?;
        log.wait(store.add_blob(&blob, length, "application/vnd.apache.parquet"))?;
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

fn heatmaps(store: &Store, results: &results::Results, log: &mut RunLog, row: &RunRow, handed: &Handed) -> Result<()> {
    let stage = FIRST_MEASURING + row.spec.algorithms.len();
    let row = log.wait(store.run_row(&row.id))?;
    let records: Vec<&String> = handed.results.iter().filter_map(|(_, stored)| stored.records.as_ref()).collect();
    let total = records.len() as u64;
    log.start(stage, total)?;
    log.wait(results.prepare_maps(&row))?;
    for (done, records) in (1..).zip(records) {
        log.wait(results.records_of(records))?;
        log.progress(stage, done, total)?;
    }
    log.end(stage, State::Done, None)
}

/// What is said while the reference algorithm, for which nobody asked, has its turn.
fn turn_of_reference(name: &str, done: u64, total: u64) -> String {
    let of = if total > 0 { format!(" of {total}") } else { String::new() };
    format!("Now the reference algorithm, {name}: {done}{of} queries.")
}
