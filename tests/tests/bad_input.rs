//! Bad input, by command line and by API alike: one clear sentence, and nothing stays behind.

use std::path::Path;

use ocb_tests::place::built;
use ocb_tests::process::command;
use ocb_tests::service::{Guest, Service};
use serde_json::{Value, json};

/// Files that are no object, with a word that the sentence must hold.
fn bad_files() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    vec![
        ("empty.obj", Vec::new(), "empty"),
        ("junk.obj", (0..4096_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect(), ""),
        ("huge.obj", vec![b'#'; 300 << 20], "256"),
        ("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), "line 2"),
        ("infinite.obj", b"v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), "line 2"),
        ("range.obj", format!("{triangle}f 1 2 4\n").into_bytes(), "line 4"),
        ("points.obj", triangle.as_bytes().to_vec(), "face"),
        ("flat.obj", b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_vec(), "area"),
        ("note.txt", b"No format that is read.\n".to_vec(), "collada"),
        ("cut.stl", b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n".to_vec(), "endsolid"),
        ("count.off", b"OFF\n4000000000 1 0\n".to_vec(), "line 2"),
        ("points.ply", b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n".to_vec(), "faces"),
        (
            "outside.gltf",
            br#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"/etc/passwd"}]}"#.to_vec(),
            "another file",
        ),
        ("cut.glb", b"glTF\x02\0\0\0\0\x01\0\0".to_vec(), "byte 8"),
        ("cut.dae", b"<?xml version=\"1.0\"?>\n<COLLADA>\n<asset>".to_vec(), "line 3"),
    ]
}

fn spec(changes: Value) -> Value {
    let mut spec = json!({
        "object_a": "stock:sphere@500", "query": "collision_first", "separation": { "kind": "relative", "distance": 0.0 },
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 10 } },
    });
    spec.as_object_mut().expect("an object").extend(changes.as_object().expect("an object").clone());
    spec
}

fn count(n: u64) -> Value {
    json!({ "method": { "kind": "sphere", "sampling": { "kind": "count", "count": n } } })
}

/// Runs that cannot be: what the API gets, what the command line gets, and a word that the sentence must hold.
fn bad_runs() -> Vec<(Value, Vec<&'static str>, &'static str)> {
    vec![
        (json!({ "separation": { "kind": "relative", "distance": -0.1 } }), vec!["--distance=-0.1"], "distance"),
        (count(0), vec!["--count", "0"], "configuration"),
        (count(1_000_000_000), vec!["--count", "1000000000"], "configuration"),
        (json!({ "algorithms": ["no-such-thing"] }), vec!["--algorithm", "no-such-thing"], "no-such-thing"),
        (json!({ "object_a": "stock:teapot@100" }), vec!["stock:teapot@100"], "teapot"),
    ]
}

/// One sentence for a person: not empty, one line, no trace of the inside.
fn assert_sentence(what: &str, text: &str, word: &str) {
    assert!(!text.trim().is_empty(), "{what}: nothing was said");
    assert_eq!(text.trim().lines().count(), 1, "{what}: more than one line: {text}");
    assert!(text.len() < 400, "{what}: too long: {text}");
    for inside in ["panicked", "RUST_BACKTRACE", ".rs:", "Err(", "Some("] {
        assert!(!text.contains(inside), "{what}: shows the inside: {text}");
    }
    assert!(text.to_lowercase().contains(word), "{what}: does not say {word:?}: {text}");
}

/// `ocb ...` must fail with exit code 2 and one sentence on standard error, and print no result.
fn refused(data: &Path, arguments: &[&str], word: &str) {
    let mut ocb = command(built("ocb"));
    let done = ocb.args(arguments).arg("--data").arg(data).output().expect("ocb starts");
    let (said, what) = (String::from_utf8_lossy(&done.stderr).into_owned(), arguments.join(" "));
    assert_eq!(done.status.code(), Some(2), "{what}: {said}");
    assert!(done.stdout.is_empty(), "{what}: printed a result");
    assert_sentence(&what, &said, word);
}

/// Files of a folder, but for the database, its lock and its log.
fn blobs(data: &Path) -> Vec<std::path::PathBuf> {
    let mut open = vec![data.join("blobs")];
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            if entry.path().is_dir() { open.push(entry.path()) } else { found.push(entry.path()) }
        }
    }
    found.sort();
    found
}

#[test]
fn the_command_line_refuses_bad_files_and_bad_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().join("data");
    for (name, bytes, word) in bad_files() {
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).expect("a file is written");
        refused(&data, &["bench", file.to_str().expect("a path"), "--count", "10"], word);
    }
    for (_, arguments, word) in bad_runs() {
        let object = if arguments[0].starts_with("stock:") { &[][..] } else { &["stock:sphere@500"][..] };
        refused(&data, &[&["bench"][..], object, &arguments].concat(), word);
    }
    refused(&data, &["bench", "no-such-file.obj"], "no-such-file.obj");
    let configurations = folder.path().join("configurations.f64");
    std::fs::write(&configurations, [0_u8; 100]).expect("a file is written");
    refused(
        &data,
        &["bench", "stock:sphere@500", "--configurations", configurations.to_str().expect("a path")],
        "configuration",
    );
    assert_eq!(blobs(&data), Vec::<std::path::PathBuf>::new(), "nothing may stay behind");
}

#[test]
fn a_plugin_that_is_no_elf_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plugin.so");
    for bytes in [&b"not an ELF file"[..], b"", b"\x7fELF", b"#!/bin/sh\nexit 0\n"] {
        std::fs::write(&file, bytes).expect("a file is written");
        let done = command(built("ocb")).args(["plugin", "check"]).arg(&file).output().expect("ocb starts");
        assert!(!done.status.success() && done.status.code().is_some(), "{bytes:?}: {}", done.status);
        let said = [done.stdout, done.stderr].concat();
        let said = String::from_utf8_lossy(&said).to_lowercase();
        assert!(said.contains("elf") && !said.contains("panicked"), "{bytes:?}: {said}");
    }
}

#[test]
fn the_api_refuses_bad_files_and_bad_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let (guest, service) = (Guest::default(), Service::start_with(folder.path(), &["libocb_box_tree.so"]));
    let before = (guest.get(&service, "/objects"), guest.get(&service, "/runs"), blobs(folder.path()));

    let refused = |what: &str, (status, problem): (u16, Value), word: &str| {
        assert!((400..500).contains(&status), "{what}: {status} {problem}");
        assert_eq!(problem["status"], status, "{what}: {problem}");
        assert_sentence(what, problem["detail"].as_str().unwrap_or(""), word);
    };
    for (name, bytes, word) in bad_files() {
        refused(name, guest.upload(&service, name, bytes), word);
    }
    for (changes, _, word) in bad_runs() {
        let spec = spec(changes);
        refused(&spec.to_string(), guest.post(&service, "/runs", &spec), word);
        refused(&spec.to_string(), guest.post(&service, "/estimates", &spec), word);
    }
    refused(
        "an unknown field",
        guest.post(&service, "/runs", &spec(json!({ "relative_distanec": 1 }))),
        "relative_distanec",
    );
    refused("no object", guest.post(&service, "/runs", &json!({})), "");

    let after = (guest.get(&service, "/objects"), guest.get(&service, "/runs"), blobs(folder.path()));
    assert_eq!(before, after, "nothing may stay behind");
    // The service is as well as before.
    assert_eq!(guest.post(&service, "/estimates", &spec(json!({}))).0, 200);
}
