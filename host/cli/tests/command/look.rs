//! Commands that only look, and help.

use std::path::Path;

use crate::support::Desk;

#[test]
fn plugins_are_listed_without_touching_the_data_folder() {
    let desk = Desk::new();
    let algorithms = desk.json(&["plugin", "list"]);
    let ids: Vec<&str> = algorithms.as_array().expect("a list").iter().filter_map(|one| one["id"].as_str()).collect();
    for id in ["box-tree", "brute-force", "parry"] {
        assert!(ids.contains(&id), "{ids:?}");
    }
    assert!(desk.run(&["plugin", "list"]).stdout.contains("box-tree"));
    assert!(!desk.path("data").exists());
}

#[test]
fn our_own_plugins_pass_the_check() {
    let desk = Desk::new();
    let folder = Path::new(env!("CARGO_BIN_EXE_ocb")).parent().expect("a folder");
    for plugin in ["libocb_box_tree.so", "libocb_brute_force.so", "libocb_parry.so"] {
        let file = folder.join(plugin).display().to_string();
        let report = desk.json(&["plugin", "check", &file]);
        assert_eq!(report["passed"], true, "{report:#}");
        assert_eq!(report["algorithms"].as_array().map(Vec::len), Some(1), "{report:#}");
    }
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
fn help_says_what_exit_codes_mean() {
    let desk = Desk::new();
    let ended = desk.run(&["--help"]);
    assert_eq!(ended.code, 0);
    for word in ["bench", "plugin", "object", "heatmap", "serve", "Exit codes", "130"] {
        assert!(ended.stdout.contains(word), "{word}");
    }
    let version = desk.run(&["--version"]);
    assert_eq!(version.stdout.trim(), format!("ocb {}", env!("CARGO_PKG_VERSION")));
}
