//! `ocb chart`: a chart of a run as a file.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use ocb_service::chart::{Chart, svg};
use ocb_service::model::ChartRequest;
use ocb_service::{Engine, chart_csv, chart_parquet};
use serde_json::json;

use crate::args::Store;
use crate::choice::{AccuracyArg, KindArg};
use crate::failure::{Failure, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{output, picture, run, units};

/// `ocb chart`
#[derive(Debug, Args)]
pub struct ChartArgs {
    /// Run id, or `latest`.
    pub run: String,
    /// What to chart.
    #[arg(long, value_enum)]
    pub kind: KindArg,
    /// For the kind `accuracy`: what to chart speed against.
    #[arg(long, value_enum, default_value_t = AccuracyArg::Digits)]
    pub accuracy: AccuracyArg,
    /// For the kinds `ecdf`, `bv-tests` and `primitive-tests`: only the configurations of this selection (`ocb select --help`
    /// explains the syntax).
    #[arg(long = "where", value_name = "SELECTION")]
    pub selection: Option<String>,
    /// Algorithm of columns for which the selection names none [default: the run's only one].
    #[arg(long, value_name = "ID")]
    pub algorithm: Option<String>,
    /// File to write: .svg or .png (the picture), .csv, .parquet or .json (its numbers).
    #[arg(short, long, value_name = "FILE")]
    pub out: PathBuf,
}

/// Writes the file.
pub async fn chart(store: &Store, args: &ChartArgs, json: bool) -> Result<ExitCode> {
    let write = writer(&args.out)?;
    let engine = open::open(store, Purpose::Look).await?;
    let chart = made(&engine, args).await;
    engine.shutdown().await;
    let (run, chart) = chart?;
    let bytes = write(&chart)?;
    std::fs::write(&args.out, &bytes).map_err(|e| Failure::file("write", &args.out, &e))?;
    if json {
        output::print_json(&json!({ "run": run, "file": args.out, "bytes": bytes.len() }))?;
    } else {
        output::print(&format!("{} ({} of {run})", args.out.display(), units::bytes(bytes.len() as u64)))?;
    }
    Ok(ExitCode::SUCCESS)
}

async fn made(engine: &Engine, args: &ChartArgs) -> Result<(String, Chart)> {
    let run = run::find(engine, &args.run).await?;
    let request = ChartRequest {
        kind: args.kind.into(),
        accuracy: args.accuracy.into(),
        selection: args.selection.clone(),
        algorithm: args.algorithm.clone(),
    };
    let chart = engine.chart(&run.id, request, Some(OWNER)).await?;
    Ok((run.id, chart))
}

type Writer = fn(&Chart) -> Result<Vec<u8>>;

/// What the end of the name asks for.
fn writer(path: &Path) -> Result<Writer> {
    match picture::ending(path).as_deref() {
        Some("svg") => Ok(|chart| Ok(svg::chart(chart).into_bytes())),
        Some("png") => Ok(|chart| picture::png(&svg::chart(chart))),
        Some("csv") => Ok(|chart| Ok(chart_csv(chart)?)),
        Some("parquet") => Ok(|chart| Ok(chart_parquet(chart)?)),
        Some("json") => Ok(|chart| Ok(output::to_json(chart)?.into_bytes())),
        _ => Err(Failure::Input(format!("{} must end in .svg, .png, .csv, .parquet or .json.", path.display()))),
    }
}
