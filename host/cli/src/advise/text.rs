//! The card: advice in words and a table.

use std::path::PathBuf;

use ocb_advice::{Advice, Kind, Measured, Point, Question, Share, Unit};

use crate::output;

/// The card, the curve behind it, and the files.
pub fn card(advice: &Advice, written: &[PathBuf]) -> String {
    let mut lines = vec![asked(advice), enough(advice)];
    if let (Some(sure), Some(anywhere)) = (advice.guaranteed_error, advice.guaranteed_anywhere) {
        let seen = advice.held_out.observed_error.map_or_else(String::new, |e| {
            format!("; observed at most {} on {} held-out configurations", length(advice, e), advice.held_out.wrong.of)
        });
        lines.push(format!(
            "Error: certified at most {} on these {} configurations{seen}. These levels alone: at most {} anywhere.",
            length(advice, sure),
            advice.configurations,
            length(advice, anywhere)
        ));
    }
    let held = &advice.held_out;
    lines.push(format!(
        "Held out: {} wrong, {} intervals contradict the oracle; {} needed the whole objects.",
        share(&held.wrong),
        share(&held.violations),
        share(&held.falls_back)
    ));
    lines.push(String::new());
    lines.push(table(advice));
    lines.push(String::new());
    lines.push(
        "Times are those of one thread, with their [95 % interval], measured in turn in this process. A row with an \
         algorithm's id, as in `ocb bench`, has the times of that algorithm; all other rows have those of this program's own \
         search. Uncertified rows guarantee nothing: their errors are those observed on these configurations. Errors are \
         shares of A's longest side."
            .to_owned(),
    );
    for left_out in &advice.left_out {
        lines.push(format!("Left out: {} ({}).", left_out.what.join(", "), left_out.reason));
    }
    lines.extend(written.iter().map(|path| path.display().to_string()));
    lines.join("\n")
}

fn asked(advice: &Advice) -> String {
    let what = match advice.question {
        Question::Distance { tolerance } => format!("distance, error at most {}", length(advice, tolerance)),
        Question::Clearance { clearance } => format!("distance greater than {}", length(advice, clearance)),
    };
    let distances: Vec<String> = advice.distances.iter().map(|d| format!("{d:.4}")).collect();
    format!("Query: {what}. {} configurations at relative distances {}.", advice.configurations, distances.join(", "))
}

fn enough(advice: &Advice) -> String {
    let faster = format!(
        "{} times faster than the distance query on the whole objects, {} times faster than this query on them",
        estimate(&advice.faster),
        estimate(&advice.faster_than_same_question)
    );
    if advice.stages.is_empty() {
        return format!(
            "The whole objects ({} triangles) answer this query fastest: {faster}.",
            advice.triangles_before
        );
    }
    let times = f64::from(advice.triangles_before) / f64::from(advice.triangles_after);
    format!(
        "Sufficient: {} instead of {} triangles ({times:.1} times fewer); {faster}.",
        stages(advice, &advice.stages),
        advice.triangles_before
    )
}

/// Triangles of A and B, stage by stage.
fn stages(advice: &Advice, stages: &[[usize; 2]]) -> String {
    let of = |[a, b]: &[usize; 2]| format!("{} + {}", advice.levels_a[*a].triangles, advice.levels_b[*b].triangles);
    stages.iter().map(of).collect::<Vec<_>>().join(", then ")
}

fn table(advice: &Advice) -> String {
    let row = |point: &Point| {
        let error = |e: Option<f64>| match e.map(|e| e / advice.longest_side) {
            Some(e) if e > 0.0 && e < 1e-4 => format!("{e:.1e}"),
            Some(e) => format!("{e:.5}"),
            None => "-".to_owned(),
        };
        let some = |s: &Option<Share>| s.as_ref().map_or_else(|| "-".to_owned(), share);
        vec![
            name(advice, point),
            format!("{} {}", point.elements, unit(point.unit)),
            estimate(&point.micros),
            estimate(&point.faster),
            error(point.guaranteed_error),
            error(point.observed_error),
            some(&point.falls_back),
            some(&point.false_alarms),
            some(&point.missed),
        ]
    };
    let headings = [
        "queried",
        "model size",
        "us",
        "times faster",
        "guaranteed",
        "observed",
        "falls back",
        "false alarms",
        "missed",
    ];
    output::table(&headings, advice.points.iter().map(row).collect(), &[1, 2, 3, 4, 5, 6, 7, 8])
}

fn name(advice: &Advice, point: &Point) -> String {
    let what = match point.kind {
        Kind::Whole => "whole objects, distance".to_owned(),
        Kind::SameQuestion => "whole objects, this query".to_owned(),
        Kind::YesNo => "whole objects, tolerance exceeded or not".to_owned(),
        Kind::Levels => format!("levels {}", stages(advice, &point.stages)),
        Kind::Advised => "ADVISED".to_owned(),
        Kind::Hulls => "convex hulls".to_owned(),
        Kind::Boxes => "boxes".to_owned(),
        Kind::ConvexParts => "convex parts".to_owned(),
        Kind::InnerSpheres => "inner spheres".to_owned(),
        Kind::Voxels if matches!(advice.question, Question::Distance { .. }) => {
            "voxels, tolerance exceeded or not".to_owned()
        }
        Kind::Voxels => "voxels".to_owned(),
        Kind::DoublePrecision => "whole objects in f64".to_owned(),
        Kind::SinglePrecision => "whole objects in f32".to_owned(),
    };
    let algorithm = point.algorithm.as_ref().map_or_else(String::new, |algorithm| format!(", {algorithm}"));
    let asked = point.asked.map_or_else(String::new, |asked| format!("{asked} of {} queried", advice.configurations));
    let remarks = [if point.certified { "" } else { "uncertified" }, &asked].into_iter().filter(|r| !r.is_empty());
    match remarks.collect::<Vec<_>>().join("; ") {
        none if none.is_empty() => format!("{what}{algorithm}"),
        remarks => format!("{what}{algorithm} ({remarks})"),
    }
}

fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Triangles => "triangles",
        Unit::Spheres => "spheres",
        Unit::Voxels => "voxels",
    }
}

fn length(advice: &Advice, x: f64) -> String {
    format!("{x:.4e} ({:.3} % of A's longest side)", 100.0 * x / advice.longest_side)
}

fn estimate(e: &Measured) -> String {
    let digits = if e.value < 10.0 { 2 } else { 0 };
    format!("{:.digits$} [{:.digits$}, {:.digits$}]", e.value, e.lo, e.hi)
}

fn share(s: &Share) -> String {
    match s.seen {
        0 if s.of > 0 => format!("0 of {} (< {:.*} %)", s.of, if s.of > 3000 { 4 } else { 2 }, 100.0 * s.hi),
        _ => format!("{} of {} ({:.1} %)", s.seen, s.of, 100.0 * s.value()),
    }
}
