//! `ocb run`: what was measured.

use std::path::Path;
use std::process::ExitCode;

use ocb_service::model::{Page, RunInfo, State};
use ocb_service::{Engine, EngineError};

use crate::args::{RunCommand, Store};
use crate::failure::{Failure, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{bench, output, plugin, serve, units};

/// Lists, shows, refines or packs.
pub async fn run(store: &Store, command: &RunCommand, json: bool) -> Result<ExitCode> {
    let refines = matches!(command, RunCommand::Refine { .. });
    let engine = open::open(store, if refines { Purpose::Measure } else { Purpose::Look }).await?;
    let done = match command {
        RunCommand::List => list(&engine, json).await.map(|()| ExitCode::SUCCESS),
        RunCommand::Show { run } => show(&engine, run, json).await.map(|()| ExitCode::SUCCESS),
        RunCommand::Refine { run } => refine(&engine, run, json).await,
        RunCommand::Repro { run, output } => repro(&engine, run, output, json).await.map(|()| ExitCode::SUCCESS),
    };
    engine.shutdown().await;
    done
}

async fn refine(engine: &Engine, id: &str, json: bool) -> Result<ExitCode> {
    let stop = serve::stop_signal()?;
    let run = find(engine, id).await?;
    let run = engine.refine(&run.id, Some(OWNER)).await?;
    bench::to_its_end(engine, run, None, stop, json).await
}

async fn list(engine: &Engine, json: bool) -> Result<()> {
    let (mut runs, mut page) = (Vec::new(), Page::default());
    loop {
        let part = engine.runs(OWNER, &page).await?;
        runs.extend(part.entries);
        let Some(next) = part.next else { break };
        page = page.behind(&next);
    }
    if json {
        return output::print_json(&runs);
    }
    if runs.is_empty() {
        return output::print("No runs yet; `ocb bench stock:torus-knot` makes one.");
    }
    let row = |run: &RunInfo| {
        let algorithms: Vec<&str> = run.results.iter().map(|result| result.algorithm.as_str()).collect();
        let count = match (&run.preview, &run.set) {
            (Some(preview), _) => format!("{} of {} (preview)", preview.n, preview.of),
            (None, Some(set)) => set.configurations.to_string(),
            (None, None) => String::new(),
        };
        let pair = format!("{} x {}", run.object_a_name, run.object_b_name);
        let query = plugin::query_name(run.spec.query).to_owned();
        vec![run.id.clone(), state_name(run.state).to_owned(), pair, query, count, algorithms.join(", ")]
    };
    let headings = ["run", "state", "objects", "query", "configurations", "algorithms"];
    output::print(&output::table(&headings, runs.iter().map(row).collect(), &[4]))
}

async fn show(engine: &Engine, id: &str, json: bool) -> Result<()> {
    let run = find(engine, id).await?;
    if json { output::print_json(&run) } else { output::print(&bench::table::summary(&run)) }
}

async fn repro(engine: &Engine, id: &str, path: &Path, json: bool) -> Result<()> {
    let run = find(engine, id).await?;
    let mut packed = engine.repro(&run.id).await?;
    let unwritten = |e| Failure::file("write", path, &e);
    let mut file = std::fs::File::create(path).map_err(unwritten)?;
    let bytes = std::io::copy(&mut packed, &mut file).map_err(unwritten)?;
    if json {
        return output::print_json(&serde_json::json!({ "run": run.id, "file": path, "bytes": bytes }));
    }
    output::print(&format!("{} ({}); `ocb replay {0}` repeats the run", path.display(), units::bytes(bytes)))
}

/// The run of that id; `latest` is the newest of the command line.
pub async fn find(engine: &Engine, id: &str) -> Result<RunInfo> {
    if id != "latest" {
        return Ok(engine.run(id, Some(OWNER)).await?);
    }
    let newest = engine.runs(OWNER, &Page { limit: 1, cursor: None }).await?.entries.into_iter().next();
    let none = || EngineError::NotFound("There is no run yet; `ocb bench stock:torus-knot` makes one.".to_owned());
    Ok(newest.ok_or_else(none)?)
}

/// A state in words.
pub fn state_name(state: State) -> &'static str {
    match state {
        State::Queued => "queued",
        State::Running => "running",
        State::Done => "done",
        State::Failed => "failed",
        State::Cancelled => "cancelled",
    }
}
