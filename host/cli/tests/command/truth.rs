//! `ocb truth`: certified answers without a store.

use std::io::{BufRead, BufReader};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::support::Desk;

/// A floor, a triangle half above it, and one that stands in it.
const PAIRS: &str = "# two cases
over demo 1 1 0 0 0 4 0 0 0 4 0 1 1 0x1p-1 2 1 2 1 2 2 | 0 0.5 0 4
through demo 1 1 0 0 0 4 0 0 0 4 0 1 1 -1 1 1 1 1 1.5 1 | 1 0
0 0 0 4 0 0 0 4 0 1 1 0.5 2 1 2 1 2 2 1 0 0 0 1 0 0 0 1 0 0 -0.25
";
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn pairs_are_answered_in_every_format() {
    let desk = Desk::new();
    let file = desk.file("pairs.txt", PAIRS);
    let table = desk.run(&["truth", "pairs", &file]);
    assert_eq!(table.code, 0, "{table:?}");
    for word in ["over", "through", "hit", "apart", "5e-1", "exact", "0 of 2 differ"] {
        assert!(table.stdout.contains(word), "{word}: {}", table.stdout);
    }
    let rows = desk.json(&["truth", "pairs", &file]);
    assert_eq!(
        (&rows[0]["index"], &rows[0]["distance_lo"], &rows[0]["class64"]),
        (&2.into(), &0.5.into(), &"clear".into())
    );
    assert_eq!((&rows[1]["hit"], &rows[1]["name"], &rows[1]["differs"]), (&true.into(), &"through".into(), &"".into()));
    assert_eq!((&rows[2]["distance_hi"], &rows[2]["name"]), (&0.25.into(), &serde_json::Value::Null));

    let csv = desk.path("out.csv").display().to_string();
    let said = desk.json(&["truth", "pairs", &file, "-o", &csv]);
    assert_eq!((&said["rows"], &said["hits"]), (&3.into(), &1.into()));
    let text = std::fs::read_to_string(&csv).expect("the file");
    assert!(text.starts_with("line,name,family,hit,distance_lo"), "{text}");
    assert_eq!(text.lines().count(), 4);
    let parquet = desk.path("out.parquet").display().to_string();
    desk.json(&["truth", "pairs", &file, "-o", &parquet]);
    assert!(std::fs::read(&parquet).expect("the file").starts_with(b"PAR1"));
    assert!(!desk.path("data").exists(), "nothing is kept");
}

#[test]
fn lines_that_differ_are_named() {
    let desk = Desk::new();
    let file = desk.file("pairs.txt", PAIRS.replace("| 0 0.5 0 4", "| 1 0 1 4"));
    let ended = desk.run(&["truth", "pairs", &file]);
    assert_eq!(ended.code, 1, "{ended:?}");
    assert_eq!(ended.stderr.lines().count(), 1, "{}", ended.stderr);
    for word in ["line 2 (over)", "no hit", "distance", "margin"] {
        assert!(ended.stderr.contains(word), "{word}: {}", ended.stderr);
    }
}

/// B shifted along x: inside each other, apart by one, far away.
fn poses(desk: &Desk) -> String {
    let pose = |x: f64| [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.25, 0.0, 0.0, 1.0, 0.25, 0.0, 0.0, 0.0, 1.0];
    let bytes: Vec<u8> = [0.25, 2.0, 50.0].into_iter().flat_map(pose).flat_map(f64::to_le_bytes).collect();
    desk.file("poses.f64", bytes)
}

#[test]
fn configurations_are_answered_as_far_as_asked() {
    let desk = Desk::new();
    let (a, poses) = (desk.file("a.obj", TETRAHEDRON), poses(&desk));
    let ask = |query: &str| desk.json(&["truth", &a, "--configurations", &poses, "--query", query]);
    let all = ask("pq");
    assert_eq!(all.as_array().expect("rows").len(), 3);
    assert_eq!((&all[0]["hit"], &all[1]["hit"]), (&true.into(), &false.into()));
    let (lo, hi) =
        (all[1]["distance_lo"].as_f64().expect("a number"), all[1]["distance_hi"].as_f64().expect("a number"));
    assert!(lo <= hi && lo > 1.0 && hi < 1.2, "[{lo}, {hi}]");
    assert_eq!(all[1]["containment"], "apart");
    let decisions = ask("cd");
    for (one, other) in all.as_array().into_iter().flatten().zip(decisions.as_array().into_iter().flatten()) {
        for key in ["hit", "margin", "class64", "class32", "containment"] {
            assert_eq!(one[key], other[key], "{key}");
        }
        assert!(other["distance_lo"].is_null());
    }
    let contacts = ask("all");
    assert!(contacts[0]["contacts"].as_array().is_some_and(|c| c.len() > 1), "{contacts:#}");
    assert_eq!(contacts[1]["contacts"], serde_json::json!([]));

    let csv = desk.path("contacts.csv").display().to_string();
    let args = ["truth", &a, &a, "--configurations", &poses, "--query", "all", "-o", &csv];
    assert_eq!(desk.run(&args).code, 0);
    let text = std::fs::read_to_string(&csv).expect("the file");
    assert!(text.starts_with("configuration,triangle_a,triangle_b,margin\n0,"), "{text}");
    assert!(!desk.path("data").exists(), "nothing is kept");
}

#[test]
fn bad_questions_are_refused_in_one_sentence() {
    let desk = Desk::new();
    let (a, poses, pairs) = (desk.file("a.obj", TETRAHEDRON), poses(&desk), desk.file("pairs.txt", PAIRS));
    let bad = desk.file("bad.txt", "x y 1 1 1 2 3");
    let cases: [(&[&str], &str); 8] = [
        (&["pairs", &bad], "line 1: 1 + 1 triangles need 18 coordinates, not 3"),
        (&["pairs", "missing.txt"], "missing.txt"),
        (&["pairs", &pairs, "-o", "out.txt"], ".parquet, .csv or .json"),
        (&[&a], "--configurations"),
        (&[], "--configurations"),
        (&[&a, "--configurations", &a], "Not a configuration file"),
        (&[&a, "--configurations", &poses, "--query", "pd"], "pd"),
        (&["stock:unicorn@100", "--configurations", &poses], "unicorn"),
    ];
    for (args, expected) in cases {
        let sentence = desk.refused(&[&["truth"], args].concat());
        assert!(sentence.contains(expected), "{args:?}: {sentence}");
    }
}

#[test]
fn an_interrupt_stops_it_and_writes_nothing() {
    let desk = Desk::new();
    let (out, mut bytes) = (desk.path("out.csv"), Vec::new());
    for i in 0..400_000u32 {
        let x = 1.5 + f64::from(i) * 1e-6;
        let pose = [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        bytes.extend(pose.into_iter().flat_map(f64::to_le_bytes));
    }
    let poses = desk.file("many.f64", bytes);
    let file = out.display().to_string();
    let args = ["truth", "stock:torus-knot@60000", "--configurations", &poses, "-o", &file];
    let mut child = desk.command(&args).spawn().expect("it starts");
    let stderr = BufReader::new(child.stderr.take().expect("stderr"));
    let mut lines = stderr.lines().map_while(Result::ok);
    assert!(lines.any(|line| line.starts_with("configurations: ")), "it reports its progress");
    kill(Pid::from_raw(i32::try_from(child.id()).expect("a pid")), Signal::SIGINT).expect("it runs");
    let last = lines.last().unwrap_or_default();
    assert_eq!(child.wait().expect("it ends").code(), Some(130), "{last}");
    assert!(last.contains("Stopped after") && !out.exists(), "{last}");
}

#[test]
fn truth_is_about_the_numbers_of_the_file_or_about_their_rounding() {
    let desk = Desk::new();
    // Two floors a hundredth apart, near 10^6: in single precision they are one.
    let floor = |z: f64| format!("v 0 0 {z}\nv 4 0 {z}\nv 0 4 {z}\nf 1 2 3\n");
    let (a, b) = (desk.file("a.obj", floor(1e6 + 0.01)), desk.file("b.obj", floor(1e6 + 0.02)));
    let still = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let pose = desk.file("still.f64", still.into_iter().flat_map(f64::to_le_bytes).collect::<Vec<u8>>());
    let ask = |rest: &[&str]| desk.json(&[&["truth", &a, &b, "--configurations", &pose], rest].concat())[0].clone();
    let [exact, rounded] = [ask(&[]), ask(&["--rounded"])];
    let apart = exact["distance_lo"].as_f64().expect("a number");
    assert!((apart - 0.01).abs() < 1e-9 && exact["class64"] == "clear", "{exact:#}");
    assert_eq!((&rounded["hit"], &rounded["distance_hi"]), (&true.into(), &0.0.into()), "{rounded:#}");
    let flat = desk.file("flat.obj", "v 1e6 0 0\nv 1000000.01 0 0\nv 1e6 1 0\nf 1 2 3\n");
    let refused = desk.run(&["truth", &flat, "--configurations", &pose, "--rounded"]);
    assert_eq!(refused.code, 2, "{refused:?}");
    assert!(
        refused.stderr.contains("flat.obj cannot be rounded to single precision: every triangle has zero area"),
        "{refused:?}"
    );
}
