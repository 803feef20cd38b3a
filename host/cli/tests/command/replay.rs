//! Repro archives: asked again elsewhere, they give the same answers, and what is not the same is told.

use std::fs::File;
use std::io::{Read, Write};

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use crate::support::{Desk, Ended};

/// A tetrahedron that no stock holds.
const OWN: &str = "v 0 0 0\nv 1 0.25 0\nv 0 1 0.125\nv 0.3 0.2 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Measures and packs; gives the archive's path.
fn packed(desk: &Desk, question: &[&str]) -> String {
    let bench = [&["bench", "--count", "60", "--passes", "2", "--run-seed", "5"], question].concat();
    let run = desk.json(&bench);
    let path = desk.path("run.zip").to_str().expect("text").to_owned();
    let packed = desk.json(&["run", "repro", "latest", "-o", &path]);
    assert_eq!(packed["run"], run["id"]);
    path
}

/// Writes the archive anew with another recipe.
fn with_recipe(desk: &Desk, path: &str, change: impl FnOnce(&mut Value)) -> String {
    let mut old = ZipArchive::new(File::open(path).expect("a file")).expect("an archive");
    let changed = desk.path("changed.zip");
    let mut new = ZipWriter::new(File::create(&changed).expect("a file"));
    let mut change = Some(change);
    for i in 0..old.len() {
        let mut entry = old.by_index(i).expect("a file");
        let (name, mut bytes) = (entry.name().expect("a name").into_owned(), Vec::new());
        entry.read_to_end(&mut bytes).expect("its content");
        if let Some(change) = change.take_if(|_| name == "recipe.json") {
            let mut recipe = serde_json::from_slice(&bytes).expect("JSON");
            change(&mut recipe);
            bytes = recipe.to_string().into_bytes();
        }
        new.start_file(name, SimpleFileOptions::default()).expect("room");
        new.write_all(&bytes).expect("room");
    }
    new.finish().expect("an archive");
    changed.to_str().expect("text").to_owned()
}

#[test]
fn every_answer_comes_back_bit_for_bit() {
    let (desk, elsewhere) = (Desk::new(), Desk::new());
    let own = desk.file("own.obj", OWN);
    let distances =
        ["stock:torus-knot@600", "--query", "pq", "--algorithm", "box-tree:leaf_size=8,brute-force,ocb-fast"];
    let lists =
        ["stock:torus-knot@600", "--contacts", "all", "--step", "-0.0001", "--algorithm", "box-tree,brute-force"];
    let hits = [&own[..], "--distance", "0", "--algorithm", "box-tree,brute-force"];
    let frames = ["stock:torus-knot@600", "--method", "trajectory", "--query", "pq", "--algorithm", "box-tree"];
    for question in [&distances[..], &lists, &hits, &frames] {
        let replay = elsewhere.json(&["replay", &packed(&desk, question)]);
        assert_eq!(replay["identical"], true, "{replay:#}");
        let algorithms = replay["algorithms"].as_array().expect("a list");
        assert_eq!(algorithms.len(), question.last().expect("algorithms").split(',').count());
        for algorithm in algorithms {
            assert!(
                algorithm["answers"].as_u64() > Some(20) && algorithm["equal"] == algorithm["answers"],
                "{algorithm}"
            );
        }
    }
}

#[test]
fn an_archive_is_enough_and_what_differs_is_told() {
    let (desk, elsewhere) = (Desk::new(), Desk::new());
    let archive = packed(&desk, &["stock:torus-knot@600", "--query", "pq", "--algorithm", "box-tree"]);
    // Where nothing is installed, the archive's own copy answers, in the jail of a stranger's file.
    std::fs::create_dir(elsewhere.path("none")).expect("a folder");
    let none = elsewhere.path("none").to_str().expect("text").to_owned();
    let bare = |archive: &str| elsewhere.run(&["replay", archive, "--plugins", &none, "--profile", "dev"]);
    let Ended { code, stdout, stderr } = bare(&archive);
    assert_eq!(code, 0, "{stdout}{stderr}");
    assert!(stdout.contains("box-tree: 60 of 60 answers are the same, bit for bit"), "{stdout}");
    assert!(stdout.contains(": identical, 60 of 60 answers"), "{stdout}");

    let gone = with_recipe(&desk, &archive, |recipe| recipe["algorithms"][0]["plugin"] = Value::Null);
    let Ended { code, stdout, .. } = bare(&gone);
    assert_eq!(code, 3, "{stdout}");
    assert!(stdout.contains("0 of 60 answers") && stdout.contains("neither in the archive nor installed"), "{stdout}");

    // Another seed puts the questions as other instances; the first answer that is another one then is named.
    let other = with_recipe(&desk, &archive, |recipe| recipe["seed"] = 6.into());
    let Ended { code, stdout, .. } = elsewhere.run(&["replay", &other]);
    assert_eq!(code, 3, "{stdout}");
    assert!(stdout.contains("first difference, configuration ") && stdout.contains("NOT identical"), "{stdout}");

    let unknown = elsewhere.refused(&["replay", &archive, "--algorithm", "parry"]);
    assert!(unknown.contains("is not in this archive; available: box-tree."), "{unknown}");
    let object = with_recipe(&desk, &archive, |recipe| recipe["objects"][0]["id"] = "stock:torus-knot@700".into());
    assert!(elsewhere.refused(&["replay", &object]).contains("its SHA-256 differs"));
    let hash = with_recipe(&desk, &archive, |recipe| recipe["files"][1]["sha256"] = "0".repeat(64).into());
    assert!(elsewhere.refused(&["replay", &hash]).contains("cannot be replayed: "));
    assert!(elsewhere.refused(&["replay", "/nonexistent.zip"]).contains("cannot be opened"));
}
