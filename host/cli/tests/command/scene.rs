//! `ocb scene`: robots as scenes, without a store, and heatmaps of the objects of a replay.

use ocb_service::Recording;
use serde_json::json;

use crate::support::Desk;

const ROBOT: &str = r#"<robot name="arm"><link name="base"><collision><geometry><mesh filename="t.obj" scale="1 1 -2"/></geometry></collision></link>
    <link name="hand"><collision><geometry><box size="1 2 3"/></geometry></collision></link>
    <joint name="turn" type="revolute"><parent link="base"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint></robot>"#;
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn a_robot_is_imported_and_shown() {
    let desk = Desk::new();
    desk.file("t.obj", TETRAHEDRON);
    let robot = desk.file("arm.urdf", ROBOT);
    let scene = desk.path("arm.ocbscene").display().to_string();
    let said = desk.run(&["scene", "import", &robot, "--joint", "turn=3.5", "--out", &scene]);
    assert_eq!(said.code, 0, "{said:?}");
    let expected = "arm: 2 objects of 2 links (1 box, 1 mesh), 4 triangles; 1 of 1 pairs are disabled.\n";
    assert_eq!(said.stdout, expected);
    let shown = desk.run(&["scene", "show", &scene]);
    assert_eq!(shown.code, 0, "{shown:?}");
    for words in
        ["base_0", "4 triangles, scaled by 1 1 -2", "t.obj", "hand_0", "1 x 2 x 3", "1 of 1 pairs are disabled."]
    {
        assert!(shown.stdout.contains(words), "{words}: {}", shown.stdout);
    }
    let json = desk.json(&["scene", "show", &scene]);
    assert_eq!((&json["rows"][0]["triangles"], &json["kinds"]["box"]), (&4.into(), &1.into()));
    let turned = json["rows"][1]["pose"][0].as_f64().expect("a number");
    assert!((turned - 3.5f64.cos()).abs() < 1e-12, "{turned}");
    assert!(!desk.path("data").exists(), "nothing is kept");

    // A recording of poses takes over its objects, where they stand, and its disabled pairs.
    let written = json!({
        "scene": "arm.ocbscene", "objects": [{ "name": "ball", "geometry": { "kind": "sphere", "radius": 0.5 } }],
        "queries": [
            { "objects": ["ball", "hand_0"], "query": "distance", "pose_a": [1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 1, 0] },
            { "objects": ["hand_0", "base_0"], "query": "collide" },
        ],
    });
    let poses = desk.file("poses.json", written.to_string());
    let recording = desk.path("arm.ocbrec").display().to_string();
    let said = desk.run(&["record", "--poses", &poses, "--out", &recording]);
    assert_eq!(said.code, 0, "{said:?}");
    let json = desk.json(&["scene", "show", &recording]);
    let names: Vec<_> = (0..3).map(|row| json["rows"][row]["name"].as_str().expect("a name")).collect();
    assert_eq!((&names[..], &json["disabled_pairs"]), (&["base_0", "hand_0", "ball"][..], &1.into()), "{json}");
    let read = Recording::read(&desk.path("arm.ocbrec")).expect("a recording");
    let poses = |query: usize| read.queries[query].configuration;
    let [ball, hand] = [poses(0).pose_a.translation.x, poses(0).pose_b.linear[(0, 0)]];
    assert_eq!((ball, hand, poses(1).pose_a), (4.0, turned, poses(0).pose_b));
}

#[test]
fn what_cannot_be_imported_is_said_in_one_sentence() {
    let desk = Desk::new();
    let robot = desk.file("arm.urdf", ROBOT);
    let scene = desk.path("arm.ocbscene").display().to_string();
    let why = |more: &[&str]| {
        let ended = desk.run(&[&["scene", "import", &robot, "--out", &scene][..], more].concat());
        assert_eq!((ended.code, desk.path("arm.ocbscene").exists()), (2, false), "{ended:?}");
        ended.stderr
    };
    assert_eq!(why(&[]), "ocb: \"arm.urdf\" cannot be imported: link \"base\": the file \"t.obj\" does not exist.\n");
    assert!(why(&["--joint", "turn=x"]).contains("the value is not a finite number"));
    assert!(why(&["--package", "arm"]).contains("a name, = and a value are needed"));
    assert!(why(&["--joint", "knee=1"]).contains("it has no joint \"knee\""));
}

#[test]
fn a_heatmap_of_an_object_colours_the_face_that_was_near() {
    let desk = Desk::with(&["libocb_box_tree.so"]);
    // A ball before the face of the table at x = 0.5, in front of both of its triangles.
    let pose = |[x, y, z]: [f64; 3]| json!([1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z]);
    let places = [[0.7, 0.3, 0.1], [0.7, -0.3, -0.1], [0.7, 0.1, 0.3], [0.7, -0.1, -0.3]];
    let query = |place| json!({ "objects": ["table", "ball"], "query": "distance", "pose_b": pose(place) });
    let written = json!({
        "objects": [
            { "name": "table", "geometry": { "kind": "box", "size": [1, 1, 1] } },
            { "name": "ball", "geometry": { "kind": "sphere", "radius": 0.1 } },
        ],
        "queries": places.map(query),
    });
    let poses = desk.file("poses.json", written.to_string());
    let [recording, out] = ["tip.ocbrec", "out"].map(|name| desk.path(name).display().to_string());
    assert_eq!(desk.run(&["record", "--poses", &poses, "--out", &recording]).code, 0);
    let replay = ["bench", "--workload", &recording, "--algorithm", "box-tree", "--passes", "1", "--out", &out];
    assert_eq!(desk.run(&replay).code, 0);

    let queries = desk.path("out/queries.parquet").display().to_string();
    let map = |object: &str, more: &[&str]| {
        let to = ["scene", "heatmap", &recording, &queries, "--object", object, "--algorithm", "box-tree"];
        desk.run(&[&to[..], more].concat())
    };
    let csv = desk.path("map.csv").display().to_string();
    let ended = map("table", &["--measure", "queries", "--order", "recorded", "-o", &csv]);
    assert_eq!((ended.code, ended.stdout), (0, format!("{csv} (4 queries about table)\n")), "{}", ended.stderr);
    let written = std::fs::read_to_string(&csv).expect("a file");
    let lines: Vec<&str> = written.lines().collect();
    assert_eq!((lines[0], lines.len()), ("vertex,value_queries,count", 9));
    assert_eq!(lines.iter().filter(|line| line.ends_with(",,0")).count(), 4, "{written}");
    let ply = desk.path("map.ply").display().to_string();
    assert_eq!(map("table", &["--to", "3", "-o", &ply]).code, 0);
    let head = String::from_utf8_lossy(&std::fs::read(&ply).expect("a file")).into_owned();
    for words in ["run: tip.ocbrec, object 0, order shuffled", "configurations: 3", "sequence in [0, 3)", "unit: ns"] {
        assert!(head.contains(words), "{words}");
    }
    let told = |ended: crate::support::Ended| (ended.code, ended.stderr);
    let (code, why) = told(map("chair", &["-o", &csv]));
    assert!(code == 2 && why.contains("no object \"chair\""), "{why}");
    let (code, why) = told(map("table", &["-o", &poses]));
    assert!(code == 2 && why.contains("must end in .glb, .ply or .csv"), "{why}");
}
