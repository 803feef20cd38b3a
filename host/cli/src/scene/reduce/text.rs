//! A reduced scene as text.

use std::path::PathBuf;

use ocb_service::reduce::{BodyKind, HeldOut, Reduction};

use super::Report;
use crate::{output, units};

/// Changed answers that are listed.
const LISTED: usize = 5;

/// Everything that a terminal shows.
pub fn text(report: &Report, names: &[&str], written: &[PathBuf]) -> String {
    let Report { reduction, speed } = report;
    let mut text = vec![objects(reduction), String::new()];
    text.extend(certified(reduction));
    text.extend(reduction.held_out.as_ref().map(|held_out| held(held_out, reduction, names)));
    if !speed.is_empty() {
        let row = |it: &super::Speed| {
            let [x, y] = it.faster;
            vec![
                it.algorithm.clone(),
                units::time(it.before_ns),
                units::time(it.after_ns),
                format!("{:.2} to {:.2}", x.min(y), x.max(y)),
                it.wrong.to_string(),
            ]
        };
        let headings = ["algorithm", "before", "after", "times faster", "wrong"];
        text.push(output::table(&headings, speed.iter().map(row).collect(), &[1, 2, 3, 4]));
        text.push(
            "Means of a query, each scene replayed twice in turn. Curved bodies and boxes are given to the algorithms as \
             triangles; a library that knows them directly is faster still."
                .to_owned(),
        );
    }
    text.extend(written.iter().map(|path| path.display().to_string()));
    text.join("\n")
}

fn objects(reduction: &Reduction) -> String {
    let row = |it: &ocb_service::reduce::ReducedObject| {
        let body = match it.body {
            BodyKind::Object => "unchanged",
            BodyKind::Sphere => "sphere",
            BodyKind::Capsule => "capsule",
            BodyKind::Box => "box",
            BodyKind::Hull => "convex hull",
            BodyKind::Level => "fewer triangles",
        };
        vec![it.name.clone(), body.to_owned(), it.before.to_string(), it.after.to_string(), it.queries.to_string()]
    };
    let headings = ["object", "replaced by", "elements before", "after", "queries"];
    output::table(&headings, reduction.objects.iter().map(row).collect(), &[2, 3, 4])
}

fn certified(reduction: &Reduction) -> Vec<String> {
    let Reduction { tolerance, near, outside_only, queries, left_out, hits, grazing, largest_change, .. } = reduction;
    let sum = |of: fn(&ocb_service::reduce::ReducedObject) -> u64| reduction.objects.iter().map(of).sum::<u64>();
    let around =
        if *near > 0.0 { format!(", and wherever the objects are moved by less than {near}") } else { String::new() };
    let mut text = vec![format!(
        "{} elements became {}. Certified for each of {queries} recorded queries{around}: the answer is right for a distance within \
         {tolerance} of the true one.",
        sum(|it| it.before),
        sum(|it| it.after)
    )];
    text.push(match outside_only {
        true => format!(
            "Every body contains its object, so that none of the {hits} recorded collisions is missed, nor any other."
        ),
        false => format!("Of {hits} recorded collisions, {grazing} became gaps smaller than that."),
    });
    text.extend(
        largest_change.map(|change| format!("No distance that was asked for changed by more than {change:.3e}.")),
    );
    if *left_out > 0 {
        text.push(format!("Left out: {left_out} queries, because a pose is no rotation."));
    }
    text
}

fn held(held_out: &HeldOut, reduction: &Reduction, names: &[&str]) -> String {
    let HeldOut { queries, changed, missed, examples } = held_out;
    let mut text = format!(
        "Chosen without the last {queries} queries, the bodies change {} of them by more than the tolerance: {:.3} % [{:.3}, {:.3}], \
         {missed} of them missed collisions.",
        changed.seen,
        100.0 * changed.value(),
        100.0 * changed.lo,
        100.0 * changed.hi
    );
    if changed.seen > 0 {
        text.push_str(" So the certificate does not hold for other queries than the recorded ones");
        text.push_str(if reduction.near > 0.0 {
            " and their neighbourhoods."
        } else {
            "; --near asks for a neighbourhood."
        });
    }
    for it in examples.iter().take(LISTED) {
        let [a, b] = it.objects.map(|object| names[object as usize]);
        let [lo, hi] = it.distance;
        let [below, above] = it.reduced;
        text.push_str(&format!(
            "\n  query {} of the recording, {a} and {b}: the distance {lo:.6} to {hi:.6} became {below:.6} to {above:.6}",
            it.row
        ));
    }
    text
}
