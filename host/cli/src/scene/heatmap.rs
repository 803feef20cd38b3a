//! `ocb scene heatmap`: where on an object of a replayed recording an algorithm is slow or wrong, as a file.

use std::process::ExitCode;

use ocb_service::model::ObjectHeatmapRequest;
use ocb_service::workload::{HeatmapFile, mesh_of, object_heatmap};
use ocb_service::{Recording, given};
use serde_json::json;

use crate::args::SceneHeatmapArgs;
use crate::failure::{Failure, Result};
use crate::heatmap::format_of;
use crate::output;

/// Largest table, bytes.
const MOST_TABLE: u64 = 4 << 30;

/// Writes the file.
pub fn heatmap(args: &SceneHeatmapArgs, json: bool) -> Result<ExitCode> {
    let format = format_of(&args.output)?;
    let recording = Recording::read(&args.recording)?;
    let object = place(&recording, &args.object)?;
    let mesh = mesh_of(&recording, object as usize)?;
    let queries = given::read(&args.queries, MOST_TABLE).map_err(|e| Failure::file("read", &args.queries, &e))?;
    let request = ObjectHeatmapRequest {
        algorithm: args.algorithm.clone(),
        order: args.order.into(),
        measure: args.measure.into(),
        from: args.from,
        to: args.to,
    };
    let heatmap = object_heatmap(&queries, &mesh, object, &request)?;
    let name = args.recording.file_name().unwrap_or_default().to_string_lossy();
    let (colormap, scale) = (args.colormap.into(), args.scale.into());
    let file = HeatmapFile { heatmap: &heatmap, mesh: &mesh, recording: &name, colormap, scale };
    let bytes = file.bytes(format);
    std::fs::write(&args.output, &bytes).map_err(|e| Failure::file("write", &args.output, &e))?;
    if json {
        let (n, range, unit) = (heatmap.n, heatmap.range, &heatmap.unit);
        output::print_json(&json!({ "object": object, "n": n, "range": range, "unit": unit, "file": args.output }))?;
    } else {
        output::print(&format!("{} ({} queries about {})", args.output.display(), heatmap.n, args.object))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Place of the object of this name.
fn place(recording: &Recording, name: &str) -> Result<u32> {
    let objects = &recording.scene.scene.objects;
    let found = (0..).zip(objects).find(|(_, object)| object.name == name);
    found.map(|(place, _)| place).ok_or_else(|| {
        Failure::Input(format!("The recording has no object {name:?}; `ocb scene show` lists its {}.", objects.len()))
    })
}
