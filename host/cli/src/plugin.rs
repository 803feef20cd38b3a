//! `ocb plugin`: what is offered, and whether a file may be.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use ocb_core::query::Query;
use ocb_service::model::{AlgorithmInfo, CheckLine, CheckVerdict, PluginReport};
use ocb_service::{Extent, given};
use serde::de::DeserializeOwned;

use crate::args::{PluginCommand, Store};
use crate::failure::{BAD_INPUT, Failure, Result};
use crate::{open, output};

/// Largest file of JSON that is read.
const MAX_JSON_BYTES: usize = 16 << 20;

/// Lists or checks.
pub async fn plugin(store: &Store, command: &PluginCommand, json: bool) -> Result<ExitCode> {
    match command {
        PluginCommand::List => list(store, json).await,
        PluginCommand::Check { file, quick, manifest, repro, out } => {
            let manifest = manifest.as_deref().map(json_file).transpose()?;
            let extent = Extent { quick: *quick, manifest, repro: repro.as_deref().map(json_file).transpose()? };
            check(store, file, extent, out.as_deref(), json).await
        }
    }
}

async fn list(store: &Store, json: bool) -> Result<ExitCode> {
    let (engine, _folder) = open::open_aside(store).await?;
    let algorithms = engine.algorithms(None);
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
    let headings = ["algorithm", "name", "version", "queries", "witness points", "counters", "licence"];
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

/// A file of JSON.
pub fn json_file<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let bytes = open::read_bounded(path, MAX_JSON_BYTES)?;
    serde_json::from_slice(&bytes).map_err(|e| Failure::Input(format!("Cannot read {}: {e}.", path.display())))
}

/// Writes the repros into a folder; gives the names of the files.
fn write_repros(report: &PluginReport, folder: &Path) -> Result<Vec<PathBuf>> {
    std::fs::create_dir_all(folder).map_err(|e| Failure::file("create", folder, &e))?;
    let mut written = Vec::new();
    for repro in report.lines.iter().filter_map(|line| line.repro.as_deref()) {
        let path = folder.join(format!("repro-{}.json", written.len() + 1));
        std::fs::write(&path, output::to_json(repro)?).map_err(|e| Failure::file("write", &path, &e))?;
        written.push(path);
    }
    Ok(written)
}

async fn check(store: &Store, file: &Path, extent: Extent, out: Option<&Path>, json: bool) -> Result<ExitCode> {
    // Looked at here so that a wrong path is no verdict on a plugin.
    if let Err(error) = given::open(file) {
        return Err(Failure::file("read", file, &error));
    }
    let (engine, _folder) = open::open_aside(store).await?;
    let report = engine.check_plugin(file, extent).await;
    engine.shutdown().await;
    let report = report?;
    for path in out.map(|folder| write_repros(&report, folder)).transpose()?.unwrap_or_default() {
        eprintln!("ocb: wrote {}", path.display());
    }
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
    lines.extend(report.lines.iter().map(line_text));
    let ids: Vec<&str> = report.algorithms.iter().map(|algorithm| algorithm.id.as_str()).collect();
    lines.push(format!("  algorithms: {}", if ids.is_empty() { "none".to_owned() } else { ids.join(", ") }));
    lines.join("\n")
}

/// One line of a report, with the hint below it.
pub fn line_text(line: &CheckLine) -> String {
    let mark = match line.verdict {
        CheckVerdict::Pass => "pass",
        CheckVerdict::Note => "note",
        CheckVerdict::Fail => "FAIL",
    };
    let hint = line.hint.as_ref().map_or_else(String::new, |hint| format!("\n        {hint}"));
    format!("  {mark}  {}: {}{hint}", line.check, line.evidence)
}
