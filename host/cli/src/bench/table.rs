//! The table of a run, in the unit of the files. Rows stand in the run's order, never ranked: a failed or wrong algorithm has no rank to lose.

use ocb_core::configuration::{Class, Method, Separation};
use ocb_core::record::Verdict;
use ocb_core::resolution::{Resolution, Threshold};
use ocb_service::Profile;
use ocb_service::model::{
    Agreement, AlgorithmResult, ContactQuality, ContractClass, Controls, Estimated, Preview, RoundingEffect, RunInfo,
    RunSpec, SetInfo, Timing,
};

use super::{builds, by_unit};
use crate::{output, plugin, run, units};

const HEADINGS: [&str; 15] = [
    "rank",
    "algorithm",
    "n of N",
    "to reference",
    "median",
    "p95",
    "max",
    "wrong",
    "eps*",
    "BV tests",
    "primitive tests",
    "load",
    "build",
    "memory",
    "outcome",
];

/// Title, table and notes.
pub fn summary(run: &RunInfo) -> String {
    let mut text = vec![title(run)];
    text.extend(run.set.as_ref().map(set));
    text.extend(run.preview.as_ref().map(|preview| self::preview(preview, &run.id)));
    let rows: Vec<Vec<String>> = run.results.iter().map(row).collect();
    if !rows.is_empty() {
        text.push(output::table(&HEADINGS, rows, &[0, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13]));
        text.push(format!(
            "Times are per query, in the unit of the files, with the 95 % interval over the processes{}; the interval of the \
             maximum is over the configurations. Tests are means per query, load is the time to load the plugin's file, and \
             build is the time to build both structures.",
            processes(&run.results)
        ));
        text.extend(run.environment.as_ref().and_then(|machine| machine.reference.as_ref()).map(|reference| {
            format!(
                "Ranks follow the mean ratio to {} on the same configurations in the same rounds, within one class; algorithms \
                 with overlapping 95 % intervals over the processes are tied. Algorithms that failed or gave a wrong answer, \
                 to a control question as well, have no rank.",
                reference.algorithm
            )
        }));
        text.extend(rounding(run));
        text.extend(by_unit::table(&run.results));
        text.extend(builds::table(&run.results));
        text.extend(classes(&run.results));
        text.extend(controls(&run.results));
        text.push(
            "eps* is the largest distance or margin, as a share of the scene's size, at which an answer is wrong; < means that \
             no answer is wrong down to this value."
                .to_owned(),
        );
    }
    text.extend(run.results.iter().filter_map(note));
    if let Some(machine) = &run.environment {
        let null = units::time(machine.null_ns.value);
        let (cpu, class, clock) = (&machine.cpu, &machine.hardware_class, &machine.clock);
        text.push(format!("Measured on {cpu} (class {class}), clock {clock}, null round trip {null} subtracted."));
        text.extend(machine.notable_drift().map(|drift| {
            format!(
                "The clock's rate changed by {:.3} % during the run; its times are no more accurate than that.",
                100.0 * drift.abs()
            )
        }));
        text.extend(machine.draw.as_ref().map(|draw| format!("Repeat it with --run-seed {}.", draw.seed)));
        if machine.profile != Profile::Production.as_str() {
            text.push(format!("UNRANKED: measured in the profile '{}'.", machine.profile));
        }
    }
    text.join("\n")
}

/// What a part of the configurations says of all.
fn preview(preview: &Preview, run: &str) -> String {
    let Preview { n, of, finding, more, .. } = preview;
    format!("PREVIEW of {n} of {of} configurations. {finding} {more} Measure them with `ocb run refine {run}`.")
}

/// Who is compared with whom.
fn classes(results: &[AlgorithmResult]) -> Vec<String> {
    let mut classes: Vec<(ContractClass, Vec<&str>)> = Vec::new();
    for (result, class) in results.iter().filter_map(|r| Some((r, r.class?))) {
        match classes.iter_mut().find(|(known, _)| *known == class) {
            Some((_, members)) => members.push(&result.algorithm),
            None => classes.push((class, vec![&result.algorithm])),
        }
    }
    classes.iter().map(|(class, members)| format!("Class {}: {}.", class.words(), members.join(", "))).collect()
}

/// Of the algorithms the one of which the fewest controls are known.
fn controls(results: &[AlgorithmResult]) -> Option<String> {
    let least = results.iter().filter(|r| r.n > 0).filter_map(|r| r.controls).min_by_key(|controls| controls.n)?;
    let Controls { n, crossing, guess, .. } = least;
    Some(format!(
        "At least {n} control questions, {crossing} of them colliding, were mixed in; they affect only the ranks. A plugin \
         that guesses half of its answers keeps its rank with a probability of at most {guess:.1e}."
    ))
}

fn title(run: &RunInfo) -> String {
    let pair = format!("{} x {}", run.object_a_name, run.object_b_name);
    let query = plugin::query_name(run.spec.query);
    let (placing, state) = (placing(&run.spec), run::state_name(run.state));
    format!("Run {}: {pair}, {query}, {placing}: {state}", run.id)
}

/// How the configurations of a request are found.
pub fn placing(spec: &RunSpec) -> String {
    let method = match &spec.method {
        Method::Sphere { .. } => "sphere".to_owned(),
        Method::Grid { .. } => "grid".to_owned(),
        Method::Trajectory { center_distance, .. } => return format!("trajectory at {center_distance} L"),
        Method::Random { hit_share, .. } => return format!("random, {hit_share} colliding"),
        Method::File { .. } => return "given poses".to_owned(),
    };
    match spec.separation {
        Separation::Ladder => format!("{method}, ladder of steps"),
        Separation::Step { of_size } => format!("{method}, step {of_size:e}"),
        Separation::Relative { distance } => format!("{method}, relative distance {distance}"),
    }
}

/// What there is to say of a set.
pub fn set(set: &SetInfo) -> String {
    let missed = if set.missed_rays > 0 { format!(", {} missed", set.missed_rays) } else { String::new() };
    let further = if set.further_roots > 0 { format!(", {} further roots", set.further_roots) } else { String::new() };
    let classes: Vec<String> = set.classes.iter().map(|c| format!("{} {}", c.count, class_name(c.class))).collect();
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    format!(
        "{} configurations{missed}{further} ({} in f64); closest features cover {} of A's triangles (evenness {:.2}) and \
         {} of B's ({:.2})",
        set.configurations,
        classes.join(", "),
        percent(set.coverage_a),
        set.evenness_a,
        percent(set.coverage_b),
        set.evenness_b
    )
}

fn class_name(class: Class) -> &'static str {
    match class {
        Class::Clear => "clear",
        Class::Colliding => "colliding",
        Class::Grazing => "grazing",
    }
}

fn row(result: &AlgorithmResult) -> Vec<String> {
    let time = |of: fn(&ocb_service::model::TimeSummary) -> Estimated| {
        result.time.as_ref().map_or_else(dash, |summary| interval(&of(summary)))
    };
    vec![
        result.rank.map_or_else(dash, |rank| rank.to_string()),
        result.algorithm.clone(),
        format!("{} of {}", result.n, result.of),
        result.ratio.map_or_else(dash, |Estimated { value, lo, hi }| format!("{value:.3} [{lo:.3}, {hi:.3}]")),
        time(|t| t.median_ns),
        time(|t| t.p95_ns),
        time(|t| t.max_ns),
        wrong(result),
        result.resolution.as_ref().map_or_else(dash, epsilon),
        result.bv_tests_mean.map_or_else(dash, units::mean),
        result.primitive_tests_mean.map_or_else(dash, units::mean),
        result.load_ms.map_or_else(dash, |ms| units::time(ms * 1e6)),
        result.build_ms.map_or_else(dash, |ms| units::time(ms * 1e6)),
        result.memory_bytes.map_or_else(dash, units::bytes),
        format!("{}{}{}", result.outcome.name, by_unit::mark(result), rounded(result)),
    ]
}

fn rounded(result: &AlgorithmResult) -> &'static str {
    if result.rounded { ", rounded coordinates" } else { "" }
}

/// Who got other coordinates than those of the files, and what that changes.
fn rounding(run: &RunInfo) -> Option<String> {
    let names: Vec<&str> = run.results.iter().filter(|r| r.rounded).map(|r| r.algorithm.as_str()).collect();
    let (set, false) = (run.set.as_ref()?, names.is_empty()) else { return None };
    let RoundingEffect { other_answers, largest_change } = set.rounding?;
    Some(format!(
        "Rounded coordinates: single precision does not hold the coordinates of the files. {}, which compute{} in it, got them \
         rounded and are judged by the truth about these; all others got those of the files. Rounding changes the answer to \
         {other_answers} of {} configurations, and distances by up to {largest_change:.1e}.",
        names.join(", "),
        if names.len() == 1 { "s" } else { "" },
        set.configurations
    ))
}

/// In how many processes the algorithms were timed.
fn processes(results: &[AlgorithmResult]) -> String {
    let mut all: Vec<u32> =
        results.iter().filter_map(|r| Some(r.timing.as_ref()?.processes)).filter(|n| *n > 0).collect();
    all.sort_unstable();
    match (all.first(), all.last()) {
        (Some(least), Some(most)) if least == most => format!(" ({least} of each algorithm)"),
        (Some(least), Some(most)) => format!(" ({least} to {most} of each algorithm)"),
        _ => String::new(),
    }
}

/// Nothing was measured: not the same as zero.
fn dash() -> String {
    "-".to_owned()
}

fn interval(estimated: &Estimated) -> String {
    let Estimated { value, lo, hi } = *estimated;
    format!("{} [{}, {}]", units::time(value), units::time(lo), units::time(hi))
}

/// A value, or a bound when no error was seen: never 0.
fn epsilon(resolution: &Resolution) -> String {
    let bound = if resolution.seen { "" } else { "<" };
    resolution.eps.map_or_else(dash, |eps| format!("{bound}{eps:.1e}"))
}

fn wrong(result: &AlgorithmResult) -> String {
    // Zero wrong answers of nothing is no praise.
    if result.n == 0 {
        return dash();
    }
    let wrong = match count(result, Verdict::FalseNegative) {
        0 => result.wrong.to_string(),
        missed => format!("{} ({missed} missed)", result.wrong),
    };
    if by_unit::only_elsewhere(result) { format!("0, in other units {wrong}") } else { wrong }
}

fn count(result: &AlgorithmResult, verdict: Verdict) -> u32 {
    result.verdicts.iter().filter(|entry| entry.verdict == verdict).map(|entry| entry.count).sum()
}

/// What the row cannot say.
fn note(result: &AlgorithmResult) -> Option<String> {
    let mut parts = Vec::new();
    if !result.outcome.completed() {
        parts.push(result.outcome.message.clone());
    }
    parts.extend(by_unit::finding(result));
    parts.extend(result.unranked.iter().map(|unranked| format!("no rank: {}", unranked.message.trim_end_matches('.'))));
    if result.budget_limited && result.n > 0 {
        parts.push(format!("the time budget sufficed for {} of {} configurations", result.n, result.of));
    }
    for (verdict, words) in [
        (Verdict::FalseNegative, "collisions missed"),
        (Verdict::FalsePositive, "false alarms"),
        (Verdict::DistanceOver, "distances too large"),
        (Verdict::DistanceUnder, "distances too small"),
        (Verdict::WrongWitness, "wrong witnesses"),
        (Verdict::Invalid, "invalid answers"),
        (Verdict::GaveUp, "errors reported by the plugin"),
        (Verdict::Unsupported, "unsupported"),
    ] {
        let count = count(result, verdict);
        if count > 0 {
            parts.push(format!("{count} {words}"));
        }
    }
    if result.grazing.n > 0 {
        let Agreement { n, agree } = result.grazing;
        parts.push(format!("{n} too close for its precision (not scored; {agree} agree with exact arithmetic)"));
    }
    parts.extend(result.resolution.iter().flat_map(resolution));
    parts.extend(result.contacts.iter().map(contacts));
    if let Some(below) = result.time.map(|time| time.below_resolution).filter(|below| *below > 0) {
        parts.push(format!("{below} times below the clock's resolution"));
    }
    if let Some(timing) = result.timing.as_ref().filter(|timing| 2 * timing.disturbed_blocks > timing.blocks) {
        let Timing { disturbed_blocks, blocks, .. } = timing;
        parts.push(format!("{disturbed_blocks} of {blocks} blocks of queries were disturbed: this machine is busy"));
    }
    (!parts.is_empty()).then(|| format!("{}: {}.", result.algorithm, parts.join("; ").trim_end_matches('.')))
}

/// Where the errors behind eps* are, and how far distances are off.
fn resolution(resolution: &Resolution) -> Vec<String> {
    let mut parts = Vec::new();
    let mut side = |what: &str, of: &str, side: &Threshold| {
        if let (Some(at), true) = (side.at, side.wrong > 0) {
            parts.push(format!("{what} up to {at:.1e} of the size ({} of {} {of})", side.wrong, side.n));
        }
    };
    side("false hits", "apart", &resolution.false_hits);
    side("misses", "crossing", &resolution.misses);
    if let Some(error) = resolution.distance {
        let worst = |x: Option<f64>| x.map_or_else(|| "never".to_owned(), |x| format!("at most {x:.2}"));
        let (over, under) = (worst(error.over), worst(error.under));
        parts.push(format!("distances {over} over and {under} under the certified interval, in roundings u S"));
    }
    parts
}

fn contacts(quality: &ContactQuality) -> String {
    let percent = |x: Option<f64>| x.map_or_else(dash, |x| format!("{:.4} %", 100.0 * x));
    let (precision, recall) = (percent(quality.precision), percent(quality.recall));
    format!(
        "precision {precision} of {} contacts listed, recall {recall} of {} certain contacts",
        quality.listed, quality.robust
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_an_answer_the_row_says_why_and_has_no_rank() {
        let result: AlgorithmResult = serde_json::from_value(serde_json::json!({
            "algorithm": "x", "name": "X", "n": 0, "of": 9, "budget_limited": true, "time": null, "verdicts": [], "wrong": 0,
            "outcome": { "name": "OutOfBudget", "message": "The time budget ended.", "ours": false }, "rank": null,
            "bv_tests_mean": null, "primitive_tests_mean": null, "build_ms": null, "memory_bytes": null,
        }))
        .expect("a result");
        let row = row(&result);
        assert_eq!([&row[0], &row[2], &row[7], &row[14]], ["-", "0 of 9", "-", "OutOfBudget"]);
        assert_eq!(note(&result).as_deref(), Some("x: The time budget ended."));
    }
}
