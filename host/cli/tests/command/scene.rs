//! `ocb scene`: robots as scenes, without a store.

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
