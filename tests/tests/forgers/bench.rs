//! One `ocb bench` of the kit, and what it says of each algorithm.

use std::path::Path;

use ocb_tests::place::built;
use ocb_tests::process::command;
use serde_json::Value;

use crate::kit::{Class, Kit, REFERENCE, SLOW_REFERENCE};
use crate::load::{Busy, cpus, stay_on};
use crate::objects::FILES;
use crate::plan::{Question, Run};

/// What came out for one algorithm.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Its class.
    pub class: Class,
    /// Its name without the class.
    pub name: String,
    /// Its place; absent where it has none.
    pub rank: Option<u64>,
    /// Mean time of a question, nanoseconds.
    pub time_ns: Option<f64>,
    /// Most of its questions take longer than the clock's resolution.
    pub told: bool,
    /// 95 % interval of what ranks are made of.
    pub interval: Option<[f64; 2]>,
    /// Time to build both structures, milliseconds.
    pub build_ms: Option<f64>,
    /// How it ended, wrong answers.
    pub ending: String,
}

/// Measures as the service would, and gives the results as `ocb bench` tells them.
pub fn measure(folder: &Path, kit: &Kit, run: &Run) -> Value {
    let data = tempfile::tempdir().expect("a folder");
    let mut ocb = command(built("ocb"));
    ocb.arg("--json").arg("--data").arg(data.path()).arg("bench").args(FILES.map(|name| folder.join(name)));
    let mut ids = Vec::new();
    if run.twin_of_the_reference {
        ocb.arg("--plugins").arg(kit.twin_of_the_reference());
    }
    ocb.arg("--plugins").arg(built("ocb").parent().expect("a folder"));
    for class in &run.classes {
        ocb.arg("--plugins").arg(kit.library(*class));
        ids.extend(run.algorithms.iter().map(|name| format!("{name}_{}", class.name())));
    }
    let reference: Vec<String> = run.twin_of_the_reference.then(|| REFERENCE.into()).into_iter().collect();
    ocb.args([
        "--profile",
        "production",
        "--distance",
        "0.05",
        "--algorithm",
        &[&ids[..], &reference].concat().join(","),
    ]);
    ocb.args(["--query", if run.question == Question::Distance { "pq" } else { "cd" }]);
    ocb.args(["--count", &run.configurations.to_string(), "--seed", &run.seed.to_string()]);
    let busy = run.condition.busy.then(Busy::begin);
    let one_cpu = run.condition.one_cpu;
    // What a program inherits is the mask of the thread that starts it.
    let starter = std::thread::spawn(move || {
        if one_cpu {
            stay_on(cpus()[0]);
        }
        ocb.output().expect("ocb is started")
    });
    let done = starter.join().expect("ocb has run");
    drop(busy);
    let told = String::from_utf8_lossy(&done.stderr);
    // 3: an algorithm failed or was wrong, which is what a forger deserves.
    assert!(matches!(done.status.code(), Some(0 | 3)), "{run:?}: {} {told}", done.status);
    let report: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let clock = if one_cpu || cpus().len() == 1 { "futex" } else { "spin" };
    let used = &report["environment"]["clock"];
    assert!(used.is_null() || used == clock, "{run:?}: the clock was {used}");
    let results = report["results"].as_array().expect("a list of results");
    let slow = results.iter().any(|r| r["algorithm"] == REFERENCE && r["name"] == SLOW_REFERENCE);
    let compared = &report["environment"]["reference"]["algorithm"];
    assert!(!slow || compared != REFERENCE, "{run:?}: all are compared with a stranger's algorithm");
    report["results"].clone()
}

/// What these results say of each algorithm of the kit.
pub fn found(run: &Run, results: &Value) -> Vec<Found> {
    let results = results.as_array().expect("a list of results");
    let found: Vec<Found> = results.iter().filter_map(|result| read(result, &run.classes)).collect();
    let asked = run.classes.len() * run.algorithms.len();
    assert_eq!(found.len(), asked, "{run:?}: not every algorithm has a result");
    found
}

/// One of ours; the reference is none.
fn read(result: &Value, classes: &[Class]) -> Option<Found> {
    let id = result["algorithm"].as_str().expect("an id");
    let (name, class) = classes.iter().find_map(|c| Some((id.strip_suffix(c.name())?.strip_suffix('_')?, *c)))?;
    let interval = |of: &Value| Some([of["lo"].as_f64()?, of["hi"].as_f64()?]);
    let outcome = &result["outcome"];
    let ending = match (outcome["name"].as_str().unwrap_or("?"), result["wrong"].as_u64()) {
        ("Completed", Some(0)) => "Completed".to_string(),
        ("Completed", wrong) => format!("{} wrong", wrong.unwrap_or_default()),
        (other, _) => format!("{other}: {}", outcome["message"].as_str().unwrap_or_default()),
    };
    Some(Found {
        class,
        name: name.to_string(),
        rank: result["rank"].as_u64(),
        time_ns: result["time"]["mean_ns"]["value"].as_f64(),
        told: 2 * result["time"]["below_resolution"].as_u64().unwrap_or_default()
            < result["n"].as_u64().unwrap_or_default(),
        interval: interval(&result["ratio"]),
        build_ms: result["build_ms"].as_f64(),
        ending,
    })
}
