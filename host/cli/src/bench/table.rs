//! The table of a run. Rows stand in the run's order, never ranked: a failed or wrong algorithm has no rank to lose.

use ocb_core::record::Verdict;
use ocb_engine::model::{AlgorithmResult, Estimated, RunInfo};

use crate::{output, plugin, run, units};

const HEADINGS: [&str; 11] = [
    "algorithm",
    "n of N",
    "median",
    "p95",
    "max",
    "wrong",
    "BV tests",
    "primitive tests",
    "build",
    "memory",
    "outcome",
];

/// Title, table and notes.
pub fn summary(run: &RunInfo) -> String {
    let mut text = vec![title(run)];
    let rows: Vec<Vec<String>> = run.results.iter().map(row).collect();
    if !rows.is_empty() {
        text.push(output::table(&HEADINGS, rows, &[1, 2, 3, 4, 5, 6, 7, 8, 9]));
        text.push(
            "Times per query with 95 % interval, tests are means per query, build is of both structures.".to_owned(),
        );
    }
    text.extend(run.results.iter().filter_map(note));
    if let Some(machine) = &run.environment {
        let null = units::time(machine.null_ns.value);
        let (cpu, class, clock) = (&machine.cpu, &machine.hardware_class, &machine.clock);
        text.push(format!("Measured on {cpu} (class {class}), clock {clock}, null round trip {null} subtracted."));
    }
    text.join("\n")
}

fn title(run: &RunInfo) -> String {
    let pair = format!("{} x {}", run.object_a_name, run.object_b_name);
    let set = run.set.as_ref().map_or_else(String::new, |set| format!(", {} configurations", set.configurations));
    let query = plugin::query_name(run.spec.query);
    let (distance, state) = (run.spec.relative_distance, run::state_name(run.state));
    format!("Run {}: {pair}, {query}, relative distance {distance}{set}: {state}", run.id)
}

fn row(result: &AlgorithmResult) -> Vec<String> {
    let time = |of: fn(&ocb_engine::model::TimeSummary) -> Estimated| {
        result.time.as_ref().map_or_else(dash, |summary| interval(&of(summary)))
    };
    vec![
        result.algorithm.clone(),
        format!("{} of {}", result.n, result.of),
        time(|t| t.median_ns),
        time(|t| t.p95_ns),
        time(|t| t.max_ns),
        wrong(result),
        result.bv_tests_mean.map_or_else(dash, units::mean),
        result.primitive_tests_mean.map_or_else(dash, units::mean),
        result.build_ms.map_or_else(dash, |ms| units::time(ms * 1e6)),
        result.memory_bytes.map_or_else(dash, units::bytes),
        result.outcome.name.clone(),
    ]
}

/// Nothing was measured: not the same as zero.
fn dash() -> String {
    "-".to_owned()
}

fn interval(estimated: &Estimated) -> String {
    let Estimated { value, lo, hi } = *estimated;
    format!("{} [{}, {}]", units::time(value), units::time(lo), units::time(hi))
}

fn wrong(result: &AlgorithmResult) -> String {
    // Zero wrong answers of nothing is no praise.
    if result.n == 0 {
        return dash();
    }
    match count(result, Verdict::FalseNegative) {
        0 => result.wrong.to_string(),
        missed => format!("{} ({missed} missed)", result.wrong),
    }
}

fn count(result: &AlgorithmResult, verdict: Verdict) -> u32 {
    result.verdicts.iter().filter(|entry| entry.verdict == verdict).map(|entry| entry.count).sum()
}

/// What the row cannot say.
fn note(result: &AlgorithmResult) -> Option<String> {
    let mut parts = Vec::new();
    if result.outcome.name != "Completed" {
        parts.push(result.outcome.message.clone());
    }
    if result.budget_limited {
        parts.push(format!("the time budget sufficed for {} of {} configurations", result.n, result.of));
    }
    for (verdict, words) in [
        (Verdict::FalseNegative, "collisions missed"),
        (Verdict::FalsePositive, "false alarms"),
        (Verdict::DistanceOver, "distances too large"),
        (Verdict::DistanceUnder, "distances too small"),
        (Verdict::WrongWitness, "wrong witnesses"),
        (Verdict::Invalid, "invalid answers"),
        (Verdict::Undecidable, "undecidable in its precision (not scored)"),
        (Verdict::GaveUp, "given up"),
        (Verdict::Unsupported, "unsupported"),
    ] {
        let count = count(result, verdict);
        if count > 0 {
            parts.push(format!("{count} {words}"));
        }
    }
    if let Some(below) = result.time.map(|time| time.below_resolution).filter(|below| *below > 0) {
        parts.push(format!("{below} times below the clock's resolution"));
    }
    (!parts.is_empty()).then(|| format!("{}: {}.", result.algorithm, parts.join("; ").trim_end_matches('.')))
}
