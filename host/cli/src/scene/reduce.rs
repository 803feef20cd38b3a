//! `ocb scene reduce`: no more model than a recorded program needs.

mod text;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use ocb_service::Recording;
use ocb_service::advising::{Advisor, SHELF};
use ocb_service::chart::Chart;
use ocb_service::model::{ReduceTerms, ReducedScene, ReducedSpeed, Track, WorkloadResult, WorkloadSpec, frontier};
use ocb_service::reduce::{self, Robot};
use ocb_service::scene_import::Wanted;
use ocb_service::truth::Machine;

use crate::advise::{lengths, work};
use crate::args::{ReduceArgs, Store};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, Purpose};
use crate::{output, workload};

/// Reduces, replays, prints, writes.
pub async fn reduce(store: &Store, args: &ReduceArgs, json: bool) -> Result<ExitCode> {
    let recording = Arc::new(Recording::read(&args.recording)?);
    let terms = ReduceTerms {
        tolerance: lengths::of_scene("The tolerance", &args.tolerance, args.unit, false)?,
        near: lengths::of_scene("The neighbourhood", &args.near, args.unit, true)?,
        outside_only: args.outside_only,
        frontier: args.frontier,
    };
    let spec = WorkloadSpec {
        algorithms: args.algorithm.clone(),
        tracks: vec![Track::Shuffled],
        passes: args.passes,
        budget_seconds: args.budget,
        seed: None,
        reduce: None,
    };
    spec.check().map_err(Failure::Input)?;
    let wanted = Wanted { packages: args.package.clone(), ..Wanted::default() };
    let robot = args.urdf.as_ref().map(|robot| Robot::read(robot, &wanted, &recording)).transpose()?;
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file("create the folder", folder, &e))?;
    }
    let advisor = Advisor::new(&open::advisor(store), &Machine::observe()?, &open::data(store)?.join(SHELF));
    let of = recording.clone();
    let reduced = work::watch(move |watch| {
        let make = |name: &str, object: &Arc<_>| advisor.simplify(name, object, watch);
        reduce::reduce(&of, terms, &make, watch)
    });
    let Some(reduced) = reduced.await?? else { return Ok(stopped()) };
    let robot = robot.map(|robot| robot.with(&reduced));
    let after = Arc::new(reduced.recording);
    let measured = match args.algorithm.is_empty() {
        true => Some((Vec::new(), None)),
        false => measured(store, &spec, &recording, (terms.tolerance, &after), reduced.others).await?,
    };
    let Some((speed, frontier)) = measured else { return Ok(stopped()) };
    let report = ReducedScene { reduction: reduced.reduction, speed, frontier };
    let mut written = Vec::new();
    if let Some(folder) = &args.out {
        if let (Some(robot), Some(file)) = (robot, &args.urdf) {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            written.push(write(folder, &name, robot.text.as_bytes())?);
            for (name, bytes) in &robot.meshes {
                written.push(write(folder, name, bytes)?);
            }
        }
        let path = folder.join("reduced.ocbrec");
        after.write(&path)?;
        written.push(path);
        written.push(write(folder, "reduction.json", output::to_json(&report)?.as_bytes())?);
    }
    if json {
        output::print_json(&report)?;
    } else {
        let names = recording.scene.scene.objects.iter().map(|object| object.name.as_str());
        output::print(&text::text(&report, &names.collect::<Vec<_>>(), &written))?;
    }
    let wrong = report.speed.iter().any(|speed| speed.wrong > 0);
    Ok(ExitCode::from(if wrong { NOT_ALL_WELL } else { 0 }))
}

fn stopped() -> ExitCode {
    eprintln!("ocb: Stopped; nothing was kept.");
    ExitCode::from(INTERRUPTED)
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf> {
    let path = folder.join(name);
    let parent = path.parent().unwrap_or(folder);
    std::fs::create_dir_all(parent).map_err(|e| Failure::file("create the folder", parent, &e))?;
    std::fs::write(&path, bytes).map_err(|e| Failure::file("write", &path, &e))?;
    Ok(path)
}

/// Replays both scenes in turn, and then those for other tolerances; nothing when interrupted.
async fn measured(
    store: &Store,
    spec: &WorkloadSpec,
    before: &Arc<Recording>,
    (tolerance, after): (f64, &Arc<Recording>),
    others: Vec<(f64, Recording)>,
) -> Result<Option<(Vec<ReducedSpeed>, Option<Chart>)>> {
    let engine = open::open(store, Purpose::Look).await?;
    let (tolerances, others): (Vec<f64>, Vec<_>) = others.into_iter().map(|(at, it)| (at, Arc::new(it))).unzip();
    let all = [before, after, after, before].into_iter().chain(&others);
    let mut results: Vec<WorkloadResult> = Vec::new();
    for recording in all {
        match workload::replay(&engine, recording.clone(), spec.clone()).await {
            Ok(Some(replayed)) => results.push(replayed.result),
            other => {
                engine.shutdown().await;
                return other.map(|_| None);
            }
        }
    }
    engine.shutdown().await;
    let Some(([first, second, third, last], more)) = results.split_first_chunk() else { return Ok(None) };
    let frontier = (!more.is_empty()).then(|| {
        let mut points: Vec<_> = tolerances.into_iter().zip(more).chain([(tolerance, second)]).collect();
        points.sort_by(|x, y| x.0.total_cmp(&y.0));
        frontier(first, &points)
    });
    Ok(Some((ReducedSpeed::of([first, second, third, last]), frontier)))
}
