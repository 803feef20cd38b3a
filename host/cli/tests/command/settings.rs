//! Algorithms with settings of their own, and those that use several CPUs.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{Desk, Ended};

/// An axis-aligned cube of width 1 around the origin.
const CUBE: &str = "v -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv 0.5 0.5 -0.5\nv -0.5 0.5 -0.5\nv -0.5 -0.5 0.5\nv 0.5 -0.5 0.5\n\
                    v 0.5 0.5 0.5\nv -0.5 0.5 0.5\nf 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\nf 2 3 7\n\
                    f 2 7 6\nf 4 1 5\nf 4 5 8\n";

#[test]
fn one_algorithm_under_two_names_is_not_silently_one_row() {
    let desk = Desk::new();
    for twice in ["box-tree:leaf_size=8,box-tree:leaf_size=8.0", "box-tree,box-tree:leaf_size=2"] {
        let Ended { code, stderr, .. } = desk.run(&["bench", "stock:torus-knot@600", "--algorithm", twice]);
        assert_eq!(code, 2, "{stderr}");
        assert!(stderr.contains("are the same algorithm"), "{stderr}");
    }
}

#[test]
fn several_settings_are_several_rows() {
    let desk = Desk::new();
    let out = desk.path("results");
    let args =
        ["bench", "stock:torus-knot@600", "--count", "60", "--passes", "2", "--out", out.to_str().expect("text")];
    let run = desk.json(&[&args[..], &["--algorithm", "box-tree:leaf_size=8,box-tree,box-tree"]].concat());
    let results = run["results"].as_array().expect("results");
    let names: Vec<_> = results.iter().map(|r| (r["algorithm"].as_str(), r["name"].as_str())).collect();
    assert_eq!(
        names,
        [(Some("box-tree:leaf_size=8"), Some("BoxTree (leaf_size 8)")), (Some("box-tree"), Some("BoxTree"))]
    );
    // Larger leaves: fewer boxes, more triangles. So the plugin was told.
    let work = |row: usize, what: &str| results[row][what].as_f64().expect("a number");
    assert!(work(0, "bv_tests_mean") < work(1, "bv_tests_mean"), "{results:?}");
    assert!(work(0, "primitive_tests_mean") > work(1, "primitive_tests_mean"), "{results:?}");
    for result in results {
        assert_eq!(result["wrong"], 0);
        assert_eq!(
            result["class"],
            serde_json::json!({"delivered": "first_contact", "order": "shuffled", "cpus": 1, "bits": 64})
        );
    }
    assert!(out.join("box-tree:leaf_size=8.csv").is_file());
    let heatmap = desk.path("x.csv");
    let heatmap = heatmap.to_str().expect("text");
    assert_eq!(
        desk.json(&["heatmap", "latest", "--algorithm", "box-tree:leaf_size=8", "-o", heatmap])["run"],
        run["id"]
    );
}

#[test]
fn a_setting_that_is_not_possible_is_said() {
    let desk = Desk::new();
    let refused =
        |algorithm: &str| desk.refused(&["bench", "stock:torus-knot@600", "--count", "5", "--algorithm", algorithm]);
    for (algorithm, expected) in [
        ("box-tree:leaf_size=0", "\"leaf_size\" must be a whole number from 1"),
        ("box-tree:speed=9", "it has no parameter \"speed\"; available: leaf_size"),
        ("box-tree:threads=2", "it has no parameter \"threads\""),
        ("brute-force:x=1", "it has no parameters"),
        ("quantum:x=1", "There is no algorithm \"quantum:x=1\""),
    ] {
        let sentence = refused(algorithm);
        assert!(sentence.contains(expected), "{algorithm}: {sentence}");
    }
}

/// The plugin answers only when it has as many threads as CPUs. It knows motions along x alone, so it is wrong about
/// equivalent instances, and the exit code says so.
#[test]
fn several_threads_are_measured_in_their_own_track() {
    let desk = Desk::new();
    let (cube, theirs) = (desk.file("cube.obj", CUBE), openmp(&desk).display().to_string());
    let poses: String = (0..40).map(|i| format!("1,0,0,{},0,1,0,0,0,0,1,0\n", 0.125 + f64::from(i) / 16.0)).collect();
    let poses = desk.file("poses.csv", poses);
    let ours = Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name("libocb_box_tree.so").display().to_string();
    let bench = |algorithm: &str| {
        let plugins = ["--plugins", &ours, "--plugins", &theirs, "--profile", "dev"];
        let ended = desk.run(
            &[&["bench", &cube, "--configurations", &poses, "--algorithm", algorithm, "--json"], &plugins[..]].concat(),
        );
        assert_eq!(ended.code, 3, "{ended:?}");
        let run: serde_json::Value = serde_json::from_str(&ended.stdout).expect("JSON");
        run["results"].clone()
    };
    let results = bench("box-tree,fixture:threads=2");
    let seen =
        |row: usize| (results[row]["outcome"]["name"].as_str(), &results[row]["n"], &results[row]["class"]["cpus"]);
    assert_eq!(
        [seen(0), seen(1)],
        [(Some("Completed"), &40.into(), &1.into()), (Some("Completed"), &40.into(), &2.into())]
    );
    assert_eq!(results[0]["wrong"], 0);
    // On one CPU its library is not there.
    let alone = &bench("fixture")[0]["outcome"];
    assert_eq!(alone["name"], "LoadError");
    assert!(alone["message"].as_str().is_some_and(|said| said.contains("libgomp")), "{alone}");
}

#[expect(clippy::disallowed_methods, reason = "the plugin is made here, as an author makes it")]
fn openmp(desk: &Desk) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let file = desk.path("openmp.so");
    let made = Command::new("cc")
        .args(["-shared", "-fPIC", "-O2", "-fvisibility=hidden", "-fopenmp", "-Wl,-z,now", "-I"])
        .arg(root.join("plugin-api/include"))
        .arg(root.join("sandbox/tests/fixtures/honest/openmp.c"))
        .args(["-lm", "-o"])
        .arg(&file)
        .output()
        .expect("a C compiler: install gcc");
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    file
}
