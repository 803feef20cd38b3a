//! A small cube points with a corner at one face of a large one: only that face has values, and each vertex those of its triangles.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Rotation3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::pose::Pose;
use ocb_core::record::Verdict;
use ocb_core::scene::{Geometry, Scene, SceneObject};
use ocb_core::workload::{Answered, Kind, Recorded};

use super::super::recorded::Truths;
use super::super::{Certified, WorkloadRow, mesh_of, parts, solids, workload_parquet};
use super::*;
use crate::measure::Stop;
use crate::model::Track;
use crate::recording::{About, Recording};
use crate::scene_file::SceneFile;

/// The places before the face, off the diagonals of both of its triangulations.
const PLACES: [[f64; 2]; 6] = [[0.3, 0.1], [-0.1, 0.3], [-0.3, 0.1], [0.1, -0.3], [0.35, -0.2], [-0.2, -0.05]];
/// Number of the first query.
const FIRST: u64 = 7;

fn cube(name: &str, side: f64) -> SceneObject {
    SceneObject {
        name: name.to_owned(),
        link: None,
        geometry: Geometry::Box { size: [side; 3] },
        pose: Pose::identity(),
        source: String::new(),
        scale: [1.0; 3],
        licence: None,
    }
}

/// Every second query names the small cube first. The third cube is asked about the small one only.
fn recording() -> Recording {
    let objects = vec![cube("table", 1.0), cube("tip", 0.1), cube("far", 1.0)];
    let scene = Scene { name: "tip".into(), objects, disabled: Vec::new() };
    // Turns the diagonal (1, 1, 1) to the first axis.
    let turn = Rotation3::rotation_between(&Vector3::new(1.0, 1.0, 1.0), &Vector3::x()).expect("a turn");
    let tip = |[y, z]: [f64; 2]| Pose { linear: *turn.matrix(), translation: Vector3::new(0.7, y, z) };
    let query = |(sequence, (objects, pose_a, pose_b))| Recorded {
        sequence,
        group: sequence,
        objects,
        configuration: Configuration { pose_a, pose_b },
        kind: Kind::Collide,
        limit: 0.0,
        answered: Answered::default(),
        seconds: None,
        library: 0,
    };
    let still = Pose::identity();
    let before = |place: usize| match place % 2 {
        0 => ([0, 1], still, tip(PLACES[place])),
        _ => ([1, 0], tip(PLACES[place]), still),
    };
    let behind = ([1, 2], tip([0.0, 0.0]), Pose { translation: Vector3::new(2.0, 0.02, 0.03), ..still });
    let asked = (0..PLACES.len()).map(before).chain([behind]);
    Recording {
        scene: SceneFile { scene, meshes: HashMap::new() },
        about: About::default(),
        queries: (FIRST..).zip(asked).map(query).collect(),
    }
}

/// Query i takes 100 + i nanoseconds; every third answer is wrong, and the last one before the face is none.
fn planted(place: usize) -> (f64, Verdict) {
    let verdict = match place {
        5 => Verdict::GaveUp,
        place if place % 3 == 0 => Verdict::FalseNegative,
        _ => Verdict::Correct,
    };
    (100.0 + place as f64, verdict)
}

/// The table of a replay whose times and verdicts are planted; where the objects are closest, the oracle says.
fn table(recording: &Recording, kept: bool) -> Vec<u8> {
    let solids = solids(&recording.scene).expect("solids");
    let mut truths = Truths::new(recording);
    for part in parts(&recording.queries).0 {
        let certified = Certified::of(&part, &solids, &Stop::default()).expect("no stop").expect("near objects");
        truths.judge(&certified, part.objects, &solids);
    }
    let row = |place: usize| WorkloadRow {
        algorithm: Arc::from("planted"),
        track: Track::Recorded,
        row: place as u32,
        time_ns: planted(place).0,
        verdict: planted(place).1,
        hit: truths.hits[place].expect("replayed"),
        triangles: truths.triangles[place].filter(|_| kept),
    };
    let rows: Vec<WorkloadRow> = (0..recording.queries.len()).map(row).collect();
    workload_parquet(&rows, &recording.queries).expect("a table")
}

fn asked(measure: ObjectMeasure) -> ObjectHeatmapRequest {
    ObjectHeatmapRequest { algorithm: "planted".into(), order: Track::Recorded, measure, from: None, to: None }
}

/// The places before a triangle of the face at x = 0.5, found in the plane.
fn before(mesh: &Mesh, vertex: usize) -> Vec<usize> {
    let around = |triangle: &&[u32; 3]| triangle.iter().any(|corner| *corner as usize == vertex);
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| mesh.positions()[corner as usize]);
    let inside = |triangle: &[u32; 3], [y, z]: [f64; 2]| {
        let [a, b, c] = corners(triangle);
        let left =
            |p: &nalgebra::Point3<f64>, q: &nalgebra::Point3<f64>| (q.y - p.y) * (z - p.z) > (q.z - p.z) * (y - p.y);
        let sides = [left(&a, &b), left(&b, &c), left(&c, &a)];
        corners(triangle).iter().all(|corner| corner.x > 0.49) && (sides == [true; 3] || sides == [false; 3])
    };
    let touched =
        |place: &usize| mesh.triangles().iter().filter(around).any(|triangle| inside(triangle, PLACES[*place]));
    (0..PLACES.len()).filter(touched).collect()
}

#[test]
fn only_the_face_that_is_near_has_values_and_each_vertex_those_of_its_triangles() {
    let recording = recording();
    let (table, mesh) = (table(&recording, true), mesh_of(&recording, 0).expect("a mesh"));
    let of = |request| object_heatmap(&table, &mesh, 0, &request).expect("a heatmap");
    let [time, wrong, queries] = [ObjectMeasure::Time, ObjectMeasure::Wrong, ObjectMeasure::Queries].map(asked).map(of);
    assert_eq!((time.n, wrong.n, queries.n), (6, 5, 6), "the one about the third cube does not count");
    assert_eq!((time.unit.as_str(), wrong.unit.as_str(), queries.unit.as_str()), ("ns", "share", "queries"));
    let mut touched = 0;
    for (vertex, position) in mesh.positions().iter().enumerate() {
        let places = before(&mesh, vertex);
        assert_eq!(places.is_empty(), position.x < 0.0, "vertex {vertex} at {position}");
        let mean = |values: Vec<f64>| {
            let n = values.len() as f64;
            (!values.is_empty()).then(|| values.into_iter().sum::<f64>() / n)
        };
        let judged: Vec<usize> = places.iter().copied().filter(|place| *place != 5).collect();
        let share = |place: &usize| f64::from(u8::from(planted(*place).1.is_wrong()));
        assert_eq!(time.counts[vertex] as usize, places.len());
        assert_eq!(time.values[vertex], mean(places.iter().map(|place| planted(*place).0).collect()));
        assert_eq!(wrong.counts[vertex] as usize, judged.len());
        assert_eq!(wrong.values[vertex], mean(judged.iter().map(share).collect()));
        assert_eq!(queries.values[vertex], (!places.is_empty()).then_some(places.len() as f64));
        touched += usize::from(!places.is_empty());
    }
    assert_eq!(touched, 4);
    // The two triangles of the face differ, so a mix-up would show.
    assert!(time.range.is_some_and(|[lo, hi]| lo < hi), "{:?}", time.range);
}

#[test]
fn a_stretch_and_the_other_object_are_kept_apart() {
    let recording = recording();
    let table = table(&recording, true);
    let of = |object: u32, request: &ObjectHeatmapRequest| {
        object_heatmap(&table, &mesh_of(&recording, object as usize).expect("a mesh"), object, request)
            .expect("a heatmap")
    };
    let first = ObjectHeatmapRequest { from: Some(FIRST + 1), to: Some(FIRST + 3), ..asked(ObjectMeasure::Time) };
    let part = of(0, &first);
    assert_eq!((part.n, part.range), (2, Some([101.5; 2])));
    // The corner of the tip that points at the table is in all triangles that are closest to it.
    let tip = of(1, &asked(ObjectMeasure::Queries));
    let corner = mesh_of(&recording, 1).expect("a mesh").positions().iter().position(|p| p.iter().all(|x| *x < 0.0));
    assert_eq!((tip.n, tip.values[corner.expect("a corner")]), (7, Some(6.0)));
    assert_eq!(of(2, &asked(ObjectMeasure::Queries)).n, 1);
    let none = of(2, &first);
    assert_eq!((none.n, none.range, none.counts), (0, None, vec![0; 8]));
}

#[test]
fn files_say_what_they_show() {
    let recording = recording();
    let (table, mesh) = (table(&recording, true), mesh_of(&recording, 0).expect("a mesh"));
    let request = ObjectHeatmapRequest { to: Some(FIRST + 6), ..asked(ObjectMeasure::Wrong) };
    let heatmap = object_heatmap(&table, &mesh, 0, &request).expect("a heatmap");
    let colours = (Colormap::Turbo, Scale::Linear);
    let file =
        HeatmapFile { heatmap: &heatmap, mesh: &mesh, recording: "tip.ocbrec", colormap: colours.0, scale: colours.1 };
    let ply = file.bytes(HeatmapFormat::Ply);
    let head = String::from_utf8_lossy(&ply);
    for line in [
        "comment run: tip.ocbrec, object 0, order recorded",
        "comment algorithm: planted",
        "comment where: sequence in [0, 13)",
        "comment measure: wrong",
        "comment unit: share",
        "comment configurations: 5",
    ] {
        assert!(head.contains(line), "{line} in {}", &head[..800]);
    }
    assert!(file.bytes(HeatmapFormat::Glb).starts_with(b"glTF"));
    let csv = String::from_utf8(file.bytes(HeatmapFormat::Csv)).expect("text");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!((lines[0], lines.len()), ("vertex,value_share,count", 9));
    let empty = heatmap.values.iter().position(Option::is_none).expect("a vertex without a value");
    assert_eq!(lines[1 + empty], format!("{empty},,0"));
}

#[test]
fn what_cannot_be_shown_is_said() {
    let recording = recording();
    let mesh = mesh_of(&recording, 0).expect("a mesh");
    let told = |table: &[u8], request: &ObjectHeatmapRequest| {
        object_heatmap(table, &mesh, 0, request).expect_err("no heatmap").to_string()
    };
    let (new, old) = (table(&recording, true), table(&recording, false));
    let request = asked(ObjectMeasure::Time);
    assert!(told(&old, &request).contains("replay the recording again"), "{}", told(&old, &request));
    let other = ObjectHeatmapRequest { algorithm: "other".into(), ..request.clone() };
    assert!(told(&new, &other).contains("those that did: planted"), "{}", told(&new, &other));
    let shuffled = ObjectHeatmapRequest { order: Track::Shuffled, ..request.clone() };
    assert!(told(&new, &shuffled).contains("those that did: none"), "{}", told(&new, &shuffled));
    assert!(told(b"PAR1", &request).contains("no table of the queries of a replay"));
    let few = Mesh::new(mesh.positions().to_vec(), mesh.triangles()[..1].to_vec()).expect("a mesh");
    let bad = object_heatmap(&new, &few, 0, &request).expect_err("another object").to_string();
    assert!(bad.contains("another recording") && bad.contains("only 1 triangles"), "{bad}");
}
