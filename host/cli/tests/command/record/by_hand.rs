//! Programs that record themselves: in C with the library, in Rust with the crate. Both write the same, also when they are killed.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

use opencollbench_record::{IDENTITY, Kind as Asked, Object, Query, Recording as Spool, Shape};
use zip::ZipArchive;

use super::{Desk, ROOT, command, dropped, read, said};

/// The program in C records into this folder, and is killed before it has closed the recording.
fn record_in_c(desk: &Desk, spool: &Path) {
    let built = Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name("record");
    assert!(built.join("libocb_record.so").exists(), "{} is missing; run `make recorders` first", built.display());
    let program = desk.path("by_hand");
    let mut compiler = command("cc");
    compiler.args(["-std=gnu11", "-Wall", "-Wextra", "-Werror", "-pedantic"]);
    compiler.arg(format!("-I{ROOT}/host/record/include")).arg(format!("{ROOT}/tests/record/by_hand.c"));
    compiler.arg("-o").arg(&program).arg(format!("-L{0}", built.display())).args(["-locb_record", "-lm"]);
    let (code, _, stderr) = said(compiler.output().expect("a compiler"));
    assert_eq!(code, 0, "{stderr}");
    let ended = command(&program).arg(spool).env("LD_LIBRARY_PATH", &built).status().expect("it starts");
    assert_eq!(ended.signal(), Some(9), "{ended}");
}

/// The same queries as those of the program in C.
fn record_in_rust(spool: &Path) {
    let spool = Spool::create(spool, "by \"hand\"", "some library", "1.2").expect("a spool");
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let add = |name: &str, shape| spool.object(name, shape).expect("an object");
    let corner = add("corner", Shape::Mesh { vertices: &vertices, triangles: &triangles });
    let ball = add("sphere", Shape::Sphere { radius: 0.5 });
    assert_eq!(add("sphere", Shape::Sphere { radius: 0.5 }), ball);
    spool.object("wrong", Shape::Mesh { vertices: &vertices, triangles: &[[0, 1, 4]] }).expect_err("no such vertex");
    let at = |kind, other: Object, x: f64| {
        let mut pose = IDENTITY;
        pose[3] = x;
        Query::new(kind, [corner, other], [IDENTITY, pose])
    };
    for i in 0..10_u32 {
        let (distance, time) = (Some(0.5 + f64::from(i)), Some(Duration::from_micros(1)));
        let query = at(Asked::Distance, ball, 2.0 + f64::from(i));
        spool.query(&Query { distance, time, group: u64::from(i / 2), ..query }).expect("recorded");
    }
    let others = [
        add("box", Shape::Box { size: [1.0, 2.0, 0.1] }),
        add("cylinder", Shape::Cylinder { radius: 0.5, length: 2.0 }),
        add("capsule", Shape::Capsule { radius: 0.25, length: 0.0 }),
    ];
    for (other, group) in others.into_iter().zip(5..) {
        for (kind, x, hit) in [
            (Asked::Collide, 0.0, true),
            (Asked::Contacts { most: 3 }, 10.0, false),
            (Asked::Tolerance { within: 0.25 }, 10.0, false),
            (Asked::Tolerance { within: 20.0 }, 10.0, true),
        ] {
            spool.query(&Query { hit: Some(hit), group, ..at(kind, other, x) }).expect("recorded");
        }
    }
    spool.query(&at(Asked::Distance, ball, f64::NAN)).expect_err("no pose");
    spool.leave_out(0).expect("counted");
}

/// Makes the recording of a spool, as its author would.
fn pack(desk: &Desk, spool: &Path, out: &str) -> (PathBuf, serde_json::Value) {
    let file = desk.path(out);
    let args = ["record", "--out", file.to_str().expect("text"), "--spool", spool.to_str().expect("text")];
    let packed = desk.json(&args);
    (file, packed)
}

/// Every file of a recording.
fn files(recording: &Path) -> Vec<(String, Vec<u8>)> {
    let mut archive = ZipArchive::new(File::open(recording).expect("a recording")).expect("a zip");
    let count = archive.len();
    let file = |i| {
        let mut file = archive.by_index(i).expect("a file");
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).expect("it can be read");
        (file.name().expect("a name").into_owned(), bytes)
    };
    (0..count).map(file).collect()
}

#[test]
fn a_program_in_c_can_record_itself() {
    let desk = Desk::new();
    let spool = desk.path("spool");
    record_in_c(&desk, &spool);
    let (out, packed) = pack(&desk, &spool, "h.ocbrec");
    let counts = ["objects", "queries", "seen"].map(|what| packed[what].as_u64());
    assert_eq!(counts, [Some(5), Some(22), Some(24)], "{packed}");
    let recording = read(&desk, "h.ocbrec");
    assert_eq!(recording.about.program, "by \"hand\"");
    assert_eq!(dropped(&recording), [("a pose is not finite", 1), ("an object was not recorded", 1)]);
    let out = out.to_str().expect("text");
    let result =
        desk.json(&["bench", "--workload", out, "--algorithm", "box-tree", "--passes", "1", "--order", "recorded"]);
    let claims = &result["recorded"]["claims"];
    assert_eq!((&claims[0]["claim"], &claims[0]["count"]), (&"right".into(), &22.into()), "{claims}");
}

#[test]
fn the_crate_records_what_the_library_for_c_records() {
    let desk = Desk::new();
    let [in_c, in_rust] = ["c", "rust"].map(|name| desk.path(name));
    record_in_c(&desk, &in_c);
    record_in_rust(&in_rust);
    let [mut in_c, mut in_rust] =
        [(in_c, "c.ocbrec"), (in_rust, "rust.ocbrec")].map(|(spool, out)| files(&pack(&desk, &spool, out).0));
    for (files, recorder) in [(&mut in_c, "opencollbench/record.h"), (&mut in_rust, "opencollbench-record (Rust)")] {
        let (_, about) = files.iter_mut().find(|(name, _)| name == "about.json").expect("it says where it comes from");
        let mut told: serde_json::Value = serde_json::from_slice(about).expect("JSON");
        assert_eq!(told["recorder"], recorder);
        told["recorder"] = "".into();
        *about = told.to_string().into_bytes();
    }
    let names = |files: &[(String, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&in_c), names(&in_rust));
    let queries = |name: &String| name == "queries.parquet";
    assert!(in_c.len() == 4 && names(&in_c).iter().any(queries), "{:?}", names(&in_c));
    for ((name, c), (_, rust)) in in_c.iter().zip(&in_rust) {
        assert!(c == rust, "{name}: {:?} and {:?}", String::from_utf8_lossy(c), String::from_utf8_lossy(rust));
    }
}

#[test]
fn what_a_killed_program_in_rust_recorded_is_kept() {
    let desk = Desk::new();
    let spool = desk.path("spool");
    let program = Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name("examples").join("endless");
    let build = "cargo build --release -p opencollbench-record --examples";
    assert!(program.exists(), "{} is missing; run `{build}` first", program.display());
    let mut child = command(program).arg(&spool).stdout(Stdio::piped()).spawn().expect("it starts");
    let mut printed: Vec<(u64, u64)> = Vec::new();
    let mut by_thread = [0; 2];
    for line in BufReader::new(child.stdout.take().expect("piped")).lines().map_while(Result::ok) {
        // The line that it was printing when it was killed may be there in part.
        let numbers = line.split_once(' ').and_then(|(thread, step)| Some((thread.parse().ok()?, step.parse().ok()?)));
        if let Some((thread, step)) = numbers {
            printed.push((thread, step));
            by_thread[thread as usize] += 1;
        }
        // On a busy machine one thread may be long at it before the other one begins.
        if by_thread.iter().all(|&steps| steps >= 2000) || printed.len() == 1_000_000 {
            child.kill().expect("SIGKILL");
        }
    }
    assert_eq!(child.wait().expect("reaped").signal(), Some(9));
    printed.pop();
    let (_, packed) = pack(&desk, &spool, "k.ocbrec");
    let recording = read(&desk, "k.ocbrec");
    assert_eq!(packed["dropped"], serde_json::json!([]));
    for thread in [0, 1] {
        let told: Vec<u64> = printed.iter().filter(|(group, _)| *group == thread).map(|(_, step)| *step).collect();
        let of_thread = recording.queries.iter().filter(|query| query.group == thread);
        let kept: Vec<u64> = of_thread.map(|query| query.configuration.pose_b.translation.x as u64).collect();
        // Each query that the program went on from is there, in order and none twice.
        assert!(told.len() > 1000 && kept.len() >= told.len(), "{} of {} are there", kept.len(), told.len());
        assert!(kept.iter().copied().eq(0..kept.len() as u64), "a query of thread {thread} is missing");
    }
    assert!(recording.scene.scene.objects.len() > 10, "{}", recording.scene.scene.objects.len());
}
