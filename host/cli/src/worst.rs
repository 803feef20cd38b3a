//! `ocb worst`: the configurations on which an algorithm was worst.

use std::process::ExitCode;

use ocb_engine::Engine;
use ocb_engine::model::{WorstCase, WorstRequest};

use crate::args::{Store, WorstArgs};
use crate::failure::Result;
use crate::open::{self, Purpose};
use crate::{heatmap, output, run, units};

/// Prints the list; with `--json` also poses.
pub async fn worst(store: &Store, args: &WorstArgs, json: bool) -> Result<ExitCode> {
    let engine = open::open(store, Purpose::Look).await?;
    let listed = list(&engine, args, json).await;
    engine.shutdown().await;
    listed.map(|()| ExitCode::SUCCESS)
}

async fn list(engine: &Engine, args: &WorstArgs, json: bool) -> Result<()> {
    let run = run::find(engine, &args.run).await?;
    let algorithm = heatmap::choose(&run, args.algorithm.as_deref())?;
    let (by, limit, selection) = (args.by.into(), args.limit, args.selection.clone());
    let cases = engine.worst(&run.id, &WorstRequest { algorithm, by, limit, selection }).await?;
    if json {
        return output::print_json(&cases);
    }
    let headings = [
        "configuration",
        "time",
        "verdict",
        "answer",
        "truth",
        "error [u S]",
        "triangles A, B",
        "witness A",
        "witness B",
    ];
    output::print(&output::table(&headings, cases.iter().map(row).collect(), &[0, 1, 5]))
}

fn row(case: &WorstCase) -> Vec<String> {
    let decision = |hit: bool| if hit { "hit" } else { "apart" }.to_owned();
    let answer = match (case.hit, case.distance) {
        (Some(hit), _) => decision(hit),
        (None, Some(distance)) => format!("{distance:.6e}"),
        (None, None) => "none".to_owned(),
    };
    let truth =
        if case.distance.is_some() { format!("{:.6e}", case.true_distance[1]) } else { decision(case.true_hit) };
    let point = |[x, y, z]: [f64; 3]| format!("{x:.4} {y:.4} {z:.4}");
    vec![
        case.configuration.to_string(),
        units::time(case.time_ns),
        case.verdict.name().replace('_', " "),
        answer,
        truth,
        case.error.map_or_else(String::new, |error| format!("{error:.3}")),
        format!("{}, {}", case.triangles[0], case.triangles[1]),
        point(case.points[0]),
        point(case.points[1]),
    ]
}
