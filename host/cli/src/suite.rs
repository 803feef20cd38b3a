//! `ocb suite`: the public benchmark, on this machine.

use std::pin::pin;
use std::process::ExitCode;

use futures::StreamExt;
use ocb_core::configuration::Separation;
use ocb_service::Engine;
use ocb_service::model::{BoardRequest, RunInfo, State, SuiteInfo, SuiteProgress};

use crate::args::{Store, SuiteCommand, SuiteRunArgs};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{board, output, plugin, run, serve, units};

/// Shows the suite, or measures what is missing of it.
pub async fn suite(store: &Store, command: &SuiteCommand, json: bool) -> Result<ExitCode> {
    let measures = matches!(command, SuiteCommand::Run(_));
    let engine = open::open(store, if measures { Purpose::Measure } else { Purpose::Look }).await?;
    let done = match command {
        SuiteCommand::Show => show(&engine, json).await,
        SuiteCommand::Run(args) => measure(&engine, args, json).await,
    };
    engine.shutdown().await;
    done
}

async fn show(engine: &Engine, json: bool) -> Result<ExitCode> {
    let suite = engine.suite(None).await?;
    if json {
        output::print_json(&suite)?
    } else {
        output::print(&text(&suite))?
    }
    Ok(ExitCode::SUCCESS)
}

fn text(suite: &SuiteInfo) -> String {
    let scenes: Vec<String> = suite.scenes.iter().map(|[a, b]| format!("{a} x {b}")).collect();
    let separations: Vec<String> = suite.separations.iter().map(separation).collect();
    let queries: Vec<&str> = suite.queries.iter().map(|query| plugin::query_name(*query)).collect();
    let row =
        |p: &SuiteProgress| vec![p.algorithm.clone(), format!("{} of {}", p.measured, p.of), p.waiting.to_string()];
    let rows = suite.progress.iter().map(row).collect();
    [
        format!(
            "Suite {} ({}): {} scenarios of {} configurations, {} processes for each algorithm",
            suite.version,
            &suite.sha256[..12],
            suite.scenarios,
            suite.configurations,
            suite.passes
        ),
        format!("scenes: {}", scenes.join(", ")),
        format!("distances: {}", separations.join(", ")),
        format!("queries: {}", queries.join(", ")),
        format!("here: hardware class {}, oracle {}", suite.hardware_class, suite.oracle),
        output::table(&["algorithm", "measured", "waiting"], rows, &[1, 2]),
    ]
    .join("\n")
}

fn separation(separation: &Separation) -> String {
    match separation {
        Separation::Relative { distance } => format!("relative distance {distance}"),
        Separation::Step { of_size } => format!("step {of_size:e} of S"),
        Separation::Ladder => "ladder of steps".to_owned(),
    }
}

async fn measure(engine: &Engine, args: &SuiteRunArgs, json: bool) -> Result<ExitCode> {
    let stop = serve::stop_signal()?;
    let runs = engine.measure_suite(&args.algorithm).await?;
    let interrupted = tokio::select! {
        watched = watch(engine, &runs) => { watched?; false }
        () = stop => true,
    };
    if interrupted {
        engine.end_suite_runs(&runs).await?;
        eprintln!("ocb: Stopped; finished runs are kept, and `ocb suite run` measures the rest.");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    let request =
        BoardRequest { suite: Some(engine.suite(None).await?.version.to_string()), ..BoardRequest::default() };
    let found = engine.board(&request, Some(OWNER)).await?;
    if json {
        output::print_json(&found)?
    } else {
        output::print(&board::text(&found))?
    }
    let mut well = true;
    for run in runs {
        well &= engine.run(&run.id, Some(OWNER)).await?.state == State::Done;
    }
    Ok(if well { ExitCode::SUCCESS } else { ExitCode::from(NOT_ALL_WELL) })
}

/// Tells of each run when it ends.
async fn watch(engine: &Engine, runs: &[RunInfo]) -> Result<()> {
    eprintln!("{} runs of the suite are missing here", runs.len());
    for (number, run) in (1..).zip(runs) {
        let begun = std::time::Instant::now();
        let mut events = pin!(engine.follow(&run.id, 0).await?);
        while let Some(event) = events.next().await {
            event.map_err(Failure::from)?;
        }
        let ended = engine.run(&run.id, Some(OWNER)).await?;
        eprintln!(
            "{number} of {}: {} x {}, {}, {}: {} after {}",
            runs.len(),
            ended.object_a_name,
            ended.object_b_name,
            plugin::query_name(ended.spec.query),
            ended.spec.algorithms.join(", "),
            run::state_name(ended.state),
            units::wait(begun.elapsed().as_secs_f64()),
        );
    }
    Ok(())
}
