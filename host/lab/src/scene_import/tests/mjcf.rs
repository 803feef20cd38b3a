use super::*;

const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Rows of a quarter turn about x, and about z.
const ABOUT_X: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
const ABOUT_Z: [[f64; 3]; 3] = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

/// A model with these elements in it.
fn model(inside: &str) -> Folder {
    let text = format!("<mujoco model='m'>\n{inside}</mujoco>");
    Folder::with(&[("a.xml", &text), ("meshes/t.obj", TRIANGLE)])
}

fn world(inside: &str) -> Imported {
    model(&format!("<worldbody>{inside}</worldbody>")).import("a.xml", &Wanted::default())
}

#[test]
fn sizes_are_halves_and_two_points_place_a_geom() {
    let it = world(
        "<geom name='ball' size='2'/><geom name='box' type='box' size='1 2 3'/>
         <geom name='rod' type='cylinder' size='0.5 2' pos='1 2 3'/>
         <geom name='arm' type='capsule' size='0.5' fromto='1 0 0 1 0 4'/>
         <geom name='up' type='capsule' size='0.5' fromto='0 0 0 0 4 0'/>
         <geom name='round' type='ellipsoid' size='3 3 3'/><geom name='egg' type='ellipsoid' size='1 2 3'/>",
    );
    let geometry = |name: &str| object(&it, name).geometry.clone();
    assert_eq!(geometry("ball"), Geometry::Sphere { radius: 2.0 });
    assert_eq!(geometry("box"), Geometry::Box { size: [2.0, 4.0, 6.0] });
    assert_eq!(geometry("rod"), Geometry::Cylinder { radius: 0.5, length: 4.0 });
    assert_eq!(geometry("arm"), Geometry::Capsule { radius: 0.5, length: 4.0 });
    assert_eq!(geometry("round"), Geometry::Sphere { radius: 3.0 });
    let sides = mesh(&it, "egg").bounds().sides();
    assert!((sides - Vector3::new(2.0, 4.0, 6.0)).amax() < 0.03, "{sides}");
    stands(&it, "rod", UPRIGHT, [1.0, 2.0, 3.0]);
    // The z axis goes from the second point to the first.
    stands(&it, "arm", [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]], [1.0, 0.0, 2.0]);
    stands(&it, "up", [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]], [0.0, 2.0, 0.0]);
}

#[test]
fn each_form_of_an_orientation_turns_alike() {
    let it = world(
        "<geom name='a' size='1' quat='2 2 0 0'/><geom name='b' size='1' axisangle='3 0 0 90'/>
         <geom name='c' size='1' euler='90 0 0'/><geom name='d' size='1' xyaxes='2 0 0 1 0 1'/>
         <geom name='e' size='1' zaxis='0 -1 0'/>",
    );
    ["a", "b", "c", "d", "e"].iter().for_each(|name| stands(&it, name, ABOUT_X, [0.0; 3]));
    let sequence = |sequence: &str| {
        let text = format!(
            "<compiler angle='radian' eulerseq='{sequence}'/><worldbody>
             <geom name='a' size='1' euler='1.5707963267948966 1.5707963267948966 0'/></worldbody>"
        );
        model(&text).import("a.xml", &Wanted::default())
    };
    // About x and then about the turned z, or about the fixed one.
    stands(&sequence("xzy"), "a", [[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]], [0.0; 3]);
    stands(&sequence("XZY"), "a", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0; 3]);
}

#[test]
fn defaults_are_taken_by_class_and_from_the_bodies_around() {
    let it = model(
        "<compiler meshdir='meshes'/>
         <asset><mesh file='t.obj' class='big'/></asset>
         <default><geom type='box' size='1 1 1'/>
           <default class='big'><geom size='2 2 2' euler='90 0 0'/><mesh scale='2 2 2'/>
             <default class='tall'><geom size='2 2 9'/></default></default></default>
         <worldbody><geom name='a'/><body name='x' childclass='big'><geom name='b'/><geom name='c' class='tall'/>
           <geom name='d' quat='1 0 0 0'/><body name='y'><geom type='mesh' mesh='t'/></body></body></worldbody>",
    )
    .import("a.xml", &Wanted::default());
    let size = |name: &str| match object(&it, name).geometry {
        Geometry::Box { size } => size,
        ref other => panic!("{other:?}"),
    };
    assert_eq!([size("a"), size("b"), size("c")], [[2.0; 3], [4.0; 3], [4.0, 4.0, 18.0]]);
    stands(&it, "c", ABOUT_X, [0.0; 3]);
    stands(&it, "d", UPRIGHT, [0.0; 3]);
    stands(&it, "y_0", ABOUT_X, [0.0; 3]);
    assert_eq!(mesh(&it, "y_0").corners(0)[2].z, 6.0);
    assert_eq!(it.notes, ["MuJoCo collides the convex hulls of meshes; the meshes are imported as they are."]);
}

#[test]
fn bodies_frames_and_joints_place_geoms() {
    let text = "<worldbody><body pos='1 0 0'><joint name='turn' pos='0 1 0' ref='90'/><joint type='slide' name='slide' axis='1 0 0'/>
        <geom name='a' size='1'/><frame pos='0 0 1' euler='0 0 90'><geom name='b' size='1' pos='1 0 0'/>
        <body pos='2 0 0'><geom name='c' size='1'/></body></frame></body></worldbody>";
    let it = model(text).import("a.xml", &Wanted::default());
    stands(&it, "a", UPRIGHT, [1.0, 0.0, 0.0]);
    stands(&it, "b", ABOUT_Z, [1.0, 1.0, 1.0]);
    stands(&it, "c", ABOUT_Z, [1.0, 2.0, 1.0]);
    let joints = vec![("turn".to_owned(), std::f64::consts::PI), ("slide".to_owned(), 3.0)];
    let it = model(text).import("a.xml", &Wanted { joints, ..Wanted::default() });
    // A quarter turn beyond the reference about (1 1 0), then along the turned x.
    stands(&it, "a", ABOUT_Z, [2.0, 4.0, 0.0]);
    let why = model(text).refused("a.xml", &Wanted { joints: vec![("knee".into(), 1.0)], ..Wanted::default() });
    assert!(why.contains("no turning or sliding joint \"knee\""), "{why}");
}

#[test]
fn pairs_are_disabled_as_mujoco_filters_them() {
    let text = "<contact><exclude body1='p' body2='r'/><pair geom1='s' geom2='mute'/></contact>
        <worldbody><geom name='floor' type='plane' size='1 1 1'/><geom name='post' size='1'/>
          <geom name='shown' contype='0' conaffinity='0' size='1'/>
          <body name='p'><joint/><geom name='p' size='1'/>
            <body name='fixed'><geom name='f' size='1'/><geom name='mute' contype='0' conaffinity='0' size='1'/>
              <body name='q'><joint/><geom name='q' size='1'/>
                <body name='r'><joint/><geom name='r' size='1'/></body></body></body></body>
          <body name='s'><freejoint/><geom name='s' contype='2' conaffinity='4' size='1'/></body></worldbody>";
    let it = model(text).import("a.xml", &Wanted::default());
    let expected = [
        ("post", "mute", "contype and conaffinity"),
        ("post", "s", "contype and conaffinity"),
        ("p", "f", "rigidly joined"),
        ("p", "mute", "rigidly joined"),
        ("p", "q", "adjacent links"),
        ("p", "r", "excluded in <contact>"),
        ("p", "s", "contype and conaffinity"),
        ("f", "mute", "same link"),
        ("f", "q", "adjacent links"),
        ("f", "s", "contype and conaffinity"),
        ("mute", "q", "adjacent links"),
        ("mute", "r", "contype and conaffinity"),
        ("q", "r", "adjacent links"),
        ("q", "s", "contype and conaffinity"),
        ("r", "s", "contype and conaffinity"),
    ];
    assert_eq!(disabled(&it), expected);
    assert_eq!(it.notes, ["1 geom(s) of the type plane were left out."]);
}

#[test]
fn files_are_included_once() {
    let arm = "<mujoco><worldbody><geom name='arm' size='1'/></worldbody></mujoco>";
    let folder = |files: &[(&str, &str)]| Folder::with(files).refused("a.xml", &Wanted::default());
    let two = "<mujoco><include file='b.xml'/><include file='b.xml'/></mujoco>";
    let it = Folder::with(&[("a.xml", "<mujoco><include file='b.xml'/></mujoco>"), ("b.xml", arm)]);
    stands(&it.import("a.xml", &Wanted::default()), "arm", UPRIGHT, [0.0; 3]);
    let why = folder(&[("a.xml", two), ("b.xml", arm)]);
    assert!(why.contains("line 1: \"b.xml\" is included twice"), "{why}");
    let itself = "<mujoco>\n<include file='b.xml'/></mujoco>";
    let why = folder(&[("a.xml", itself), ("b.xml", itself)]);
    assert!(why.contains("line 2 of \"b.xml\": \"b.xml\" is included twice"), "{why}");
    let why = folder(&[("a.xml", "<mujoco><include file='../b.xml'/></mujoco>")]);
    assert!(why.contains("does not exist"), "{why}");
}

#[test]
fn what_is_not_read_is_refused_with_its_line() {
    let why = |inside: &str| model(inside).refused("a.xml", &Wanted::default());
    let world = |inside: &str| why(&format!("<worldbody>{inside}</worldbody>"));
    assert!(why("<compiler coordinate='global'/>").contains("line 2: global coordinates are not read"));
    assert!(why("<compiler eulerseq='xy'/>").contains("eulerseq needs three of the letters"));
    assert!(world("<geom class='none' size='1'/>").contains("line 2: the class \"none\" is not there"));
    assert!(world("<geom type='capsule' size='1'/>").contains("size needs 2 number(s) for a capsule"));
    assert!(world("<geom type='mesh' mesh='m'/>").contains("no mesh \"m\" with a file"));
    assert!(world("<geom type='blob' size='1'/>").contains("geoms of the type \"blob\" are not read"));
    assert!(world("<geom size='1' quat='0 0 0 0'/>").contains("quat is 0 0 0 0"));
    assert!(world("<geom size='1' contype='x'/>").contains("contype is \"x\", and not a whole number"));
    assert!(world("<composite/>").contains("<composite> is not read; save the compiled model with mj_saveLastXML"));
    assert!(world("<body name='a'/><body name='a'/>").contains("two bodies are named \"a\""));
    assert!(why("").contains("it has no collision geometry"));
}
