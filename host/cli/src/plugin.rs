//! `ocb plugin`: what is offered, and whether a file may be.

use std::path::Path;
use std::process::ExitCode;

use ocb_core::query::Query;
use ocb_engine::model::{AlgorithmInfo, CheckVerdict, PluginReport};

use crate::args::{PluginCommand, Store};
use crate::failure::{BAD_INPUT, Result};
use crate::{open, output};

/// Lists or checks.
pub async fn plugin(store: &Store, command: &PluginCommand, json: bool) -> Result<ExitCode> {
    match command {
        PluginCommand::List => list(store, json).await,
        PluginCommand::Check { file } => check(store, file, json).await,
    }
}

async fn list(store: &Store, json: bool) -> Result<ExitCode> {
    let (engine, _folder) = open::open_aside(store).await?;
    let algorithms = engine.algorithms();
    let problems = engine.status().await?.problems;
    engine.shutdown().await;
    for problem in &problems {
        eprintln!("ocb: {problem}");
    }
    if json {
        output::print_json(&algorithms)?;
    } else {
        output::print(&describe(&algorithms))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn describe(algorithms: &[AlgorithmInfo]) -> String {
    if algorithms.is_empty() {
        return "No plugin was found; name a file or folder with --plugins.".to_owned();
    }
    let row = |a: &AlgorithmInfo| {
        let queries: Vec<&str> = a.queries.iter().map(|query| query_name(*query)).collect();
        let yes = |flag| if flag { "yes" } else { "no" }.to_owned();
        let (id, name, version) = (a.id.clone(), a.name.clone(), a.version.clone());
        vec![id, name, version, queries.join(", "), yes(a.witness_points), yes(a.counters), a.license.clone()]
    };
    let headings = ["algorithm", "name", "version", "questions", "witness points", "counters", "licence"];
    output::table(&headings, algorithms.iter().map(row).collect(), &[])
}

/// A question as `--query` and `--contacts` say it.
pub fn query_name(query: Query) -> &'static str {
    match query {
        Query::CollisionFirst => "cd first",
        Query::CollisionAll => "cd all",
        Query::Proximity => "pq",
    }
}

async fn check(store: &Store, file: &Path, json: bool) -> Result<ExitCode> {
    // Looked at here so that a wrong path is no verdict on a plugin.
    if let Err(error) = std::fs::File::open(file) {
        return Err(crate::Failure::file("read", file, &error));
    }
    let (engine, _folder) = open::open_aside(store).await?;
    let report = engine.check_plugin(file).await;
    engine.shutdown().await;
    let report = report?;
    if json {
        output::print_json(&report)?;
    } else {
        output::print(&report_text(&report))?;
    }
    if report.passed {
        return Ok(ExitCode::SUCCESS);
    }
    let reason = report.lines.iter().find(|line| line.verdict == CheckVerdict::Fail);
    let reason = reason.map_or("it does not pass the checks.", |line| line.evidence.as_str());
    eprintln!("ocb: {} cannot be used: {reason}", report.file);
    Ok(ExitCode::from(BAD_INPUT))
}

fn report_text(report: &PluginReport) -> String {
    let mut lines = vec![report.file.clone()];
    for line in &report.lines {
        let mark = match line.verdict {
            CheckVerdict::Pass => "pass",
            CheckVerdict::Note => "note",
            CheckVerdict::Fail => "FAIL",
        };
        lines.push(format!("  {mark}  {}: {}", line.check, line.evidence));
        lines.extend(line.hint.iter().map(|hint| format!("        {hint}")));
    }
    let ids: Vec<&str> = report.algorithms.iter().map(|algorithm| algorithm.id.as_str()).collect();
    lines.push(format!("  algorithms: {}", if ids.is_empty() { "none".to_owned() } else { ids.join(", ") }));
    lines.join("\n")
}
