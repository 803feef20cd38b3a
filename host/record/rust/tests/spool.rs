//! What the spool holds: limits, refused input, several threads, and a disk that fails.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use opencollbench_record::{Error, IDENTITY, Kind, Object, Pose, Query, Recording, Refusal, Shape};
use tempfile::TempDir;

const CORNER: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn recording() -> (TempDir, Recording) {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = Recording::create(folder.path().join("spool"), "p", "l", "1").expect("a spool");
    (folder, recording)
}

fn ball(recording: &Recording, radius: f64) -> Object {
    recording.object("ball", Shape::Sphere { radius }).expect("a ball")
}

fn query(objects: [Object; 2], group: u64) -> Query {
    Query { hit: Some(false), group, ..Query::new(Kind::Collide, objects, [IDENTITY, IDENTITY]) }
}

/// Sequence and group of each row.
fn rows(folder: &TempDir) -> Vec<(u64, u64)> {
    let bytes = fs::read(folder.path().join("spool/queries.bin")).expect("queries");
    assert_eq!(bytes.len() % 256, 0);
    let number = |row: &[u8], at: usize| u64::from_le_bytes(row[at..at + 8].try_into().expect("eight bytes"));
    bytes.chunks(256).map(|row| (number(row, 0), number(row, 8))).collect()
}

fn text(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join("spool").join(name)).expect("a text")
}

fn refused<T>(what: Result<T, Error>) -> Refusal {
    match what {
        Err(Error::Refused(refusal)) => refusal,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it was recorded"),
    }
}

#[test]
fn shapes_that_cannot_be_replayed_are_refused() {
    let (folder, recording) = recording();
    let mesh = |vertices: &[[f64; 3]], triangles: &[[u32; 3]]| {
        refused(recording.object("mesh", Shape::Mesh { vertices, triangles }))
    };
    assert_eq!(mesh(&CORNER, &[]), Refusal::NoTriangles);
    assert_eq!(mesh(&CORNER, &[[0, 1, 4]]), Refusal::Vertex);
    assert_eq!(mesh(&[], &[[0, 0, 0]]), Refusal::Vertex);
    assert_eq!(mesh(&[[f64::NAN; 3]; 3], &[[0, 1, 2]]), Refusal::Coordinate);
    assert_eq!(mesh(&[[0.0; 3], [2e18, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]), Refusal::Coordinate);
    assert_eq!(mesh(&CORNER, &[[0, 1, 1], [2, 2, 3]]), Refusal::NoArea);
    assert_eq!(mesh(&vec![[0.0; 3]; 5_000_001], &[[0, 1, 2]]), Refusal::LargeMesh);
    let no_length = |shape| assert_eq!(refused(recording.object("primitive", shape)), Refusal::Length, "{shape:?}");
    for bad in [0.0, -1.0, 1e-101, 1e19, f64::NAN, f64::INFINITY] {
        no_length(Shape::Sphere { radius: bad });
        no_length(Shape::Box { size: [1.0, bad, 1.0] });
        no_length(Shape::Cylinder { radius: 1.0, length: bad });
        no_length(Shape::Capsule { radius: bad, length: 0.0 });
        if bad != 0.0 {
            no_length(Shape::Capsule { radius: 1.0, length: bad });
        }
    }
    let name = |name: &str| recording.object(name, Shape::Sphere { radius: 1.0 });
    assert_eq!(refused(name("")), Refusal::Name);
    assert_eq!(refused(name(&"x".repeat(201))), Refusal::Name);
    assert!(!folder.path().join("spool/objects.jsonl").exists(), "a refused object was written");
    name(&"x".repeat(200)).expect("200 bytes");
}

#[test]
fn queries_that_cannot_be_replayed_are_refused_and_counted() {
    let ((folder, first), (_other, second)) = (recording(), recording());
    let [ours, theirs] = [&first, &second].map(|recording| ball(recording, 1.0));
    assert_eq!(refused(first.query(&query([ours, theirs], 0))), Refusal::Object);
    for (place, bad) in [(0, f64::NAN), (11, f64::NEG_INFINITY)] {
        let mut pose: Pose = IDENTITY;
        pose[place] = bad;
        let query = Query { poses: [IDENTITY, pose], ..query([ours, ours], 0) };
        assert_eq!(refused(first.query(&query)), Refusal::Pose);
    }
    for within in [-1e-9, f64::NAN, f64::INFINITY] {
        let query = Query { kind: Kind::Tolerance { within }, ..query([ours, ours], 0) };
        assert_eq!(refused(first.query(&query)), Refusal::Tolerance);
    }
    first.leave_out(0).expect("counted");
    first.query(&Query { distance: Some(f64::NAN), ..query([ours, ours], 7) }).expect("a query without its distance");
    first.close().expect("closed");
    assert_eq!(rows(&folder), [(7, 7)], "the seven before it are counted");
    let dropped = "{\"reason\": \"a pose is not finite\", \"count\": 2}\n\
                   {\"reason\": \"an object was not recorded\", \"count\": 2}\n\
                   {\"reason\": \"the limit of a query is negative or not finite\", \"count\": 3}\n";
    assert_eq!(text(&folder, "dropped.jsonl"), dropped);
}

#[test]
fn a_recording_needs_a_new_folder_and_a_name() {
    let (folder, recording) = recording();
    let create = |name: &str, program: &str| Recording::create(folder.path().join(name), program, "l", "1");
    for there in ["spool", "none/spool"] {
        match create(there, "p") {
            Err(Error::File { path, .. }) => assert_eq!(path, folder.path().join(there)),
            _ => panic!("{there} is no new folder"),
        }
    }
    assert_eq!(refused(create("new", "")), Refusal::Name);
    assert_eq!(refused(create("new", &"p".repeat(201))), Refusal::Name);
    assert!(!folder.path().join("new").exists());
    drop(recording);
}

#[test]
fn of_too_many_queries_whole_groups_are_kept() {
    let (folder, recording) = recording();
    let recording = recording.limited(100);
    let objects = [ball(&recording, 1.0), ball(&recording, 2.0)];
    for sequence in 0..1000 {
        recording.query(&query(objects, sequence / 3)).expect("recorded, or counted");
    }
    recording.close().expect("closed");
    let rows = rows(&folder);
    assert!((50..=100).contains(&rows.len()), "{}", rows.len());
    // Three queries of each group, in their order, and the groups evenly over the run.
    let groups: Vec<u64> = rows.iter().map(|row| row.1).collect::<BTreeSet<_>>().into_iter().collect();
    let whole: Vec<(u64, u64)> = groups.iter().flat_map(|group| [0, 1, 2].map(|i| (3 * group + i, *group))).collect();
    assert_eq!(rows, whole[..rows.len()]);
    assert!(groups.windows(2).all(|pair| pair[1] - pair[0] == groups[1]) && groups[1].is_power_of_two(), "{groups:?}");
    let sampled = format!("{{\"reason\": \"sampled\", \"count\": {}}}\n", 1000 - rows.len());
    assert_eq!(text(&folder, "dropped.jsonl"), sampled);
}

#[test]
fn a_group_beyond_the_limit_is_cut_and_counted() {
    let (folder, recording) = recording();
    let recording = recording.limited(0);
    let objects = [ball(&recording, 1.0); 2];
    (0..3).for_each(|_| recording.query(&query(objects, 4)).expect("recorded, or counted"));
    recording.close().expect("closed");
    assert_eq!(rows(&folder), [(0, 4)]);
    let cut = "{\"reason\": \"a group has more queries than the limit\", \"count\": 2}\n";
    assert_eq!(text(&folder, "dropped.jsonl"), cut);
}

#[test]
fn threads_write_whole_rows_and_each_object_once() {
    let (folder, recording) = recording();
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let recording = &recording;
            scope.spawn(move || {
                for step in 0..500 {
                    let objects = [ball(recording, f64::from(1 + step / 100)), ball(recording, 1.0)];
                    recording.query(&query(objects, thread)).expect("recorded");
                }
            });
        }
    });
    // In the spool when the call has returned, without an end of the recording.
    let rows = rows(&folder);
    assert!(rows.iter().map(|row| row.0).eq(0..2000), "rows are not in the order of the calls");
    assert!((0..4).all(|thread| rows.iter().filter(|row| row.1 == thread).count() == 500));
    assert_eq!(text(&folder, "objects.jsonl").lines().count(), 5);
}

#[test]
fn there_is_a_most_of_objects() {
    let (folder, recording) = recording();
    for i in 0..20_000 {
        ball(&recording, f64::from(1 + i));
    }
    assert_eq!(refused(recording.object("ball", Shape::Sphere { radius: 0.5 })), Refusal::TooManyObjects);
    ball(&recording, 7.0);
    assert_eq!(text(&folder, "objects.jsonl").lines().count(), 20_000);
}

/// A row or a line that is there in part must not be followed by another.
#[test]
fn a_recording_ends_when_a_file_cannot_be_written() {
    let (folder, recording) = recording();
    let objects = [ball(&recording, 1.0); 2];
    recording.query(&query(objects, 0)).expect("recorded");
    fs::remove_dir(folder.path().join("spool/objects")).expect("it is empty");
    let mesh = Shape::Mesh { vertices: &CORNER, triangles: &FACES };
    match recording.object("corner", mesh) {
        Err(Error::File { path, .. }) => assert!(path.starts_with(folder.path().join("spool/objects")), "{path:?}"),
        other => panic!("{other:?}"),
    }
    assert!(matches!(recording.query(&query(objects, 1)), Err(Error::Ended)));
    assert!(matches!(recording.object("ball", Shape::Sphere { radius: 1.0 }), Err(Error::Ended)));
    assert!(matches!(recording.close(), Err(Error::Ended)));
    assert_eq!(rows(&folder), [(0, 0)]);
}

#[test]
fn texts_stay_one_line_of_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let spool = folder.path().join("spool");
    let recording = Recording::create(&spool, "a \"b\" \\ \n\u{7f}\u{85}", "l\t", "1").expect("a spool");
    recording.object("x\0\"", Shape::Sphere { radius: 1e-7 }).expect("a ball");
    let read = |name: &str| fs::read_to_string(Path::new(&spool).join(name)).expect("a text");
    assert!(read("about.json").contains(r#""program": "a \"b\" \\ ???""#), "{}", read("about.json"));
    let line = "{\"id\": 0, \"name\": \"x?\\\"\", \"geometry\": {\"kind\": \"sphere\", \"radius\": 1e-7}, \
                \"source\": \"\", \"library\": \"l?\", \"version\": \"1\"}\n";
    assert_eq!(read("objects.jsonl"), line);
}
