//! `ocb worst`: the configurations on which an algorithm was worst.

use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::{WorstCase, WorstRequest};

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
        "true triangles A, B",
        "true point A",
        "true point B",
        "claimed triangles A, B",
        "claimed point A",
        "claimed point B",
    ];
    // What wrong answers point at, where there are any.
    let shown = if cases.iter().any(|case| case.claim.is_some()) { headings.len() } else { headings.len() - 3 };
    let rows = cases.iter().map(|case| row(case).into_iter().take(shown).collect()).collect();
    output::print(&output::table(&headings[..shown], rows, &[0, 1, 5]))
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
    let triangles = |[a, b]: [u32; 2]| format!("{a}, {b}");
    let claimed = case.claim.and_then(|claim| claim.points);
    vec![
        case.configuration.to_string(),
        units::time(case.time_ns),
        case.verdict.name().replace('_', " "),
        answer,
        truth,
        case.error.map_or_else(String::new, |error| format!("{error:.3}")),
        triangles(case.triangles),
        point(case.points[0]),
        point(case.points[1]),
        case.claim.and_then(|claim| claim.triangles).map_or_else(String::new, triangles),
        claimed.map_or_else(String::new, |points| point(points[0])),
        claimed.map_or_else(String::new, |points| point(points[1])),
    ]
}
