//! Time and answers in each unit of length, below the table of a run.

use ocb_service::model::{AlgorithmResult, Estimated, InUnit};

use crate::{output, units};

/// One row for each algorithm and unit; nothing for runs of older versions.
pub fn table(results: &[AlgorithmResult]) -> Option<String> {
    let rows: Vec<Vec<String>> =
        results.iter().flat_map(|result| result.by_unit.iter().map(|unit| row(&result.algorithm, unit))).collect();
    let headings = ["by unit", "coordinates", "processes", "n", "mean", "to file unit", "answers", "wrong", "missed"];
    (!rows.is_empty()).then(|| output::table(&headings, rows, &[1, 2, 3, 4, 5, 6, 7, 8]))
}

fn row(algorithm: &str, unit: &InUnit) -> Vec<String> {
    let dash = || "-".to_owned();
    let mean = |Estimated { value, lo, hi }| {
        let [value, lo, hi] = [value, lo, hi].map(units::time);
        format!("{value} [{lo}, {hi}]")
    };
    vec![
        algorithm.to_owned(),
        coordinates(unit.exponent),
        unit.processes.to_string(),
        unit.n.to_string(),
        unit.mean_ns.map_or_else(dash, mean),
        unit.pace.map_or_else(dash, |pace| format!("{:.2} ({:.2} to {:.2})", pace.value, pace.lo, pace.hi)),
        unit.answers.to_string(),
        unit.wrong.to_string(),
        unit.missed.to_string(),
    ]
}

fn coordinates(exponent: i32) -> String {
    let size = 2f64.powi(exponent.abs());
    match exponent {
        0 => "as in the file".to_owned(),
        1.. => format!("times {size}"),
        _ => format!("times 1/{size}"),
    }
}

/// Behind the outcome of an algorithm that depends on the unit.
pub fn mark(result: &AlgorithmResult) -> &'static str {
    if result.depends_on_unit.is_some() { ", depends on the unit" } else { "" }
}

/// The finding, and where the same is asked in many more units.
pub fn finding(result: &AlgorithmResult) -> Option<String> {
    let message = result.depends_on_unit.as_ref()?.message.trim_end_matches('.');
    let algorithm = &result.algorithm;
    Some(format!("{message} (further units: `ocb stability {algorithm} --family units --family unit`)"))
}

/// Answers are wrong in other units, and none in the unit of the files.
pub fn only_elsewhere(result: &AlgorithmResult) -> bool {
    let in_file = result.by_unit.iter().find(|unit| unit.exponent == 0);
    result.wrong > 0 && in_file.is_some_and(|unit| unit.wrong == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(wrong: [u32; 3]) -> AlgorithmResult {
        let unit = |(exponent, wrong): (i32, u32)| {
            serde_json::json!({
                "exponent": exponent, "processes": 2, "n": 9, "answers": 18, "wrong": wrong, "missed": 0,
                "mean_ns": { "value": 1500.0, "lo": 1000.0, "hi": 2000.0 }, "pace": { "value": 1.5, "lo": 1.25, "hi": 2.0 },
            })
        };
        let by_unit: Vec<serde_json::Value> = [0, -3, 3].into_iter().zip(wrong).map(unit).collect();
        let depends =
            serde_json::json!({ "time": [], "answers": [-3], "message": "Depends on the unit of length: so." });
        serde_json::from_value(serde_json::json!({
            "algorithm": "x", "name": "X", "outcome": { "name": "Completed", "message": "", "ours": false }, "n": 9, "of": 9,
            "budget_limited": false, "time": null, "verdicts": [], "wrong": wrong.iter().sum::<u32>(), "bv_tests_mean": null,
            "primitive_tests_mean": null, "build_ms": null, "memory_bytes": null,
            "by_unit": by_unit, "depends_on_unit": (wrong[1] > wrong[0]).then_some(depends),
        }))
        .unwrap()
    }

    #[test]
    fn every_unit_has_a_row_and_the_file_leads() {
        let text = table(&[result([0, 4, 0])]).unwrap();
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(rows[1][1..5], ["as", "in", "the", "file"]);
        assert_eq!(rows[2].join(" "), "x times 1/8 2 9 1.50 µs [1.00 µs, 2.00 µs] 1.50 (1.25 to 2.00) 18 4 0");
        assert_eq!(rows[3][1..3], ["times", "8"]);
        assert_eq!(table(&[]), None);
    }

    #[test]
    fn wrong_answers_of_other_units_alone_are_told_apart() {
        assert!(only_elsewhere(&result([0, 4, 0])));
        assert!(!only_elsewhere(&result([1, 4, 0])) && !only_elsewhere(&result([0, 0, 0])));
    }

    #[test]
    fn the_finding_leads_to_the_stability_lab() {
        let depends = result([0, 4, 0]);
        assert_eq!(mark(&depends), ", depends on the unit");
        let said = finding(&depends).unwrap();
        assert!(said.starts_with("Depends on the unit of length: so (") && said.contains("ocb stability x "), "{said}");
        assert_eq!((mark(&result([0, 0, 0])), finding(&result([0, 0, 0]))), ("", None));
    }
}
