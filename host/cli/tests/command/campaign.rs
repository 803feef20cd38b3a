//! `ocb campaign`: the suite measured again on another hardware class.

use std::path::Path;

use crate::support::Desk;

#[test]
fn the_suite_is_measured_again_for_another_class_and_compared() {
    let desk = Desk::new();
    let document = serde_json::json!({
        "version": 5, "scenes": [["stock:torus-knot@600", "stock:torus-knot@600"]],
        "separations": [{ "kind": "relative", "distance": 0.1 }], "queries": ["collision_first"],
        "configurations": 20, "seed": 1, "passes": 1, "budget_seconds": 5.0,
    });
    let suite = desk.file("suite.json", document.to_string());
    let built = Path::new(env!("CARGO_BIN_EXE_ocb")).parent().expect("a folder");
    let plugins = ["libocb_box_tree.so", "libocb_brute_force.so"].map(|name| built.join(name).display().to_string());
    let on = |note: &'static str, args: &[&'static str]| -> Vec<String> {
        let here = ["--suite-file", &suite, "--plugins", &plugins[0], "--plugins", &plugins[1], "--machine-note", note];
        args.iter().chain(&here).map(|arg| (*arg).to_owned()).collect()
    };
    let json = |args: Vec<String>| desk.json(&args.iter().map(String::as_str).collect::<Vec<_>>());
    let text = |args: Vec<String>| desk.run(&args.iter().map(String::as_str).collect::<Vec<_>>());

    json(on("turbo on", &["suite", "run"]));
    assert_eq!(
        text(on("turbo on", &["campaign", "list"])).stdout,
        "No campaigns yet; `ocb campaign create` makes one.\n"
    );
    let nothing = text(on("turbo on", &["campaign", "create", "--reason", "x"]));
    assert!(nothing.code != 0 && nothing.stderr.contains("nothing to measure again"), "{nothing:?}");
    let preview = json(on("turbo off", &["campaign", "create", "--dry-run"]));
    assert_eq!(
        (&preview["suite_runs"], &preview["suite_repeats"], &preview["peoples_runs"]),
        (&1.into(), &1.into(), &0.into())
    );
    let told = text(on("turbo off", &["campaign", "create", "--dry-run"])).stdout;
    assert!(told.starts_with("1 runs of suite 5 (1 of them") && told.contains("is expected to take "), "{told}");

    // Queued by one command, cancelled by another; then measured to its end.
    let made = json(on("turbo off", &["campaign", "create", "--reason", "Turbo is off now", "--only", "suite"]));
    assert_eq!((&made["state"], &made["runs"]["waiting"]), (&"running".into(), &1.into()));
    let cancelled = json(on("turbo off", &["campaign", "cancel", "latest"]));
    assert_eq!((&cancelled["id"], &cancelled["state"]), (&made["id"], &"cancelled".into()));
    let made = json(on("turbo off", &["campaign", "create", "--reason", "Turbo is off now", "--measure"]));
    assert_eq!((&made["state"], &made["runs"]["done"]), (&"done".into(), &1.into()));
    let results = made["results"].as_array().expect("results");
    let sides = |row: &serde_json::Value| {
        row["old"]["hardware_class"] != row["new"]["hardware_class"] && row["ratio"]["value"].is_f64()
    };
    assert!(results.len() == 2 && results.iter().all(sides), "{made:#}");

    let file = desk.path("old-and-new.csv");
    let shown = text(on("turbo off", &["campaign", "show", "latest"]));
    assert!(shown.stdout.contains("Turbo is off now") && shown.stdout.contains("box-tree"), "{shown:?}");
    let args = [on("turbo off", &["campaign", "show", "latest", "-o"]), vec![file.display().to_string()]].concat();
    // The file's name belongs behind `-o`.
    let args = [&args[..4], &args[args.len() - 1..], &args[4..args.len() - 1]].concat();
    json(args);
    let csv = std::fs::read_to_string(&file).expect("a file");
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    assert!(
        ["old_median_ns", "new_median_ns_hi", "ratio", "new_oracle"].iter().all(|name| header.contains(name)),
        "{csv}"
    );
    assert_eq!(lines.count(), 2);
    let listed = text(on("turbo off", &["campaign", "list"])).stdout;
    assert!(listed.contains("cancelled") && listed.contains("done"), "{listed}");
    assert!(desk.refused(&["campaign", "show", "latest", "-o", "x.txt"]).contains(".csv or .json"));
    assert!(desk.refused(&["campaign", "create"]).contains("--reason"));
}
