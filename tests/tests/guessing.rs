//! A plugin that guesses has no rank, whatever the set's one truth is, and the honest ones beside it keep theirs.

use std::fs;
use std::path::Path;
use std::process::Command;

use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};
use serde_json::Value;

const HONEST: [(&str, &str); 4] = [
    ("box-tree", "libocb_box_tree.so"),
    ("ocb-fast", "libocb_fast.so"),
    ("parry", "libocb_parry.so"),
    ("brute-force", "libocb_brute_force.so"),
];

/// So many that a guess that passes all of their controls is far from likely.
const CONFIGURATIONS: u32 = 120;

/// The command with these plugins and the one that guesses beside it, where all are measured like those that ship.
fn house(folder: &Path) {
    let release = built("ocb-runner");
    let arguments = ["build", "--release", "--locked", "--workspace", "--example", "guesser"];
    output(command(env!("CARGO")).current_dir(root()).args(arguments));
    let guesser = release.with_file_name("examples").join("libguesser.so");
    for file in ["ocb", "ocb-runner"].into_iter().chain(HONEST.map(|(_, file)| file)) {
        fs::copy(built(file), folder.join(file)).expect("copied");
    }
    fs::copy(guesser, folder.join("libguesser.so")).expect("copied");
    fs::write(folder.join("torus.obj"), torus()).expect("written");
}

/// A torus of 120 triangles: brute force has to answer thousands of questions.
fn torus() -> String {
    const AROUND: [usize; 2] = [10, 6];
    let at = |i: usize, j: usize| {
        let [u, v] = [(i, AROUND[0]), (j, AROUND[1])].map(|(k, n)| std::f64::consts::TAU * k as f64 / n as f64);
        let from_axis = 1.0 + 0.4 * v.cos();
        format!("v {} {} {}\n", from_axis * u.cos(), from_axis * u.sin(), 0.4 * v.sin())
    };
    let number = |i: usize, j: usize| 1 + i % AROUND[0] * AROUND[1] + j % AROUND[1];
    let face = |i: usize, j: usize| {
        format!("f {} {} {} {}\n", number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1))
    };
    let all = || (0..AROUND[0]).flat_map(|i| (0..AROUND[1]).map(move |j| (i, j)));
    all().map(|(i, j)| at(i, j)).chain(all().map(|(i, j)| face(i, j))).collect()
}

/// The results of a run, by algorithm.
fn results(folder: &Path, words: &[&str]) -> Value {
    let algorithms = HONEST.map(|(id, _)| id).join(",") + ",guesser";
    let mut ocb = command(folder.join("ocb"));
    ocb.arg("--data").arg(folder.join("data")).args(["--json", "bench"]).arg(folder.join("torus.obj"));
    let count = CONFIGURATIONS.to_string();
    ocb.args(["--count", &count, "--passes", "2", "--budget", "120", "--run-seed", "7", "--algorithm", &algorithms]);
    measured(ocb.args(words))
}

/// The results, although wrong answers end the command with another code than 0.
fn measured(ocb: &mut Command) -> Value {
    let done = ocb.output().expect("ocb runs");
    let run: Value = serde_json::from_slice(&done.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&done.stderr)));
    run["results"].clone()
}

#[test]
fn a_plugin_that_guesses_has_no_rank_and_honest_ones_keep_theirs() {
    let folder = tempfile::tempdir().expect("a folder");
    house(folder.path());
    for words in [
        // All apart, at one distance, and all crossing.
        &["--query", "cd", "--distance", "0.05"][..],
        &["--query", "cd", "--step", "-0.01"],
        // Distances that are the same in single precision, one distance, and all of them 0.
        &["--query", "pq", "--distance", "0"],
        &["--query", "pq", "--distance", "0.05"],
        &["--query", "pq", "--step", "-0.01"],
        // Each near the one before, which is part of the question.
        &["--query", "cd", "--method", "trajectory", "--center-distance", "2"],
    ] {
        let results = results(folder.path(), words);
        for result in results.as_array().expect("results") {
            let (id, controls) = (result["algorithm"].as_str().expect("an id"), &result["controls"]);
            println!("{words:?} {id}: rank {}, controls {controls}", result["rank"]);
            assert_eq!(result["outcome"]["name"], "Completed", "{words:?}: {result:#}");
            assert_eq!((&result["n"], &controls["n"]), (&CONFIGURATIONS.into(), &30.into()), "{words:?}: {result:#}");
            assert!(controls["guess"].as_f64().is_some_and(|guess| guess < 1e-3), "{words:?}: {controls}");
            if id == "guesser" {
                assert_eq!(result["rank"], Value::Null, "{words:?}: {result:#}");
                assert_eq!(result["unranked"]["cause"], "wrong_controls", "{words:?}: {result:#}");
                let message = result["unranked"]["message"].as_str().expect("a sentence");
                assert!(message.contains("of 30 control questions were answered wrongly"), "{message}");
            } else {
                assert_eq!((&controls["wrong"], &controls["silent"]), (&0.into(), &0.into()), "{words:?}: {result:#}");
                assert!(result["rank"].is_number() && result["unranked"].is_null(), "{words:?}: {result:#}");
            }
        }
    }
}

#[test]
fn too_few_controls_within_the_budget_are_no_rank_either() {
    let folder = tempfile::tempdir().expect("a folder");
    house(folder.path());
    let mut ocb = command(folder.path().join("ocb"));
    ocb.arg("--data").arg(folder.path().join("data")).args(["--json", "bench", "stock:torus-knot@60000"]);
    ocb.args([
        "--count",
        "96",
        "--passes",
        "2",
        "--budget",
        "0.4",
        "--distance",
        "0.05",
        "--algorithm",
        "box-tree,brute-force",
    ]);
    let run = measured(&mut ocb);
    let result = |id: &str| run.as_array().expect("results").iter().find(|r| r["algorithm"] == id).cloned();
    let slow = result("brute-force").expect("a result");
    assert_eq!((&slow["rank"], &slow["unranked"]["cause"]), (&Value::Null, &"few_controls".into()), "{slow:#}");
    assert_eq!(slow["outcome"]["name"], "Completed");
    assert!(result("box-tree").expect("a result")["rank"].is_number(), "{run:#}");
}
