//! The 65,536-triangle bunny against itself, in configurations whose answers other programs have certified.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ocb_tests::place::{built, shared};
use ocb_tests::process::{command, output};
use serde_json::Value;

/// Measuring seconds per algorithm: far more than one pass over all needs on any machine.
const BUDGET: &str = "120";

/// Configurations of a set.
const ALL: usize = 1000;

/// So many of a set are measured, at equal distances.
fn count() -> usize {
    std::env::var("OCB_REAL_INPUT").map_or(250, |number| number.parse().expect("OCB_REAL_INPUT is a number"))
}

/// Their places in the set.
fn chosen() -> impl Iterator<Item = usize> {
    let count = count();
    assert!((1..=ALL).contains(&count), "OCB_REAL_INPUT is {count}, not a number from 1 to {ALL}");
    (0..count).map(move |i| i * ALL / count)
}

/// What is known of a set of configurations.
enum Known {
    /// All of them collide.
    Colliding,
    /// None collides; distances from FCL, equal to those of PQP, coal and an independent program within 9e-13 relative.
    Apart(Vec<f64>),
}

fn known(set: &str) -> Known {
    if set == "W3" {
        return Known::Colliding;
    }
    let bytes = std::fs::read(shared(&format!("configurations/bunny65k.{set}.distance.f64"))).expect("distances");
    let all: Vec<f64> = bytes.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().expect("8 bytes"))).collect();
    assert_eq!(all.len(), ALL, "{set}");
    Known::Apart(chosen().map(|i| all[i]).collect())
}

/// A file with the configurations that are measured.
fn part(set: &str, folder: &Path) -> PathBuf {
    let all = std::fs::read(shared(&format!("configurations/bunny65k.{set}.f64"))).expect("configurations");
    let file = folder.join(format!("{set}.f64"));
    let all: Vec<&[u8]> = all.chunks_exact(128).collect();
    std::fs::write(&file, chosen().map(|i| all[i]).collect::<Vec<_>>().concat()).expect("written");
    file
}

/// Those that are asked. Parry is not: an instance that is scaled down may meet its absolute tolerance, and its false alarm
/// would be no fault of ours. Nor is brute force, which takes a second for a question of this size. Others have tests of
/// their own.
const ALGORITHMS: [&str; 2] = ["box-tree", "ocb-fast"];

/// The bunny with the coordinates that the other programs had: in single precision.
fn bunny(folder: &Path) -> PathBuf {
    let text = std::fs::read_to_string(shared("meshes/bunny65k.obj")).expect("an object");
    let rounded = text.lines().map(|line| match line.strip_prefix("v ") {
        Some(rest) => {
            let number = |word: &str| f64::from(word.parse::<f64>().expect("a number") as f32).to_string();
            format!("v {}\n", rest.split_whitespace().map(number).collect::<Vec<_>>().join(" "))
        }
        None => format!("{line}\n"),
    });
    let file = folder.join("bunny65k.obj");
    std::fs::write(&file, rounded.collect::<String>()).expect("written");
    file
}

/// `ocb bench` on the set with these algorithms; gives the run and, per algorithm, the records by column.
fn bench(set: &str, query: &str) -> (Value, BTreeMap<String, Vec<BTreeMap<String, String>>>) {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let mut bench = command(built("ocb"));
    bench
        .arg("bench")
        .arg(bunny(folder.path()))
        .args(["--query", query, "--budget", BUDGET, "--passes", "1", "--json"]);
    bench.arg("--configurations").arg(part(set, folder.path()));
    bench.args(ALGORITHMS.into_iter().flat_map(|name| ["--algorithm", name]));
    bench.arg("--out").arg(&out).arg("--data").arg(folder.path().join("data"));
    let run: Value = serde_json::from_str(&output(&mut bench)).expect("--json prints JSON");
    let names =
        run["results"].as_array().expect("results").iter().map(|r| r["algorithm"].as_str().expect("a name").to_owned());
    let records = names.map(|name| {
        let text = std::fs::read_to_string(out.join(format!("{name}.csv")))
            .unwrap_or_else(|e| panic!("records of {name}: {e}"));
        (name, rows(&text))
    });
    let records = records.collect();
    (run, records)
}

fn rows(csv: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = csv.lines().filter(|l| !l.starts_with('#'));
    let header: Vec<String> = lines.next().expect("a header").split(',').map(str::to_owned).collect();
    lines.map(|l| header.iter().cloned().zip(l.split(',').map(str::to_owned)).collect()).collect()
}

/// All algorithms answered all that was asked of the set, none wrongly.
fn check_run(run: &Value, set: &str, query: &str) {
    let count = count() as u64;
    assert_eq!(run["set"]["configurations"], count, "{set}");
    let results = run["results"].as_array().expect("results");
    assert_eq!(results.len(), ALGORITHMS.len(), "{set} {query}");
    for r in results {
        let (name, n) = (r["algorithm"].as_str().expect("a name"), r["n"].as_u64().expect("n"));
        println!("{set} {query} {name}: {n} of {count} configurations, wrong {}", r["wrong"]);
        assert_eq!(r["outcome"]["name"], "Completed", "{set} {query} {name}: {}", r["outcome"]["message"]);
        assert_eq!(r["wrong"], 0, "{set} {query} {name}: {}", r["verdicts"]);
        assert_eq!(n, count, "{set} {query} {name}: not all of the configurations measured");
    }
}

#[test]
fn collision_answers_equal_the_known_ones() {
    for set in ["W1", "W2", "W3"] {
        let (run, records) = bench(set, "cd");
        check_run(&run, set, "cd");
        let expected = if matches!(known(set), Known::Colliding) { "true" } else { "false" };
        for (name, rows) in records {
            assert!(!rows.is_empty(), "{set} {name}");
            for row in rows {
                assert_eq!(row["hit"], expected, "{set} {name} configuration {}", row["configuration"]);
            }
        }
    }
}

#[test]
fn distances_equal_the_known_ones() {
    for set in ["W1", "W2", "W3"] {
        let (run, records) = bench(set, "pq");
        check_run(&run, set, "pq");
        let known = known(set);
        for (name, rows) in records {
            assert!(!rows.is_empty(), "{set} {name}");
            for row in rows {
                let i: usize = row["configuration"].parse().expect("an index");
                let distance: f64 = row["distance"].parse().expect("a distance");
                let expected = if let Known::Apart(all) = &known { all[i] } else { 0.0 };
                // The bounding box has diagonal 1: coordinates carry errors of about 1e-16, distances of 1e-4 and more.
                assert!(
                    (distance - expected).abs() <= 1e-11 * expected.max(1e-2),
                    "{set} {name} configuration {i}: {distance} is not {expected}"
                );
            }
        }
    }
}
