//! Programs on libcoal that know nothing of recorders are recorded, and their answers stay.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use super::{CODE, Desk, KILLED, ROOT, assert_as_printed, command, compiled, dropped, python, read, record, said};

/// Where the wheel of Coal is.
fn coal() -> String {
    format!("{ROOT}/.tools/coal/cmeel.prefix")
}

/// The program, linked with Coal as its wheel ships it.
fn robot() -> &'static Path {
    static ROBOT: LazyLock<PathBuf> = LazyLock::new(|| {
        let (include, lib) = (format!("-isystem{}/include", coal()), format!("-L{}/lib", coal()));
        compiled("coal_robot", &[&include, &lib, "-lcoal", &format!("-Wl,-rpath,{}/lib", coal())])
    });
    assert!(Path::new(&coal()).join("lib/libcoal.so").exists(), "not run: Coal is not installed");
    let recorder = Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name("record/libocb_record_coal.so");
    assert!(recorder.exists(), "{} is missing; run `make recorders` first", recorder.display());
    &ROBOT
}

#[test]
fn a_program_on_libcoal_gives_the_same_answers_and_is_recorded() {
    let desk = Desk::new();
    let robot = robot();
    let plain = said(command(robot).arg("20").output().expect("it starts"));
    let (code, stdout, stderr) = record(&desk, "c.ocbrec", &[], &[robot], &["20"]);
    assert_eq!((code, &stdout), (CODE, &plain.1), "{stderr}");
    assert_eq!(plain.0, CODE, "{}", plain.2);

    let recording = read(&desk, "c.ocbrec");
    let names: Vec<&str> = recording.scene.scene.objects.iter().map(|object| object.name.as_str()).collect();
    let expected = ["mesh of 400 triangles", "mesh of 160 triangles", "box", "sphere", "capsule", "cylinder"];
    assert_eq!((&names[..6], &names[6..]), (&expected[..], &["convex body of 4 triangles"][..]));
    let queries = &recording.queries;
    // Five objects in 20 rounds, asked three times; then five poses of geometries and pairs, four times; then a collision.
    assert_eq!(assert_as_printed(queries, &stdout), 321);
    assert_eq!(queries[321].answered.hit, None, "a result that had a contact tells nothing");
    // What follows: the manager asks in one group, the convex body is asked about, two threads ask 20 times each, the child once.
    let unsupported = [
        ("a body with a swept sphere is not recorded", 1),
        ("a cone is not a recorded kind of object", 1),
        ("a negative security margin is not recorded", 1),
    ];
    assert_eq!(dropped(&recording), unsupported);
    assert_eq!(recording.about.seen, queries.len() as u64 + 3);
    let (managed, others) = queries[322..].split_at(queries.len() - 322 - 42);
    assert!(managed.len() > 1 && managed.iter().all(|query| query.group == managed[0].group), "{}", managed.len());
    assert_eq!(others[0].answered.hit, stdout.contains("convex 0").then_some(false));
    let groups: HashSet<u64> = queries.iter().map(|query| query.group).collect();
    assert_eq!(groups.len(), queries.len() - managed.len() + 1);
    let line = stdout.lines().find_map(|line| line.strip_prefix("child ")).expect("the child's answer");
    assert_eq!(queries.last().expect("a query").answered.hit, Some(line == "1"));
    assert_eq!(recording.about.libraries, ["coal 3.0.3"]);
    assert_eq!(recording.about.program, "coal_robot 20");

    // Each yes or no of Coal is right, and its distances are right up to the tolerance of its iterations.
    let replay = desk.path("c.ocbrec");
    let replay = replay.to_str().expect("text");
    let result =
        desk.json(&["bench", "--workload", replay, "--algorithm", "box-tree", "--passes", "1", "--order", "recorded"]);
    let recorded = &result["recorded"];
    let claims = recorded["claims"].as_array().expect("claims");
    let fair = ["right", "undecided", "distance_over", "distance_under"];
    assert!(claims.iter().all(|claim| fair.iter().any(|word| claim["claim"] == *word)), "{claims:?}");
    assert!(claims.iter().any(|claim| claim["claim"] == "right" && claim["count"].as_u64() > Some(300)), "{claims:?}");
    assert!(recorded["largest_error"].as_f64().is_some_and(|error| error < 1e-6), "{recorded}");
}

#[test]
fn what_pinocchio_asks_from_python_is_recorded() {
    let desk = Desk::new();
    let [python, program] = python("moving.py");
    let plain = said(command(&python).arg(&program).arg("20").output().expect("it starts"));
    let (code, stdout, stderr) = record(&desk, "p.ocbrec", &[], &[&python, &program], &["20"]);
    assert_eq!((code, &stdout), (CODE, &plain.1), "{stderr}");
    let recording = read(&desk, "p.ocbrec");
    assert_eq!((recording.queries.len(), assert_as_printed(&recording.queries, &stdout)), (40, 40));
    assert!(stdout.contains("collide 1") && stdout.contains("collide 0"), "{stdout}");
    assert_eq!(recording.about.recorder, "opencollbench record for coal");
}

#[test]
fn what_a_killed_program_on_libcoal_asked_is_kept() {
    let desk = Desk::new();
    let robot = robot();
    let (code, stdout, stderr) = record(&desk, "k.ocbrec", &[], &[robot], &["30", "killed"]);
    assert_eq!(code, KILLED, "{stderr}");
    let queries = read(&desk, "k.ocbrec").queries;
    assert_eq!((queries.len(), assert_as_printed(&queries, &stdout)), (450, 450));
}
