//! Every plugin of this repository passes `ocb plugin check`, except for the lines that its `known-failures.txt` lists, which
//! fail: what approximates on purpose does not agree with the reference, and its README says where and why.

use std::collections::BTreeSet;

use ocb_tests::place::{built, root, text, tracked};
use ocb_tests::process::command;
use serde_json::Value;

/// Folder and library of each plugin that is a member of the workspace.
fn plugins() -> Vec<(String, String)> {
    let manifests = tracked().into_iter().filter(|p| p.starts_with("plugins") && p.ends_with("Cargo.toml"));
    let libraries = manifests.filter_map(|path| {
        let manifest = text(&path).filter(|text| text.contains("\"cdylib\""))?;
        let name =
            manifest.lines().find_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"'))?.replace('-', "_");
        Some((path.parent()?.to_string_lossy().into_owned(), format!("lib{name}.so")))
    });
    libraries.collect()
}

#[test]
fn exactly_the_known_failures_fail() {
    let plugins = plugins();
    assert!(plugins.len() >= 10, "{plugins:?}");
    for (folder, library) in plugins {
        let known = std::fs::read_to_string(root().join(&folder).join("known-failures.txt")).unwrap_or_default();
        let known: BTreeSet<&str> = known.lines().collect();
        // A plugin with failures ends the check with an exit code that says so.
        let answer = command(built("ocb")).args(["plugin", "check", "--quick", "--json"]).arg(built(&library)).output();
        let answer = answer.expect("ocb starts");
        let report: Value = serde_json::from_slice(&answer.stdout)
            .unwrap_or_else(|e| panic!("{library}: {e}: {}", String::from_utf8_lossy(&answer.stderr)));
        let lines = report["lines"].as_array().expect("lines");
        let failed = lines.iter().filter(|line| line["verdict"] == "fail");
        let failed: BTreeSet<&str> = failed.map(|line| line["check"].as_str().expect("a name")).collect();
        assert!(lines.len() > 5, "{library}: {report:#}");
        assert_eq!(failed, known, "{folder}/known-failures.txt lists other lines than fail: {report:#}");
    }
}
