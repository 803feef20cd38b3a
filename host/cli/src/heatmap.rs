//! `ocb heatmap`: a run's numbers on the surface, as a file.

use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::{Heatmap, HeatmapRequest, RunInfo};
use ocb_service::workload::HeatmapFormat as Format;
use serde_json::json;

use crate::args::{HeatmapArgs, Store};
use crate::failure::{Failure, Result};
use crate::open::{self, Purpose};
use crate::{output, run};

/// Writes the file.
pub async fn heatmap(store: &Store, args: &HeatmapArgs, json: bool) -> Result<ExitCode> {
    let format = format_of(&args.output)?;
    let engine = open::open(store, Purpose::Look).await?;
    let written = write(&engine, args, format, json).await;
    engine.shutdown().await;
    written.map(|()| ExitCode::SUCCESS)
}

async fn write(engine: &Engine, args: &HeatmapArgs, format: Format, json: bool) -> Result<()> {
    let run = run::find(engine, &args.run).await?;
    let request = HeatmapRequest {
        algorithm: choose(&run, args.algorithm.as_deref())?,
        side: args.side.into(),
        measure: args.measure.into(),
        statistic: args.statistic.into(),
        outliers: args.outliers.into(),
        against: args.against.clone(),
        against_run: match &args.against_run {
            Some(other) => Some(run::find(engine, other).await?.id),
            None => None,
        },
        selection: args.selection.clone(),
    };
    let (colormap, scale) = (args.colormap.into(), args.scale.into());
    let bytes = match format {
        Format::Glb => engine.heatmap_glb(&run.id, &request, colormap, scale).await?,
        Format::Ply => engine.heatmap_ply(&run.id, &request, colormap, scale).await?,
        Format::Csv => csv(&engine.heatmap(&run.id, &request).await?).into_bytes(),
    };
    std::fs::write(&args.output, &bytes).map_err(|e| Failure::file("write", &args.output, &e))?;
    if json {
        return output::print_json(&json!({ "run": run.id, "file": args.output, "bytes": bytes.len() }));
    }
    output::print(&format!("{} ({} of {})", args.output.display(), crate::units::bytes(bytes.len() as u64), run.id))
}

/// By the end of its name.
pub fn format_of(path: &Path) -> Result<Format> {
    match path.extension().and_then(|end| end.to_str()).map(str::to_lowercase).as_deref() {
        Some("glb") => Ok(Format::Glb),
        Some("ply") => Ok(Format::Ply),
        Some("csv") => Ok(Format::Csv),
        _ => Err(Failure::Input(format!("{} must end in .glb, .ply or .csv.", path.display()))),
    }
}

/// The algorithm that was asked for, or the only one.
pub fn choose(run: &RunInfo, asked: Option<&str>) -> Result<String> {
    if let Some(algorithm) = asked {
        return Ok(algorithm.to_owned());
    }
    match run.results.as_slice() {
        [only] => Ok(only.algorithm.clone()),
        [] => Err(Failure::Input(format!("The run {} has no results yet.", run.id))),
        several => {
            let ids: Vec<&str> = several.iter().map(|result| result.algorithm.as_str()).collect();
            Err(Failure::Input(format!(
                "The run has several algorithms; choose one with --algorithm: {}.",
                ids.join(", ")
            )))
        }
    }
}

/// One line per vertex; an empty value is one that is not there.
pub fn csv(heatmap: &Heatmap) -> String {
    let mut text = format!("vertex,value_{},count,dropped\n", heatmap.unit);
    let columns = heatmap.values.iter().zip(&heatmap.counts).zip(&heatmap.dropped);
    for (vertex, ((value, count), dropped)) in columns.enumerate() {
        let value = value.map_or_else(String::new, |value| value.to_string());
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{vertex},{value},{count},{dropped}");
    }
    text
}
