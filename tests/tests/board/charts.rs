//! The charts of real runs, through the command: every number is one of the run's own files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use ocb_tests::place::built;
use ocb_tests::process::{command, output};
use serde_json::Value;

/// The command on this data folder.
fn ocb(data: &Path, words: &[&str]) -> String {
    output(command(built("ocb")).arg("--data").arg(data).args(words))
}

fn json_of(data: &Path, words: &[&str]) -> Value {
    serde_json::from_str(&ocb(data, words)).expect("JSON")
}

/// Measures a run and gives the folder with its files.
fn bench(data: &Path, object: &str, name: &str, more: &[&str]) -> (String, Vec<BTreeMap<String, String>>) {
    let out = data.join(name);
    let folder = out.to_str().expect("text");
    let always = [
        "--json",
        "bench",
        object,
        "--query",
        "pq",
        "--passes",
        "2",
        "--algorithm",
        "box-tree,ocb-fast",
        "--out",
        folder,
    ];
    let run = json_of(data, &[&always, more].concat());
    let csv = fs::read_dir(&out).expect("files").flatten().map(|entry| entry.path());
    let box_tree =
        |path: &Path| path.to_string_lossy().contains("box-tree") && path.extension().is_some_and(|e| e == "csv");
    let records = csv.filter(|path| box_tree(path)).min_by_key(|path| path.as_os_str().len()).expect("records");
    (run["id"].as_str().expect("an id").to_owned(), rows(&fs::read_to_string(records).expect("text")))
}

fn rows(csv: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = csv.lines();
    let names = fields(lines.next().expect("a header"));
    lines.map(|line| names.iter().cloned().zip(fields(line)).collect()).collect()
}

/// The fields of a line; what stands in quotes is one.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    for (i, part) in line.split('"').enumerate() {
        let mut pieces = if i % 2 == 0 { part.split(',').collect() } else { vec![part] }.into_iter();
        fields.last_mut().expect("one").push_str(pieces.next().unwrap_or(""));
        fields.extend(pieces.map(str::to_owned));
    }
    fields
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

/// One chart as JSON; its CSV, Parquet and SVG must agree with it.
fn chart(data: &Path, run: &str, kind: &str) -> Value {
    let file = |end: &str| data.join(format!("{kind}.{end}"));
    for end in ["json", "csv", "parquet", "svg", "png"] {
        ocb(data, &["chart", run, "--kind", kind, "--out", file(end).to_str().expect("text")]);
    }
    let chart: Value = serde_json::from_slice(&fs::read(file("json")).expect("a file")).expect("JSON");
    let drawn: Vec<&Value> = points(&chart, |series| series["form"] != "rule");
    let csv = rows(&fs::read_to_string(file("csv")).expect("text"));
    assert_eq!(csv.len(), drawn.len(), "{kind}");
    for (row, point) in csv.iter().zip(&drawn) {
        assert_eq!((number(row, "y"), number(row, "n")), (point["y"].as_f64().unwrap(), point["n"].as_f64().unwrap()));
        assert!(number(row, "n") > 0.0, "every value has an n: {row:?}");
    }
    assert!(fs::read(file("parquet")).expect("a file").starts_with(b"PAR1"));
    let png = fs::read(file("png")).expect("a file");
    assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000, "{kind}: {} bytes", png.len());
    let svg = fs::read_to_string(file("svg")).expect("text");
    assert!(svg.starts_with("<svg") && svg.contains("n = ") && !svg.contains("NaN"), "{kind}: {svg}");
    assert!(svg.contains(chart["title"].as_str().expect("a title")), "{kind}");
    chart
}

fn points(chart: &Value, of: impl Fn(&Value) -> bool) -> Vec<&Value> {
    let series = chart["series"].as_array().expect("series").iter().filter(|series| of(series));
    series.flat_map(|series| series["points"].as_array().expect("points")).collect()
}

fn sum(points: &[&Value]) -> u64 {
    points.iter().map(|point| point["n"].as_u64().expect("n")).sum()
}

#[test]
fn every_chart_of_a_run_holds_the_numbers_of_its_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path();
    let (_, _) = bench(data, "stock:torus-knot@600", "coarse", &["--count", "60", "--distance", "0.1"]);
    let (fine, _) = bench(data, "stock:torus-knot@1200", "fine", &["--count", "60", "--distance", "0.1"]);
    let (ladder, records) = bench(data, "stock:torus-knot@600", "ladder", &["--count", "100", "--ladder"]);
    let times: Vec<f64> = records.iter().map(|row| number(row, "time_ns")).collect();
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let most = times.iter().copied().fold(0.0, f64::max);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    let y = |point: &Value| point["y"].as_f64().expect("y");
    let x = |point: &Value| point["x"].as_f64().expect("x");
    let own =
        |what: &'static str| move |series: &Value| series["name"].as_str().is_some_and(|name| name.starts_with(what));

    let by_distance = chart(data, &ladder, "distance");
    let means = points(&by_distance, own("BoxTree, mean"));
    let beside: u64 = 60;
    assert_eq!(sum(&means), times.len() as u64 + beside, "the ladder and the run at 0.1");
    assert!(means.windows(2).all(|pair| x(pair[0]) < x(pair[1])), "{means:?}");
    let whole: f64 =
        means.iter().filter(|p| !near(x(p), 0.1) && p["n"] != beside).map(|p| y(p) * p["n"].as_f64().unwrap()).sum();
    assert!(near(whole, mean * times.len() as f64), "the means are those of the records: {whole}");
    let maxima = points(&by_distance, own("BoxTree, maximum"));
    assert!(maxima.iter().any(|point| y(point) == most), "{most} in {maxima:?}");

    let by_triangles = chart(data, &fine, "triangles");
    let means = points(&by_triangles, own("BoxTree, mean"));
    assert_eq!(means.len(), 2, "two resolutions at the same distance: {by_triangles:#}");
    assert!(x(means[0]) < x(means[1]) && x(means[1]) >= 2000.0);

    let spread = chart(data, &ladder, "ecdf");
    let curve = points(&spread, own("BoxTree"));
    assert_eq!((x(curve[curve.len() - 1]), y(curve[curve.len() - 1])), (most, 1.0));

    for (kind, column) in [("bv-tests", "bv_tests"), ("primitive-tests", "primitive_tests")] {
        let by_tests = chart(data, &ladder, kind);
        let binned = points(&by_tests, own("BoxTree"));
        assert_eq!(sum(&binned), times.len() as u64);
        let tests: f64 = binned.iter().map(|p| x(p) * p["n"].as_f64().unwrap()).sum();
        assert!(near(tests, records.iter().map(|row| number(row, column).max(1.0)).sum()), "{kind}: {tests}");
    }

    let failing = chart(data, &ladder, "resolution");
    let decades = points(&failing, own("BoxTree"));
    assert_eq!(sum(&decades), times.len() as u64, "every decision of the ladder has its place: {failing:#}");
    let (missed, apart): (Vec<&Value>, Vec<&Value>) = decades.iter().copied().partition(|point| x(point) < 0.0);
    assert!(missed.len() >= 4 && apart.len() >= 4, "both sides, decade by decade: {decades:?}");
    assert!(decades.iter().all(|point| y(point) == 0.0), "BoxTree is exact");

    let accuracy = chart(data, &ladder, "accuracy");
    let marks = points(&accuracy, |series| !series["style"].is_null());
    assert_eq!(marks.len(), 2);

    // The board: one distance of one pair by default, and the same numbers as the run's.
    let board = json_of(
        data,
        &["--json", "board", "--distance", "ladder", "--chart", data.join("board.svg").to_str().unwrap()],
    );
    let run = json_of(data, &["--json", "run", "show", &ladder]);
    for result in run["results"].as_array().expect("results") {
        let row = board["rows"].as_array().expect("rows").iter().find(|row| row["algorithm"] == result["algorithm"]);
        let row = row.unwrap_or_else(|| panic!("{} in {board:#}", result["algorithm"]));
        assert_eq!((&row["n"], &row["wrong"]), (&result["n"], &result["wrong"]));
        assert!(near(
            row["rate"]["value"].as_f64().unwrap(),
            1e9 / result["time"]["mean_ns"]["value"].as_f64().unwrap()
        ));
    }
    assert!(fs::read_to_string(data.join("board.svg")).expect("a file").contains("queries per second"));
    let table = ocb(data, &["board"]);
    for words in ["Fastest with no wrong answer seen", "box-tree", "ocb-fast", "--scene", "torus-knot@600"] {
        assert!(table.contains(words), "{words} in {table}");
    }
}

#[test]
fn what_cannot_be_charted_is_said_in_one_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let refuse = |words: &[&str], part: &str| {
        let done = command(built("ocb")).arg("--data").arg(folder.path()).args(words).output().expect("ocb starts");
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains(part) && said.lines().count() == 1, "{words:?}: {said}");
    };
    refuse(&["chart", "latest", "--kind", "ecdf", "--out", "x.gif"], ".svg, .png, .csv, .parquet or .json");
    refuse(&["chart", "latest", "--kind", "ecdf", "--out", "x.svg"], "no run yet");
    refuse(&["chart", "latest", "--kind", "luck", "--out", "x.svg"], "luck");
    refuse(&["board", "--precision", "fine"], "1e-6");
    assert!(ocb(folder.path(), &["board"]).contains("No results yet"));
}
