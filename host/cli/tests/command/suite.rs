//! The public benchmark by hand: what is missing is measured, and nothing twice.

use serde_json::{Value, json};

use crate::support::Desk;

/// The file of a suite with two scenarios, and so many seconds for each algorithm.
fn file(desk: &Desk, version: u32, object: &str, budget_seconds: f64) -> String {
    let document = json!({
        "version": version, "scenes": [[object, object]],
        "separations": [{ "kind": "relative", "distance": 0.1 }, { "kind": "step", "of_size": -0.01 }],
        "queries": ["collision_first"], "configurations": 30, "seed": 7, "passes": 1, "budget_seconds": budget_seconds,
    });
    desk.file(&format!("suite-{version}.json"), document.to_string())
}

/// How many scenarios are measured of this algorithm.
fn measured(desk: &Desk, suite: &str, algorithm: &str) -> Value {
    let shown = desk.json(&["suite", "show", "--suite-file", suite]);
    let all = shown["progress"].as_array().expect("progress");
    all.iter().find(|one| one["algorithm"] == algorithm).expect("the algorithm")["measured"].clone()
}

#[test]
fn what_is_missing_of_the_suite_is_measured_once() {
    let desk = Desk::new();
    let suite = file(&desk, 3, "stock:torus-knot@600", 20.0);
    let shown = desk.run(&["suite", "show", "--suite-file", &suite]).stdout;
    assert!(shown.starts_with("Suite 3 (") && shown.contains("2 scenarios of 30 configurations"), "{shown}");
    assert!(shown.contains("relative distance 0.1, step -1e-2 of S"), "{shown}");

    let run = ["suite", "run", "--suite-file", &suite, "--algorithm", "box-tree"];
    let first = desk.run(&run);
    assert_eq!(first.code, 0, "{first:?}");
    assert!(first.stderr.contains("2 runs of the suite are missing here"), "{}", first.stderr);
    assert!(first.stderr.contains("2 of 2: ") && first.stderr.contains("box-tree: done"), "{}", first.stderr);
    assert!(first.stdout.contains("box-tree") && !first.stdout.contains("brute-force"), "{}", first.stdout);
    assert_eq!(measured(&desk, &suite, "box-tree"), 2);
    assert_eq!(measured(&desk, &suite, "brute-force"), 0);
    let again = desk.run(&run);
    assert!(again.code == 0 && again.stderr.contains("0 runs of the suite are missing"), "{again:?}");

    let board = desk.json(&["suite", "run", "--suite-file", &suite, "--algorithm", "brute-force"]);
    let ranks = |id: &str| board["rows"].as_array().expect("rows").iter().find(|row| row["algorithm"] == id).cloned();
    for id in ["box-tree", "brute-force"] {
        let row = ranks(id).unwrap_or_else(|| panic!("{id} in {board:#}"));
        assert!(row["n"] == 60 && row["wrong"] == 0 && row["rank"].is_u64(), "{row:#}");
    }

    assert!(desk.refused(&["suite", "run", "--algorithm", "nonsense"]).contains("\"nonsense\""));
    assert!(desk.refused(&["suite", "show", "--suite-file", "/nonexistent.json"]).contains("/nonexistent.json"));
}

#[test]
fn who_had_no_time_is_asked_again() {
    let desk = Desk::new();
    // Over before the first question is asked.
    let suite = file(&desk, 4, "stock:torus-knot@600", 1e-9);
    let both = ["suite", "run", "--suite-file", &suite, "--algorithm", "ocb-fast,brute-force"];
    let first = desk.run(&both);
    assert!(first.stderr.contains("2 of 2: ") && first.stderr.contains("failed"), "{}", first.stderr);
    assert_eq!(measured(&desk, &suite, "brute-force"), 0);
    let again = desk.run(&["suite", "run", "--suite-file", &suite, "--algorithm", "brute-force"]);
    assert!(again.stderr.contains("2 runs of the suite are missing here"), "{}", again.stderr);
}
