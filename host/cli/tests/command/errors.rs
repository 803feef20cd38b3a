//! Bad input: one sentence on stderr, exit code 2, nothing kept.

use std::fs::File;

use serde_json::json;

use crate::support::Desk;

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn bad_objects_are_refused_and_nothing_is_kept() {
    let desk = Desk::new();
    let good = desk.file("good.obj", TETRAHEDRON);
    let big = desk.path("big.obj");
    File::create(&big).and_then(|file| file.set_len(300 << 20)).expect("a sparse file");
    let junk: Vec<u8> = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let folder = desk.path("").display().to_string();
    let cases = [
        (desk.file("empty.obj", ""), "empty"),
        (desk.file("junk.obj", junk), ""),
        (big.display().to_string(), "256 mib"),
        (desk.file("nan.obj", TETRAHEDRON.replace("v 1 0 0", "v nan 0 0")), "line 2"),
        (desk.file("range.obj", TETRAHEDRON.replace("f 1 3 2", "f 1 3 99")), "line 5"),
        (desk.file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "face"),
        (desk.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "area"),
        (desk.path("missing.obj").display().to_string(), "no such file"),
        (folder, "folder"),
        ("stock:unicorn@100".to_owned(), "unicorn"),
    ];
    for (object, expected) in &cases {
        for args in [vec!["bench", object], vec!["bench", &good, object]] {
            let sentence = desk.refused(&args);
            assert!(sentence.to_lowercase().contains(expected), "{object}: {sentence}");
        }
    }
    let objects = desk.json(&["object", "list"]);
    assert!(objects.as_array().expect("a list").iter().all(|object| object["stock"] == true), "{objects:#}");
    assert_eq!(desk.json(&["run", "list"]), json!([]));
}

#[test]
fn bad_settings_are_refused_before_anything_is_opened() {
    let desk = Desk::new();
    let odd = desk.file("odd.f64", [0u8; 130]);
    let cases: [(&[&str], &str); 17] = [
        (&["--distance", "-0.1"], "distance"),
        (&["--distance", "nan"], "distance"),
        (&["--count", "0"], "1 to"),
        (&["--count", "1000000000"], "10000000"),
        (&["--count", "-5"], "1 to"),
        (&["--count", "many"], "many"),
        (&["--rotate", "0"], ""),
        (&["--move", "-20"], ""),
        (&["--rotate", "0.01", "--move", "0.01"], ""),
        (&["--query", "pd"], "pd"),
        (&["--query", "pq", "--contacts", "all"], "--contacts"),
        (&["--count", "5", "--rotate", "20"], "--rotate"),
        (&["--configurations", "missing.f64"], "missing.f64"),
        (&["--method", "cube"], "cube"),
        (&["--speed", "fast"], "--speed"),
        (&["--configurations", &odd, "--seed", "1"], "--seed"),
        (&["--out", "/dev/null/results"], "/dev/null"),
    ];
    for (args, expected) in cases {
        let sentence = desk.refused(&[&["bench", "stock:sphere@500"], args].concat());
        assert!(sentence.contains(expected), "{args:?}: {sentence}");
    }
    assert!(!desk.path("data").exists(), "the data folder was made for nothing");
}

#[test]
fn settings_that_the_engine_knows_better_are_refused() {
    let desk = Desk::new();
    let odd = desk.file("odd.f64", [0u8; 130]);
    let cases: [(&[&str], &str); 4] = [
        (&["--algorithm", "no-such-thing"], "no-such-thing"),
        (&["--configurations", &odd], ""),
        (&["--passes", "0"], "passes"),
        (&["--budget", "-1"], ""),
    ];
    for (args, expected) in cases {
        let sentence = desk.refused(&[&["bench", "stock:sphere@500"], args].concat());
        assert!(sentence.contains(expected), "{args:?}: {sentence}");
    }
    assert_eq!(desk.json(&["run", "list"]), json!([]));
}

#[test]
fn bad_plugins_are_refused() {
    let desk = Desk::new();
    let text = desk.file("text.so", "this is no ELF file");
    let ended = desk.run(&["plugin", "check", &text]);
    assert_eq!(ended.code, 2, "{ended:?}");
    assert_eq!(ended.stderr.lines().count(), 1, "{ended:?}");
    assert!(ended.stderr.contains("ELF"), "{ended:?}");
    let missing = desk.path("missing.so").display().to_string();
    assert!(desk.refused(&["plugin", "check", &missing]).contains("no such file"));

    let report = desk.run(&["plugin", "check", &text, "--json"]);
    assert_eq!(report.code, 2);
    let report: serde_json::Value = serde_json::from_str(&report.stdout).expect("JSON");
    assert_eq!(report["passed"], false);
    assert!(!desk.path("data").exists(), "a check leaves nothing behind");
}

#[test]
fn things_that_are_not_there_are_named() {
    let desk = Desk::new();
    let unknown = "0193f1a0-0000-7000-8000-000000000000";
    let map = desk.path("x.glb").display().to_string();
    for args in [
        &["run", "show", unknown][..],
        &["run", "show", "latest"],
        &["heatmap", unknown, "-o", &map],
        &["heatmap", "latest", "-o", "x.png"],
        &["heatmap", "latest", "-o", &map, "--measure", "colour"],
        &["bench", unknown],
        &["bench"],
        &["dance"],
        &[],
    ] {
        desk.refused(args);
    }
    assert!(!desk.path("x.glb").exists());
}

#[test]
fn pipes_and_devices_are_refused_before_they_are_read() {
    let desk = Desk::new();
    let pipe = desk.path("pipe").display().to_string();
    nix::unistd::mkfifo(std::path::Path::new(&pipe), nix::sys::stat::Mode::S_IRWXU).expect("a pipe");
    let plugin = desk.file("plugin.so", "\x7fELF");
    for odd in [&pipe[..], "/dev/zero"] {
        for args in [
            &["plugin", "check", odd][..],
            &["plugin", "check", &plugin, "--manifest", odd],
            &["plugin", "check", &plugin, "--repro", odd],
            &["submit", odd, "--manifest", odd, "--token", "t"],
            &["submit", &plugin, "--manifest", odd, "--token", "t"],
            &["bench", odd],
            &["bench", "stock:sphere@500", "--configurations", odd],
            &["replay", odd],
        ] {
            let sentence = desk.refused(args);
            assert!(sentence.contains("it is not a regular file"), "{args:?}: {sentence}");
        }
        // One of several: it is not offered, and the others are.
        let listed = desk.run(&["plugin", "list", "--plugins", odd]);
        assert!(listed.code == 0 && listed.stderr.contains("it is not a regular file"), "{listed:?}");
    }
}
