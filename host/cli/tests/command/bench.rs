//! `ocb bench` and what can be done with its run.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;

use nix::errno::Errno;
use nix::sys::signal::{Signal, kill, killpg};
use nix::unistd::Pid;

use crate::support::Desk;

#[test]
fn a_run_gives_a_table_and_its_files() {
    let desk = Desk::new();
    let out = desk.path("results");
    let ended = desk.run(&[
        "bench",
        "stock:torus-knot@600",
        "--count",
        "40",
        "--algorithm",
        "box-tree,brute-force",
        "--passes",
        "1",
        "--out",
        out.to_str().expect("text"),
    ]);
    assert_eq!(ended.code, 0, "{ended:?}");
    for word in ["algorithm", "n of N", "median", "p95", "wrong", "box-tree", "brute-force", "Completed", "done"] {
        assert!(ended.stdout.contains(word), "{word}: {}", ended.stdout);
    }
    assert!(ended.stderr.contains("configurations: "), "progress in plain lines: {}", ended.stderr);

    for file in [
        "configurations.parquet",
        "box-tree.parquet",
        "box-tree.triangles.parquet",
        "box-tree.csv",
        "box-tree.glb",
        "brute-force.ply",
    ] {
        assert!(out.join(file).metadata().is_ok_and(|facts| facts.len() > 100), "{file}");
    }
    let stored = std::fs::read_to_string(out.join("run.json")).expect("run.json");
    let stored: serde_json::Value = serde_json::from_str(&stored).expect("JSON");
    assert_eq!(stored["state"], "done");
    let csv = std::fs::read_to_string(out.join("box-tree.csv")).expect("box-tree.csv");
    let configurations = stored["set"]["configurations"].as_u64().expect("a number");
    assert_eq!(csv.lines().count() as u64, configurations + 1);

    look_at_the_run(&desk, &stored);
    repeat_its_configurations(&desk, &out.join("configurations.parquet").display().to_string(), configurations);
}

fn look_at_the_run(desk: &Desk, stored: &serde_json::Value) {
    let id = stored["id"].as_str().expect("an id");
    assert_eq!(desk.json(&["run", "list"])[0]["id"], id);
    assert_eq!(desk.json(&["run", "show", id])["results"], stored["results"]);
    assert!(desk.run(&["run", "show", "latest"]).stdout.contains("box-tree"));

    for (file, magic) in [("a.glb", &b"glTF"[..]), ("b.ply", b"ply\n"), ("c.csv", b"vert")] {
        let path = desk.path(file);
        let name = path.to_str().expect("text");
        let args = ["heatmap", id, "--algorithm", "box-tree", "--measure", "bv-tests", "--side", "b", "-o", name];
        assert_eq!(desk.json(&args)["run"], id);
        assert_eq!(&std::fs::read(&path).expect("a file")[..4], magic, "{file}");
    }
    let sentence = desk.refused(&["heatmap", id, "-o", "x.glb"]);
    assert!(sentence.contains("box-tree") && sentence.contains("brute-force"), "{sentence}");
}

fn repeat_its_configurations(desk: &Desk, file: &str, configurations: u64) {
    let args = ["bench", "stock:torus-knot@600", "--configurations", file, "--algorithm", "box-tree", "--passes", "1"];
    let run = desk.json(&args);
    assert_eq!(run["set"]["configurations"], configurations);
    assert_eq!(run["spec"]["method"]["kind"], "file");
    assert_eq!(run["results"][0]["wrong"], 0);
}

#[test]
fn two_files_and_a_proximity_query() {
    let desk = Desk::new();
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let a = desk.file("a.obj", tetrahedron);
    let b = desk.file("b.obj", tetrahedron.replace("v 1 0 0", "v 2 0 0"));
    let run = desk.json(&[
        "bench",
        &a,
        &b,
        "--query",
        "pq",
        "--rotate",
        "90",
        "--move",
        "90",
        "--distance",
        "0.1",
        "--algorithm",
        "box-tree",
    ]);
    assert_eq!((&run["object_a_name"], &run["object_b_name"]), (&"a".into(), &"b".into()));
    assert_eq!(run["spec"]["query"], "proximity");
    assert_eq!(run["results"][0]["wrong"], 0, "{run:#}");
    let objects = desk.json(&["object", "list"]);
    assert_eq!(objects.as_array().expect("a list").iter().filter(|object| object["stock"] == false).count(), 2);
}

#[test]
fn a_comparison_that_is_settled_is_a_preview_that_can_be_refined() {
    let desk = Desk::new();
    let placing = ["bench", "stock:torus-knot@500", "--method", "random", "--count", "1200", "--hit-share", "0.5"];
    let bench = |precision| {
        // So far apart that the first look settles it, also on a busy machine.
        let rest = ["--passes", "3", "--precision", precision, "--algorithm", "box-tree,brute-force"];
        [&placing[..], &rest[..]].concat()
    };
    for wrong in ["no", "5 percent", "0", "-5%", "100%"] {
        let sentence = desk.refused(&bench(wrong));
        assert!(sentence.contains("0.05"), "{wrong}: {sentence}");
    }
    let ended = desk.run(&bench("60%"));
    assert_eq!(ended.code, 0, "{ended:?}");
    for words in ["PREVIEW of 500 of 1200 configurations. ", "box-tree", "1 in 166", "`ocb run refine "] {
        assert!(ended.stdout.contains(words), "{words}: {}", ended.stdout);
    }
    let preview = desk.json(&["run", "show", "latest"]);
    assert_eq!(preview["preview"]["settled"], true);
    let whole = desk.json(&["run", "refine", "latest"]);
    assert_eq!((&whole["id"], &whole["preview"]), (&preview["id"], &serde_json::Value::Null));
    assert_eq!(whole["results"][0]["n"], 1200);
    assert!(desk.refused(&["run", "refine", "latest"]).contains("preview"));
}

/// Ctrl-C cancels the run, and nothing goes on running behind it.
#[test]
fn an_interrupt_ends_everything() {
    let desk = Desk::new();
    let mut command =
        desk.command(&["bench", "stock:torus-knot@20000", "--count", "2000", "--passes", "99", "--budget", "600"]);
    let mut child = command.process_group(0).spawn().expect("it starts");
    let group = Pid::from_raw(i32::try_from(child.id()).expect("a pid"));
    let stderr = BufReader::new(child.stderr.take().expect("stderr"));
    let mut lines = stderr.lines().map_while(Result::ok);
    assert!(lines.any(|line| line.starts_with("object:") || line.starts_with("configurations:")), "the run begins");
    kill(group, Signal::SIGINT).expect("it runs");
    let last = lines.last().unwrap_or_default();
    let status = child.wait().expect("it ends");
    assert_eq!(status.code(), Some(130), "{last}");
    assert!(last.contains("cancelled"), "{last}");
    assert_eq!(killpg(group, None), Err(Errno::ESRCH), "a process is left");
    assert_eq!(desk.json(&["run", "show", "latest"])["state"], "cancelled");
}

#[test]
fn a_bench_that_waits_for_another_process_says_so() {
    let desk = Desk::new();
    let folder = if Path::new("/run/lock").is_dir() { "/run/lock" } else { "/tmp" };
    let lock = File::options().create(true).append(true).open(Path::new(folder).join("opencollbench-measuring.lock"));
    let lock = lock.expect("the lock's file");
    lock.lock().expect("the lock");
    // Kept until the command has said that it waits, or for so long.
    let (said, heard) = mpsc::channel::<()>();
    let keeper = std::thread::spawn(move || {
        let _ = heard.recv_timeout(Duration::from_secs(20));
        drop(lock);
    });
    let args = ["bench", "stock:torus-knot@600", "--count", "20", "--algorithm", "box-tree", "--passes", "1"];
    let mut child = desk.command(&args).spawn().expect("it starts");
    let mut lines = BufReader::new(child.stderr.take().expect("stderr")).lines().map(|line| line.expect("text"));
    let waits = lines.find(|line| line.contains("another process is measuring on this machine"));
    drop(said);
    keeper.join().expect("the lock is given back");
    let rest: Vec<String> = lines.collect();
    assert!(waits.is_some_and(|line| line.starts_with("box-tree: ")));
    assert!(child.wait().expect("it ends").success(), "{rest:?}");
}
