//! `ocb bench`: from two files to a table.

mod builds;
mod by_unit;
mod files;
mod progress;
pub mod spec;
pub mod table;
mod verdict;

use std::path::Path;
use std::pin::pin;
use std::process::ExitCode;
use std::time::Duration;

use futures::StreamExt;
use ocb_service::Engine;
use ocb_service::model::{RunInfo, State};

use crate::args::{BenchArgs, Store};
use crate::failure::{Failure, INTERRUPTED, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{output, serve, units, workload};
use progress::Progress;

/// How long a cancelled run may take to end its runner.
const CANCEL_PATIENCE: Duration = Duration::from_secs(20);

/// Measures, prints, writes.
pub async fn bench(store: &Store, args: &BenchArgs, json: bool) -> Result<ExitCode> {
    if let Some(recording) = &args.workload {
        return workload::bench(store, args, recording, json).await;
    }
    // Everything that can be refused without the store is refused before it is opened.
    let inputs = spec::Inputs::read(args)?;
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file("create the folder", folder, &e))?;
    }
    let done = match open::open(store, Purpose::Measure).await {
        Ok(engine) => {
            let done = measure(&engine, args, inputs, json).await;
            engine.shutdown().await;
            done
        }
        Err(failure) => Err(failure),
    };
    if let (Err(_), Some(folder)) = (&done, &args.out) {
        // Nothing stays of what was refused: this removes an empty folder only.
        let _ = std::fs::remove_dir(folder);
    }
    done
}

async fn measure(engine: &Engine, args: &BenchArgs, inputs: spec::Inputs, json: bool) -> Result<ExitCode> {
    let stop = serve::stop_signal()?;
    let spec = inputs.into_spec(engine, args).await?;
    let estimate = engine.estimate(&spec, Some(OWNER)).await?;
    let expected = units::wait(estimate.total_seconds + estimate.wait_seconds);
    let at_most = if spec.precision.is_some() { "at most " } else { "" };
    eprintln!("{at_most}{} configurations, {at_most}about {expected}", estimate.configurations);
    let run = engine.submit(spec, Some(OWNER)).await?;
    to_its_end(engine, run, args.out.as_deref(), stop, json).await
}

/// Watches a run to its end; prints and writes what it found.
pub async fn to_its_end(
    engine: &Engine,
    run: RunInfo,
    out: Option<&Path>,
    stop: impl Future<Output = ()>,
    json: bool,
) -> Result<ExitCode> {
    let (run, interrupted) = follow(engine, run, stop).await?;
    if interrupted {
        eprintln!("ocb: Stopped; the run {} is {}.", run.id, crate::run::state_name(run.state));
        return Ok(ExitCode::from(INTERRUPTED));
    }
    let written = match out {
        Some(folder) => files::write(engine, &run, folder).await?,
        None => Vec::new(),
    };
    if json {
        output::print_json(&run)?;
    } else {
        output::print(&table::summary(&run))?;
        for file in written {
            output::print(&file.display().to_string())?;
        }
    }
    if run.state != State::Done {
        let message = run.message.as_deref().unwrap_or("it did not finish.");
        eprintln!("ocb: The run {} is {}: {message}", run.id, crate::run::state_name(run.state));
    }
    Ok(ExitCode::from(verdict::exit_code(&run)))
}

/// Watches the run to its end, or to ours.
async fn follow(engine: &Engine, run: RunInfo, stop: impl Future<Output = ()>) -> Result<(RunInfo, bool)> {
    let mut progress = Progress::new(&run);
    let watch = async {
        let mut events = pin!(engine.follow(&run.id, 0).await?);
        while let Some(event) = events.next().await {
            progress.show(&event?);
        }
        Ok::<(), Failure>(())
    };
    let interrupted = tokio::select! {
        watched = watch => { watched?; false }
        () = stop => true,
    };
    progress.finish();
    if interrupted {
        cancel(engine, &run.id).await?;
    }
    Ok((engine.run(&run.id, Some(OWNER)).await?, interrupted))
}

async fn cancel(engine: &Engine, id: &str) -> Result<()> {
    engine.cancel(id, Some(OWNER)).await?;
    let ended = async {
        let mut events = pin!(engine.follow(id, 0).await?);
        while let Some(event) = events.next().await {
            event?;
        }
        Ok::<(), Failure>(())
    };
    // A runner that would not end is killed by the shutdown that follows.
    tokio::time::timeout(CANCEL_PATIENCE, ended).await.unwrap_or(Ok(()))
}
