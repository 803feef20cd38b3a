//! Hostile archives: each is refused with one sentence, and nothing is unpacked beyond what it may hold.

use std::io::Write;

use serde_json::{Value, json};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::*;

/// An archive of these files under these names, in this order.
fn zipped(files: &[(&str, &[u8])]) -> tempfile::NamedTempFile {
    let mut zip = ZipWriter::new(tempfile::NamedTempFile::new().unwrap());
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap()
}

/// A recipe with these files in its list.
fn recipe(files: &[(&str, &[u8])]) -> Value {
    let interval = json!({ "value": 1.0, "lo": 1.0, "hi": 1.0 });
    json!({
        "format": 2, "version": "0.1.0", "run": "r", "seed": 1,
        "spec": { "object_a": "stock:torus-knot@600", "query": "proximity", "method": { "kind": "random", "count": 8, "hit_share": 0.5 } },
        "versions": { "sampling": 1, "oracle": 1, "instances": instance::VERSION },
        "objects": [{ "id": "stock:torus-knot@600", "name": "knot", "sha256": "", "file": null }],
        "configurations": "poses",
        "algorithms": [],
        "environment": {
            "cpu": "", "cpus": 1, "memory_bytes": 1, "kernel": "", "hardware_class": "", "clock": "spin", "null_ns": interval,
            "disturbed": 0, "jail": [], "version": "0.1.0"
        },
        "files": files.iter().map(|(path, bytes)| json!({ "path": path, "bytes": bytes.len(), "sha256": sha256_hex(bytes) })).collect::<Vec<_>>(),
    })
}

fn refused(files: &[(&str, &[u8])]) -> String {
    let file = zipped(files);
    let Err(LabError::Invalid(told)) = Unpacked::read(file.path()) else { panic!("{files:?} was accepted") };
    assert!(told.contains("cannot be replayed: ") && told.ends_with('.') && !told.contains('\n'), "{told}");
    told
}

/// What is said of an archive whose recipe was changed so.
fn changed(change: impl FnOnce(&mut Value)) -> String {
    let poses: (&str, &[u8]) = ("poses", b"no parquet");
    let mut told = recipe(&[poses]);
    change(&mut told);
    refused(&[(RECIPE, told.to_string().as_bytes()), poses])
}

#[test]
fn what_is_no_archive_of_ours_is_refused() {
    let file = tempfile::NamedTempFile::new().unwrap();
    for bytes in [&b""[..], b"PK", b"PK\x05\x06", &[0; 4096]] {
        std::fs::write(file.path(), bytes).unwrap();
        let Err(LabError::Invalid(told)) = Unpacked::read(file.path()) else { panic!("{bytes:?} was accepted") };
        assert!(told.contains("it is not a zip archive"), "{told}");
    }
    assert!(refused(&[]).contains("recipe.json"));
    assert!(refused(&[("poses", b"x")]).contains("recipe.json"));
    assert!(refused(&[(RECIPE, b"{")]).contains("is not valid JSON"));
    assert!(refused(&[(RECIPE, b"{}")]).contains("its format is none"));
    assert!(changed(|recipe| recipe["format"] = json!(3)).contains("its format is 3"));
    assert!(changed(|recipe| recipe["surprise"] = json!(1)).contains("surprise"));
    assert!(changed(|recipe| recipe["versions"]["instances"] = json!(99)).contains("version 99"));
    assert!(changed(|recipe| recipe["objects"] = json!([])).contains("one object or two"));
    // It gets as far as the content of what is whole.
    assert!(changed(|_| ()).contains("\"poses\" in it: "));
}

#[test]
fn files_must_be_listed_there_and_the_same() {
    let poses: (&str, &[u8]) = ("poses", b"no parquet");
    let good = recipe(&[poses]).to_string();
    let good = (RECIPE, good.as_bytes());
    assert!(refused(&[good]).contains("\"poses\" in it cannot be read"));
    assert!(refused(&[good, poses, ("more", b"")]).contains("\"more\", which recipe.json does not list"));
    assert!(refused(&[good, ("poses", b"other bytes")]).contains("10 bytes"));
    assert!(refused(&[good, ("poses", b"no Parquet")]).contains("its SHA-256 differs"));
    assert!(changed(|recipe| recipe["configurations"] = json!("elsewhere")).contains("does not list it"));
    for path in ["../poses", "/etc/passwd", "a/../../b", "a//b", "", ".hidden", "a\\b", "a\u{0}b", "C:x"] {
        let told = changed(|recipe| recipe["files"][0]["path"] = json!(path));
        assert!(told.contains("is not a path inside an archive") || told.contains("does not list"), "{path}: {told}");
    }
    for path in ["../poses", "/etc/passwd", "a/../../b"] {
        let told = refused(&[good, (path, b"x")]);
        assert!(told.contains("which recipe.json does not list"), "{path}: {told}");
    }
}

#[test]
fn a_bomb_is_not_unpacked() {
    // A thousand times as much as it says, and as much as it says but too much.
    let zeros = vec![0; 64 << 20];
    let small = recipe(&[("poses", b"0123456789")]).to_string();
    assert!(refused(&[(RECIPE, small.as_bytes()), ("poses", &zeros)]).contains("does not have the 10 bytes"));
    assert!(refused(&[(RECIPE, &zeros)]).contains("more than 4194304"));
    for bytes in [json!(u64::MAX), json!(3u64 << 30)] {
        assert!(changed(|recipe| recipe["files"][0]["bytes"] = bytes).contains("it would unpack to 1 files"));
    }
    assert!(changed(|recipe| recipe["files"][0]["bytes"] = json!(300 << 20)).contains("more than 268435456"));
    let many: Vec<Value> = (0..501).map(|i| json!({ "path": format!("f{i}"), "bytes": 0, "sha256": "" })).collect();
    assert!(changed(|recipe| recipe["files"] = json!(many)).contains("501 files"));
}
