//! `ocb bench --workload`: replay what a program asked.

mod text;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use ocb_service::model::{WorkloadResult, WorkloadSpec};
use ocb_service::workload::{Progress, Replayed, workload_parquet};
use ocb_service::{Engine, Recording, Stop};

use crate::args::{BenchArgs, Store};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, Purpose};
use crate::{output, serve};

/// Replays, prints, writes.
pub async fn bench(store: &Store, args: &BenchArgs, file: &Path, json: bool) -> Result<ExitCode> {
    let recording = Arc::new(Recording::read(file)?);
    let spec = spec(args)?;
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file("create the folder", folder, &e))?;
    }
    let engine = open::open(store, Purpose::Look).await?;
    let replayed = replay(&engine, recording.clone(), spec).await;
    engine.shutdown().await;
    let Some(replayed) = replayed? else {
        eprintln!("ocb: Stopped; nothing was kept.");
        return Ok(ExitCode::from(INTERRUPTED));
    };
    if let Some(folder) = &args.out {
        write(folder, &replayed, &recording)?;
    }
    if json {
        output::print_json(&replayed.result)?;
    } else {
        output::print(&text::text(&replayed.result))?;
    }
    Ok(ExitCode::from(if well(&replayed.result) { 0 } else { NOT_ALL_WELL }))
}

fn spec(args: &BenchArgs) -> Result<WorkloadSpec> {
    let tracks = match &args.order[..] {
        [] => WorkloadSpec::default().tracks,
        named => named.iter().map(|order| (*order).into()).collect(),
    };
    let spec = WorkloadSpec {
        algorithms: args.algorithm.clone(),
        tracks,
        passes: args.passes,
        budget_seconds: args.budget,
        seed: args.run_seed,
        reduce: None,
    };
    spec.check().map_err(Failure::Input)?;
    Ok(spec)
}

/// Nothing when interrupted.
pub async fn replay(engine: &Engine, recording: Arc<Recording>, spec: WorkloadSpec) -> Result<Option<Replayed>> {
    let interrupted = serve::stop_signal()?;
    let stop = Stop::default();
    let said = AtomicU64::new(u64::MAX);
    let tell = move |progress: Progress| match progress {
        Progress::Scene { algorithm, process, of } => eprintln!("whole scene: {algorithm}, process {process} of {of}"),
        Progress::Pairs { done, of } => {
            let percent = 100 * done / of.max(1);
            if said.swap(percent, Ordering::Relaxed) != percent {
                eprintln!("{done} of {of} queries");
            }
        }
    };
    let waits = || eprintln!("waiting: another process is measuring on this machine");
    let replayed = engine.replay_workload(recording, spec, stop.clone(), tell, waits);
    tokio::pin!(replayed);
    tokio::select! {
        replayed = &mut replayed => Ok(Some(replayed?)),
        () = interrupted => {
            stop.stop();
            // The jail under way is ended before we leave; that it was stopped is no news.
            let _ = replayed.await;
            Ok(None)
        }
    }
}

fn write(folder: &Path, Replayed { result, rows }: &Replayed, recording: &Recording) -> Result<()> {
    let put = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| Failure::file("write", &path, &e))
    };
    put("workload.json", output::to_json(result)?.as_bytes())?;
    put("queries.parquet", &workload_parquet(rows, &recording.queries)?)
}

/// Every algorithm answered all that it can be asked, and none of it wrongly.
fn well(result: &WorkloadResult) -> bool {
    result.tracks.iter().flat_map(|track| &track.algorithms).all(|algorithm| algorithm.is_fair())
}
