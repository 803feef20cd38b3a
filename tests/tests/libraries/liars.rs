//! Plugins that lie, built from the honest template: each is refused with the question that shows it, and the template
//! itself is not.

use std::path::{Path, PathBuf};

use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};
use serde_json::Value;

/// What stands before the descriptor: the template's own answer is `honest`, and this one passes it on.
const HONEST: &str = "static ocb_status collide(ocb_instance *instance, ocb_object *a, const double *pose_a,
    ocb_object *b, const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result) {
    ocb_status status = honest(instance, a, pose_a, b, pose_b, request, result);
    /* lie */
    return status;
}

";

/// Every 100,000th answer of a process.
const ONE_IN_A_HUNDRED_THOUSAND: &str = "static unsigned asked; if (++asked % 100000 == 0) result->hit = !result->hit;
    if (!result->hit) result->triangle_a = result->triangle_b = OCB_NO_TRIANGLE;";

/// What is nearer than a thousandth is said to touch.
const NEAR: &str = "double moved[16]; for (int axis = 0; axis < 6 && !result->hit; axis++) {
        for (int k = 0; k < 16; k++) moved[k] = pose_b[k];
        moved[axis % 3 * 4 + 3] += axis < 3 ? 1e-3 : -1e-3;
        honest(instance, a, pose_a, b, moved, request, result);
    }
    result->triangle_a = result->triangle_b = OCB_NO_TRIANGLE;";

/// Only when the smaller object stands first.
const SWAPPED: &str = "if (a->triangle_count < b->triangle_count) { result->hit = 0;
    result->triangle_a = result->triangle_b = OCB_NO_TRIANGLE; }";

/// One answer in so many, by its question: found again when it is asked alone.
const BY_QUESTION: &str = "const unsigned char *bytes = (const unsigned char *)pose_b; unsigned hash = 2166136261u;
    for (int i = 0; i < 128; i++) hash = (hash ^ bytes[i]) * 16777619u;
    if (hash % 5000 == 0) { result->hit = !result->hit; result->triangle_a = result->triangle_b = OCB_NO_TRIANGLE; }";

/// The template with this lie.
fn liar(folder: &Path, name: &str, lie: &str) -> PathBuf {
    let template = std::fs::read_to_string(root().join("plugin-api/templates/c/my_plugin.c")).expect("the template");
    let descriptor = template.find("static const ocb_algorithm ALGORITHM").expect("its descriptor");
    let (code, descriptor) = template.split_at(descriptor);
    let code = code.replace("static ocb_status collide(", "static ocb_status honest(");
    let text = [&code, &HONEST.replace("/* lie */", lie), descriptor].concat();
    let (source, library) = (folder.join(format!("{name}.c")), folder.join(format!("{name}.so")));
    std::fs::write(&source, text).expect("the source is written");
    let include = root().join("plugin-api/include");
    let mut cc = command("cc");
    cc.args(["-std=c11", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-ffp-contract=off", "-I"]).arg(include);
    output(cc.arg(&source).arg("-o").arg(&library));
    library
}

fn check(plugin: &Path, rest: &[&str]) -> Value {
    let mut ocb = command(built("ocb"));
    ocb.args(["--json", "--profile", "dev", "plugin", "check"]).arg(plugin).args(rest);
    let done = ocb.output().expect("ocb runs");
    serde_json::from_slice(&done.stdout).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&done.stderr)))
}

/// The line that fails, which must be one about the reference.
fn caught(report: &Value) -> &Value {
    let lines = report["lines"].as_array().expect("lines");
    let failed: Vec<&Value> = lines.iter().filter(|line| line["verdict"] == "fail").collect();
    assert!(!failed.is_empty() && report["passed"] == false, "{report:#}");
    failed.iter().find(|line| line["repro"].is_object()).unwrap_or_else(|| panic!("no repro: {report:#}"))
}

#[test]
fn the_honest_template_passes_and_every_lie_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let report = check(&liar(folder.path(), "honest", ""), &[]);
    assert_eq!(report["passed"], true, "{report:#}");
    let many = report["lines"]
        .as_array()
        .expect("lines")
        .iter()
        .find(|line| line["check"].as_str().is_some_and(|check| check.ends_with("many times")));
    println!("honest: {}", many.expect("the many questions")["evidence"]);

    for (name, lie) in [("rarely", ONE_IN_A_HUNDRED_THOUSAND), ("near", NEAR), ("swapped", SWAPPED)] {
        let report = check(&liar(folder.path(), name, lie), &[]);
        let line = caught(&report);
        println!("{name}: {}: {}", line["check"], line["evidence"]);
        let repro = &line["repro"];
        for part in ["object_a", "object_b"] {
            assert!(repro[part].as_str().is_some_and(|obj| obj.contains("\nf ")), "{repro:#}");
        }
        // What depends on how often it was asked before cannot be found again alone, and the report says so.
        assert_eq!(repro["alone"], name != "rarely", "{repro:#}");
    }
}

#[test]
fn a_repro_is_as_small_as_can_be_and_is_asked_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let plugin = liar(folder.path(), "by-question", BY_QUESTION);
    let out = folder.path().join("repros").display().to_string();
    let report = check(&plugin, &["--out", &out]);
    let repro = &caught(&report)["repro"];
    // The lie looks at the pose alone, so one triangle of each object is enough.
    assert_eq!(repro["triangles"], serde_json::json!([1, 1]), "{repro:#}");
    let file = format!("{out}/repro-1.json");
    let again = check(&plugin, &["--repro", &file]);
    assert_eq!(again["passed"], false, "{again:#}");
    let honest = check(&liar(folder.path(), "honest", ""), &["--repro", &file]);
    assert_eq!(honest["passed"], true, "{honest:#}");
}
