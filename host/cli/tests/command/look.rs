//! Commands that only look, and help.

use crate::support::Desk;

#[test]
fn plugins_are_listed_without_touching_the_data_folder() {
    let desk = Desk::with(&[]);
    let algorithms = desk.json(&["plugin", "list"]);
    let ids: Vec<&str> = algorithms.as_array().expect("a list").iter().filter_map(|one| one["id"].as_str()).collect();
    for id in ["box-tree", "brute-force", "parry"] {
        assert!(ids.contains(&id), "{ids:?}");
    }
    let some = Desk::new();
    assert!(some.run(&["plugin", "list"]).stdout.contains("box-tree"));
    assert!(!desk.path("data").exists() && !some.path("data").exists());
}

#[test]
fn objects_are_listed() {
    let desk = Desk::new();
    let objects = desk.json(&["object", "list"]);
    let objects = objects.as_array().expect("a list");
    assert!(objects.iter().any(|object| object["id"].as_str().is_some_and(|id| id.starts_with("stock:torus-knot"))));
    let text = desk.run(&["object", "list"]).stdout;
    assert!(text.contains("stock:castle"), "{text}");
}

#[test]
fn configurations_are_selected_listed_and_subtracted_by_the_same_words() {
    let desk = Desk::new();
    let bench =
        ["bench", "stock:torus-knot@600", "--algorithm", "box-tree,brute-force", "--count", "30", "--passes", "1"];
    desk.json(&bench);
    let selected = desk.json(&["select", "latest", "--algorithm", "box-tree", "--where", "near(vertex 0,0.4)&!wrong"]);
    assert_eq!(selected["where"], "near(vertex 0, 0.4) & !wrong");
    let n = selected["n"].as_u64().expect("a count");
    assert!(0 < n && n < 30, "{selected:#}");
    let (csv, chosen) = (desk.path("some.csv"), "near(vertex 0, 0.4)");
    let file = csv.to_str().expect("text");
    let text = desk.run(&["select", "latest", "--algorithm", "box-tree", "--where", chosen, "-o", file]).stdout;
    assert!(text.starts_with(&format!("{n} of 30 configurations: {chosen}")), "{text}");
    assert_eq!(std::fs::read_to_string(&csv).expect("a file").lines().count() as u64, n + 1);
    let worst = desk.json(&["worst", "latest", "--algorithm", "box-tree", "--where", chosen]);
    assert_eq!(worst.as_array().expect("a list").len() as u64, n);
    let table = desk.run(&["worst", "latest", "--algorithm", "brute-force", "--limit", "2"]).stdout;
    assert_eq!(table.lines().count(), 3, "{table}");

    let spread = desk.path("spread.csv");
    let args = ["chart", "latest", "--kind", "ecdf", "--where", chosen, "--algorithm", "box-tree", "-o"];
    desk.json(&[&args[..], &[spread.to_str().expect("text")]].concat());
    let spread = std::fs::read_to_string(&spread).expect("a file");
    let mut rows = spread.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let column = rows.next().and_then(|header| header.iter().position(|name| *name == "n")).expect("a column n");
    let counts: Vec<&str> = rows.map(|row| row[column]).collect();
    assert!(!counts.is_empty() && counts.iter().all(|count| *count == n.to_string()), "{n}: {spread}");

    let map = desk.path("difference.csv");
    let file = map.to_str().expect("text");
    let against = ["--algorithm", "box-tree", "--against", "brute-force", "--measure", "wrong", "-o", file];
    desk.json(&[&["heatmap", "latest"], &against[..]].concat());
    let values = std::fs::read_to_string(&map).expect("a file");
    assert!(values.starts_with("vertex,value_share,count,dropped\n"), "{values}");
    assert!(values.lines().any(|line| line.split(',').nth(1) == Some("0")), "zero is a value: {values}");
    let refused = desk.refused(&["select", "latest", "--algorithm", "box-tree", "--where", "tame"]);
    assert!(refused.contains("at character 1"), "{refused}");
}

#[test]
fn help_says_what_exit_codes_mean() {
    let desk = Desk::new();
    let ended = desk.run(&["--help"]);
    assert_eq!(ended.code, 0);
    for word in ["bench", "plugin", "object", "heatmap", "select", "worst", "serve", "Exit codes", "130"] {
        assert!(ended.stdout.contains(word), "{word}");
    }
    let version = desk.run(&["--version"]);
    assert_eq!(version.stdout.trim(), format!("ocb {}", env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_doctor_tells_what_the_machine_has() {
    let desk = Desk::new();
    let ended = desk.run(&["doctor", "--json"]);
    let diagnosis: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
    let facilities = diagnosis["facilities"].as_array().unwrap();
    assert!(facilities.len() >= 12, "{diagnosis:#}");
    // The exit code is the answer for the chosen profile.
    assert_eq!(ended.code == 0, diagnosis["production"].as_bool().unwrap());
    assert_eq!(desk.run(&["doctor", "--profile", "dev"]).code == 0, diagnosis["dev"].as_bool().unwrap());
    let text = desk.run(&["doctor"]).stdout;
    for facility in facilities {
        let name = facility["name"].as_str().unwrap();
        let line =
            text.lines().find(|line| line.contains(&format!("  {name}: "))).unwrap_or_else(|| panic!("{name}: {text}"));
        assert!(line.contains(facility["effect"].as_str().unwrap()), "{line}");
        assert_eq!(line.contains("to get it: "), facility["state"] != "good", "{line}");
    }
}
