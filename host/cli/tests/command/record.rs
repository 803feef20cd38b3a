//! `ocb record`: programs that know nothing of it, on Debian's libfcl and on python-fcl, are recorded, and their answers stay.

mod by_hand;
mod coal;

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use ocb_core::workload::{Kind, Recorded};
use ocb_service::Recording;

use crate::support::Desk;

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// What the programs end with, and what a shell says of SIGKILL.
const CODE: i32 = 3;
const KILLED: i32 = 137;

#[expect(clippy::disallowed_methods, reason = "the test runs the program that is recorded")]
fn command(program: impl AsRef<Path>) -> Command {
    Command::new(program.as_ref())
}

fn said(Output { status, stdout, stderr }: Output) -> (i32, String, String) {
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code().unwrap_or(-1), text(stdout), text(stderr))
}

/// A C++ program, compiled as its author would.
fn compiled(name: &str, options: &[&str]) -> PathBuf {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let new = program.with_extension(std::process::id().to_string());
    let mut compiler = command("c++");
    compiler.args(["-std=c++17", "-O2", "-isystem", "/usr/include/eigen3"]);
    compiler.arg(format!("{ROOT}/tests/record/{name}.cpp")).arg("-o").arg(&new).args(options).arg("-pthread");
    let (code, _, stderr) = said(compiler.output().expect("a compiler"));
    assert_eq!(code, 0, "{stderr}");
    std::fs::rename(new, &program).expect("the program");
    program
}

/// The program on FCL; to compile it takes longer than the tests.
static ROBOT: LazyLock<PathBuf> = LazyLock::new(|| compiled("robot", &["-lfcl", "-lccd"]));

/// Python with the libraries, and a program.
fn python(program: &str) -> [PathBuf; 2] {
    let python = Path::new(ROOT).join(".tools/record/bin/python");
    assert!(python.exists(), "not run: the collision libraries of Python are not installed");
    [python, Path::new(ROOT).join("tests/record").join(program)]
}

/// Records a program; gives the exit code and what both said.
fn record(desk: &Desk, out: &str, options: &[&str], program: &[&Path], args: &[&str]) -> (i32, String, String) {
    let built = Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name("record/libocb_record_fcl.so");
    assert!(built.exists(), "{} is missing; run `make recorders` first", built.display());
    let mut record = desk.command(&["record", "--out", desk.path(out).to_str().expect("text")]);
    record.args(options).arg("--").args(program).args(args);
    said(record.output().expect("it starts"))
}

fn read(desk: &Desk, out: &str) -> Recording {
    Recording::read(&desk.path(out)).expect("a recording")
}

/// The answers to the first queries are those that the program printed.
fn assert_as_printed(queries: &[Recorded], printed: &str) -> usize {
    let mut lines = 0;
    for (line, query) in printed.lines().zip(queries) {
        match line.split_once(' ').expect("two words") {
            (asked @ ("collide" | "tolerance"), hit) => {
                assert_eq!(query.answered.hit, Some(hit == "1"), "{line}: {query:?}");
                match (asked, query.kind, query.limit) {
                    ("collide", Kind::Collide, 1.0)
                    | ("collide", Kind::Contacts, 5.0)
                    | ("tolerance", Kind::Tolerance, 0.25) => {}
                    other => panic!("{other:?}: {line}"),
                }
            }
            ("distance", distance) => {
                assert_eq!(query.answered.distance, Some(distance.parse().expect("a number")), "{line}");
                assert_eq!(query.kind, Kind::Distance);
            }
            _ => break,
        }
        assert!(query.seconds.is_some_and(|seconds| seconds > 0.0 && seconds < 10.0), "{query:?}");
        lines += 1;
    }
    lines
}

/// Dropped queries by reason.
fn dropped(recording: &Recording) -> Vec<(&str, u64)> {
    recording.about.dropped.iter().map(|dropped| (dropped.reason.as_str(), dropped.count)).collect()
}

#[test]
fn a_program_on_libfcl_gives_the_same_answers_and_is_recorded() {
    let desk = Desk::new();
    let robot = ROBOT.as_path();
    let plain = said(command(robot).arg("20").output().expect("it starts"));
    let (code, stdout, stderr) = record(&desk, "r.ocbrec", &[], &[robot], &["20"]);
    assert_eq!((code, &stdout), (CODE, &plain.1), "{stderr}");
    assert_eq!(plain.0, CODE);
    assert!(stderr.contains("1 queries (a cone is not a recorded kind of object)"), "{stderr}");

    let recording = read(&desk, "r.ocbrec");
    let names: Vec<&str> = recording.scene.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["mesh of 400 triangles", "mesh of 160 triangles", "box", "sphere", "capsule"]);
    let queries = &recording.queries;
    // Four objects in 20 rounds, asked twice; then once more of the geometries.
    assert_eq!(assert_as_printed(queries, &stdout), 161);
    assert_eq!(queries[161].answered.hit, None, "a result that had a contact tells nothing");
    // What follows: the manager asks in one group, two threads ask 20 times each, the child once.
    assert_eq!(recording.about.seen, queries.len() as u64 + 1);
    let managed = &queries[162..queries.len() - 41];
    assert!(managed.len() > 1 && managed.iter().all(|query| query.group == managed[0].group), "{}", managed.len());
    let groups: HashSet<u64> = queries.iter().map(|query| query.group).collect();
    assert_eq!(groups.len(), queries.len() - managed.len() + 1);
    let line = stdout.lines().find_map(|line| line.strip_prefix("child ")).expect("the child's answer");
    assert_eq!(queries.last().expect("a query").answered.hit, Some(line == "1"));
    assert_eq!((&*recording.about.program, &*recording.about.libraries), ("robot 20", &["fcl 0.7.0".to_owned()][..]));

    // The program asked FCL, and box-tree and the oracle agree with it.
    let replay = desk.path("r.ocbrec");
    let replay = replay.to_str().expect("text");
    let result =
        desk.json(&["bench", "--workload", replay, "--algorithm", "box-tree", "--passes", "1", "--order", "recorded"]);
    let claims = result["recorded"]["claims"].as_array().expect("claims");
    assert!(claims.iter().all(|claim| claim["claim"] == "right" || claim["claim"] == "undecided"), "{claims:?}");
    assert!(claims.iter().any(|claim| claim["claim"] == "right" && claim["count"].as_u64() > Some(150)), "{claims:?}");
}

#[test]
fn a_python_program_gives_the_same_answers_and_is_recorded() {
    let desk = Desk::new();
    let [python, program] = python("robot.py");
    let plain = said(command(&python).arg(&program).arg("20").output().expect("it starts"));
    let (code, stdout, stderr) = record(&desk, "p.ocbrec", &[], &[&python, &program], &["20"]);
    assert_eq!((code, &stdout), (CODE, &plain.1), "{stderr}");
    assert_eq!(plain.0, CODE, "{}", plain.2);
    let recording = read(&desk, "p.ocbrec");
    let queries = &recording.queries;
    assert_eq!(assert_as_printed(queries, &stdout), 120);
    assert_eq!(dropped(&recording), [("Cone is not a recorded kind of object", 1)]);
    // Through the manager in one group, and through trimesh, once: a ring against a convex body, whose hit is not told.
    let (last, managed) = queries[120..].split_last().expect("queries of managers");
    assert!(managed.len() > 1 && managed.iter().all(|query| query.group == managed[0].group), "{managed:?}");
    assert_eq!(last.answered.hit, None);
    let cube = last.objects[0].max(last.objects[1]);
    assert_eq!(recording.scene.scene.objects[cube as usize].name, "convex body of 12 triangles");
    assert_eq!(recording.about.libraries, ["python-fcl 0.7.0.11"]);
    assert_eq!(recording.about.program, "python robot.py 20");
}

#[test]
fn coal_and_mujoco_are_recorded_in_python() {
    let desk = Desk::new();
    let [python, program] = python("others.py");
    let answers = |library: &str| {
        let plain = said(command(&python).arg(&program).args([library, "20"]).output().expect("it starts"));
        let (code, stdout, stderr) = record(&desk, "o.ocbrec", &[], &[&python, &program], &[library, "20"]);
        assert_eq!((code, &stdout), (CODE, &plain.1), "{stderr}");
        (read(&desk, "o.ocbrec"), stdout)
    };
    let (coal, printed) = answers("coal");
    assert_eq!(dropped(&coal), [("Cone is not a recorded kind of object", 1)]);
    assert_eq!(coal.about.libraries, ["coal 3.0.3"]);
    for (line, query) in printed.lines().zip(&coal.queries) {
        let (asked, answer) = line.split_once(' ').expect("two words");
        if asked == "distance" {
            assert_eq!(query.answered.distance, answer.parse().ok(), "{line}");
        } else {
            let margin = if query.kind == Kind::Tolerance { 0.25 } else { 1.0 };
            assert_eq!((query.answered.hit, query.limit), (Some(answer == "1"), margin), "{line}");
        }
    }
    assert_eq!(coal.queries.iter().filter(|query| query.kind == Kind::Tolerance).count(), 40);

    let (mujoco, printed) = answers("mujoco");
    assert_eq!(dropped(&mujoco), [("mjGEOM_ELLIPSOID is not a recorded kind of object", 20)]);
    // Each fourth line is about the ellipsoid.
    let kept = printed.lines().enumerate().filter(|(i, _)| i % 4 != 3);
    let mut closer = 0;
    for ((_, line), query) in kept.zip(&mujoco.queries) {
        let distance: f64 = line.strip_prefix("tolerance ").expect("a distance").parse().expect("a number");
        assert_eq!((query.kind, query.limit), (Kind::Tolerance, 0.5));
        let of_hull = mujoco.scene.scene.objects[query.objects[1] as usize].name == "part";
        let told = (!of_hull || distance > 0.0).then_some(distance < 0.5);
        assert_eq!(query.answered.hit, told, "{line}");
        closer += usize::from(told == Some(true));
    }
    assert!(mujoco.queries.len() == 60 && closer > 3, "{closer} of {}", mujoco.queries.len());
}

#[test]
fn what_a_killed_program_asked_is_kept() {
    let desk = Desk::new();
    let robot = ROBOT.as_path();
    let (code, stdout, stderr) = record(&desk, "r.ocbrec", &[], &[robot], &["30", "killed"]);
    assert_eq!(code, KILLED, "{stderr}");
    assert!(stderr.contains("ended by signal 9"), "{stderr}");
    let queries = read(&desk, "r.ocbrec").queries;
    assert_eq!((queries.len(), assert_as_printed(&queries, &stdout)), (240, 240));

    let [python, program] = python("robot.py");
    let (code, stdout, stderr) = record(&desk, "p.ocbrec", &[], &[&python, &program], &["30", "killed"]);
    assert_eq!(code, KILLED, "{stderr}");
    let queries = read(&desk, "p.ocbrec").queries;
    assert_eq!((queries.len(), assert_as_printed(&queries, &stdout)), (180, 180));
}

#[test]
fn of_too_many_queries_whole_groups_are_kept() {
    let desk = Desk::new();
    let robot = ROBOT.as_path();
    record(&desk, "all.ocbrec", &[], &[robot], &["100"]);
    record(&desk, "few.ocbrec", &["--limit", "100"], &[robot], &["100"]);
    let (all, few) = (read(&desk, "all.ocbrec"), read(&desk, "few.ocbrec"));
    assert!((40..=101).contains(&few.queries.len()), "{}", few.queries.len());
    assert_eq!(few.about.seen, all.about.seen);
    // What could not be recorded anyway may be among what was sampled away.
    let (reason, count) = dropped(&few)[0];
    assert!(reason == "sampled" && count >= (all.queries.len() - few.queries.len()) as u64, "{:?}", few.about.dropped);
    // Evenly over the run of the program, and each as it was.
    let kept: Vec<u64> = few.queries.iter().map(|query| query.sequence).take(40).collect();
    let step = kept[1] - kept[0];
    assert!(step >= 8 && kept.windows(2).all(|pair| pair[1] - pair[0] == step), "{kept:?}");
    for query in few.queries.iter().take(40) {
        let same = &all.queries[query.sequence as usize];
        assert_eq!((query.configuration, query.answered.hit), (same.configuration, same.answered.hit));
    }
}

#[test]
fn what_cannot_be_recorded_is_told() {
    let desk = Desk::new();
    let (code, _, stderr) = record(&desk, "n.ocbrec", &[], &[Path::new("true")], &[]);
    assert_eq!(code, 2);
    assert!(
        stderr.contains("Nothing was recorded: the program asked none of FCL (libfcl), Coal (libcoal), python-fcl"),
        "{stderr}"
    );
    let (code, _, stderr) = record(&desk, "n.ocbrec", &[], &[Path::new("no-such-program")], &[]);
    assert_eq!((code, &*stderr), (2, "ocb: Cannot run no-such-program: no such file or directory.\n"));
    let (code, _, stderr) = record(&desk, "none/n.ocbrec", &[], &[Path::new("true")], &[]);
    assert_eq!(code, 2);
    assert!(stderr.starts_with("ocb: Cannot write into the folder "), "{stderr}");
    assert!(desk.refused(&["record", "--out", "n.ocbrec"]).contains("<PROGRAM>"));
    assert!(!desk.path("n.ocbrec").exists());
    let empty = desk.path("empty");
    std::fs::create_dir(&empty).expect("a folder");
    let told = desk.refused(&["record", "--out", "n.ocbrec", "--spool", empty.to_str().expect("text")]);
    assert!(told.contains("\"empty\" holds no recording"), "{told}");
    // Nothing of the spools is left behind.
    let left: Vec<_> =
        std::fs::read_dir(desk.path("")).expect("a folder").map(|entry| entry.expect("one").file_name()).collect();
    assert!(left.iter().all(|name| !name.to_string_lossy().ends_with(".spool")), "{left:?}");
}

#[test]
fn poses_that_were_written_down_are_a_recording() {
    let desk = Desk::new();
    let box_of = |side: f64| {
        let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2].map(|bit| side * (bit as f64 - 0.5));
        let faces = [
            [1, 3, 2],
            [2, 3, 4],
            [5, 6, 7],
            [6, 8, 7],
            [1, 2, 5],
            [2, 6, 5],
            [3, 7, 4],
            [4, 7, 8],
            [1, 5, 3],
            [3, 5, 7],
            [2, 4, 6],
            [4, 8, 6],
        ];
        let lines = (0..8).map(corner).map(|[x, y, z]| format!("v {x} {y} {z}\n"));
        lines.chain(faces.map(|[a, b, c]| format!("f {a} {b} {c}\n"))).collect::<String>()
    };
    let write = |name: &str, text: &str| std::fs::write(desk.path(name), text).expect("written");
    write("cube.obj", &box_of(1.0));
    let moved = |x: f64| format!("[1,0,0,{x}, 0,1,0,0, 0,0,1,0]");
    let queries = format!(
        r#"{{"program": "mine", "library": "Mine 1.0",
            "objects": [{{"name": "cube", "file": "cube.obj"}}, {{"name": "ball", "geometry": {{"kind": "sphere", "radius": 0.5}}}}],
            "queries": [{{"objects": ["cube", "ball"], "query": "distance", "pose_b": {}, "group": 7, "distance": 1.0, "seconds": 1e-6}},
                        {{"objects": ["ball", "cube"], "query": "collide", "pose_a": {}, "hit": false}},
                        {{"objects": ["ball", "cube"], "query": "tolerance", "limit": 0.25, "pose_a": {}}}]}}"#,
        moved(2.0),
        moved(0.9),
        moved(1.2),
    );
    write("queries.json", &queries);
    let out = desk.path("mine.ocbrec");
    let run = |args: &[&str]| {
        let out = out.to_str().expect("text");
        said(desk.command(&[&["record", "--out", out, "--json"][..], args].concat()).output().expect("it starts"))
    };
    let poses = desk.path("queries.json");
    let (code, stdout, stderr) = run(&["--poses", poses.to_str().expect("text")]);
    assert_eq!(code, 0, "{stderr}");
    assert!(stdout.contains("\"queries\": 3") && stdout.contains("\"objects\": 2"), "{stdout}");
    let recording = read(&desk, "mine.ocbrec");
    assert_eq!(
        (recording.about.program.as_str(), &recording.about.libraries[..]),
        ("mine", &["Mine 1.0".to_owned()][..])
    );
    let told: Vec<_> = recording
        .queries
        .iter()
        .map(|q| (q.kind, q.objects, q.group, q.limit, q.answered.hit, q.answered.distance))
        .collect();
    let expected = [
        (Kind::Distance, [0, 1], 7, 0.0, None, Some(1.0)),
        (Kind::Collide, [1, 0], 1, 0.0, Some(false), None),
        (Kind::Tolerance, [1, 0], 2, 0.25, None, None),
    ];
    assert_eq!(told, expected);
    assert_eq!(recording.queries[1].configuration.pose_a.translation.x, 0.9);
    // The replay judges what was written: the ball does touch the cube at 0.9.
    let replay = desk.command(&[
        "bench",
        "--workload",
        out.to_str().expect("text"),
        "--algorithm",
        "box-tree",
        "--passes",
        "1",
        "--json",
    ]);
    let (_, stdout, stderr) = said({ replay }.output().expect("it starts"));
    let result: serde_json::Value = serde_json::from_str(&stdout).unwrap_or_else(|e| panic!("{e}: {stderr}"));
    let claims = serde_json::json!([{ "claim": "right", "count": 1 }, { "claim": "missed_collision", "count": 1 }]);
    assert_eq!(result["recorded"]["claims"], claims, "{result:#}");

    // A pair in the poses of a configuration file.
    write("poses.csv", "1,0,0,3, 0,1,0,0, 0,0,1,0\n1,0,0,0.5, 0,1,0,0, 0,0,1,0\n");
    let (csv, cube) = (desk.path("poses.csv"), desk.path("cube.obj"));
    let [csv, cube] = [&csv, &cube].map(|path| path.to_str().expect("text"));
    let (code, _, stderr) = run(&["--poses", csv, "--object", cube, "--object", cube, "--query", "collide"]);
    assert_eq!(code, 0, "{stderr}");
    let recording = read(&desk, "mine.ocbrec");
    let names: Vec<_> = recording.scene.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!((names, recording.queries.len()), (vec!["cube A", "cube B"], 2));
    assert!(recording.queries.iter().all(|query| query.kind == Kind::Collide && query.answered == Default::default()));

    let (code, _, stderr) = run(&["--poses", csv, "--object", cube, "--object", cube, "--query", "contacts"]);
    assert_eq!(code, 0, "{stderr}");
    assert!(read(&desk, "mine.ocbrec").queries.iter().all(|query| (query.kind, query.limit) == (Kind::Contacts, 1.0)));
    let (code, _, stderr) = run(&["--poses", csv, "--object", cube, "--object", cube, "--query", "tolerance"]);
    assert!(code == 2 && stderr.contains("one of collide, contacts, distance"), "{stderr}");

    let refused = |text: &str, words: &str| {
        write("bad.json", text);
        let bad = desk.path("bad.json");
        let (code, _, stderr) = run(&["--poses", bad.to_str().expect("text")]);
        assert_eq!(code, 2, "{text}: {stderr}");
        assert!(stderr.contains(words) && stderr.lines().count() == 1, "{words:?}: {stderr}");
    };
    refused("{}", "missing field `queries`");
    refused("{\"queries\": []}", "has no objects");
    refused(
        &queries.replace("\"program\"", "\"scene\": \"arm.ocbscene\", \"program\""),
        "\"arm.ocbscene\" cannot be opened",
    );
    refused(&queries.replace("\"library\"", "\"books\""), "unknown field `books`");
    refused(&queries.replace("\"file\"", "\"path\""), "unknown field `path`");
    refused(&queries.replace("\"hit\"", "\"hits\""), "unknown field `hits`");
    refused(&queries.replace("cube.obj", "cube.stl"), "cube.stl cannot be read");
    refused(&queries.replace("[\"ball\", \"cube\"]", "[\"ball\", \"cup\"]"), "query 2: there is no object \"cup\"");
    refused(&queries.replace("[\"ball\", \"cube\"]", "[\"ball\", \"ball\"]"), "asked about itself");
    refused(&queries.replace("[1,0,0,0.9,", "[2,0,0,0.9,"), "row 2: the 3x3 part");
    refused(&queries.replace("[1,0,0,0.9,", "[0.9,"), "query 2: a matrix has 16 numbers");
    refused(&queries.replace("0.25", "-1"), "query 3: `limit`");
    refused(&queries.replace("\"radius\": 0.5", "\"radius\": -1"), "radius");
    refused(&queries.replace("\"file\": \"cube.obj\"", "\"solid\": true"), "either a file");
    let (code, _, stderr) = run(&["--poses", csv, "--object", cube]);
    assert!(code == 2 && stderr.contains("--object twice"), "{stderr}");
}
