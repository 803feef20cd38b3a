use super::*;

/// Rows of a quarter turn about z.
const ABOUT_Z: [[f64; 3]; 3] = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[test]
fn each_primitive_is_kept_as_it_is() {
    let it = imported(
        r#"<robot name="r"><link name="a">
        <collision><geometry><box size="1 2 3"/></geometry></collision>
        <collision><origin xyz="1 2 3"/><geometry><sphere radius="0.5"/></geometry></collision>
        <collision><origin rpy="0 0 1.5707963267948966"/><geometry><cylinder radius="0.25" length="2"/></geometry></collision>
        <collision name="grip"><geometry><capsule radius="0.25" length="2e0"/></geometry></collision>
        <visual><geometry><sphere radius="9"/></geometry></visual></link></robot>"#,
    );
    let geometry = |name: &str| object(&it, name).geometry.clone();
    assert_eq!(geometry("a_0"), Geometry::Box { size: [1.0, 2.0, 3.0] });
    assert_eq!(geometry("a_1"), Geometry::Sphere { radius: 0.5 });
    assert_eq!(geometry("a_2"), Geometry::Cylinder { radius: 0.25, length: 2.0 });
    assert_eq!(geometry("a_3"), Geometry::Capsule { radius: 0.25, length: 2.0 });
    stands(&it, "a_1", UPRIGHT, [1.0, 2.0, 3.0]);
    stands(&it, "a_2", ABOUT_Z, [0.0; 3]);
    assert_eq!((it.links, it.file.scene.objects.len()), (1, 4));
    assert_eq!(disabled(&it).len(), 6);
    assert_eq!(disabled(&it)[0], ("a_0", "a_1", "same link"));
}

#[test]
fn meshes_are_scaled_and_a_mirror_keeps_their_front_outside() {
    let it = imported(
        r#"<robot name="r"><link name="a">
        <collision><geometry><mesh filename="t.obj"/></geometry></collision>
        <collision><geometry><mesh filename="t.obj" scale="10 10 10"/></geometry></collision>
        <collision><geometry><mesh filename="t.obj" scale="1 -1 1"/></geometry></collision>
        <collision><geometry><mesh filename="t.obj" scale="-1 -1 1"/></geometry></collision>
        <collision><geometry><mesh filename="t.obj" scale="1 -1 1"/></geometry></collision></link></robot>"#,
    );
    let corners = |name: &str| mesh(&it, name).corners(0).map(|p| [p.x, p.y, p.z]);
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    assert_eq!(corners("a_0"), [x, y, z]);
    assert_eq!(corners("a_1"), [[10.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 30.0]]);
    assert_eq!(corners("a_2"), [x, z, [0.0, -2.0, 0.0]]);
    assert_eq!(corners("a_3"), [[-1.0, 0.0, 0.0], [0.0, -2.0, 0.0], z]);
    assert_eq!(object(&it, "a_2").scale, [1.0, -1.0, 1.0]);
    assert_eq!(object(&it, "a_2").source, "t.obj");
    // Each scale is kept once.
    assert_eq!(object(&it, "a_2").geometry, object(&it, "a_4").geometry);
    assert_eq!(it.file.meshes.len(), 4);
}

/// base -turn about z at (1 0 0)-> arm -slide along y, turned by a roll-> hand
const CHAIN: &str = r#"<robot name="r">
    <link name="hand"><collision><origin xyz="0 0 1"/><geometry><sphere radius="1"/></geometry></collision></link>
    <link name="base"><collision><geometry><sphere radius="1"/></geometry></collision></link>
    <link name="arm"><collision><geometry><sphere radius="1"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="arm"/><child link="hand"/>
      <origin xyz="0 2 0" rpy="1.5707963267948966 0 0"/><axis xyz="0 3 0"/></joint>
    <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
      <origin xyz="1 0 0"/><axis xyz="0 0 2"/></joint></robot>"#;

#[test]
fn a_chain_of_joints_places_its_links() {
    let it = imported(CHAIN);
    let rolled = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    stands(&it, "arm_0", UPRIGHT, [1.0, 0.0, 0.0]);
    stands(&it, "hand_0", rolled, [1.0, 1.0, 0.0]);
    assert_eq!(disabled(&it), [("hand_0", "arm_0", "adjacent links"), ("base_0", "arm_0", "adjacent links")]);
}

#[test]
fn joints_move_to_the_values_that_are_given() {
    let folder = Folder::with(&[("a.urdf", CHAIN)]);
    let joints = vec![("turn".to_owned(), std::f64::consts::FRAC_PI_2), ("slide".to_owned(), 0.5)];
    let it = folder.import("a.urdf", &Wanted { joints, ..Wanted::default() });
    stands(&it, "arm_0", ABOUT_Z, [1.0, 0.0, 0.0]);
    // The slide goes along y of its own frame, which the roll turned to z; the arm turned the offset of 1 along -x.
    stands(&it, "hand_0", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0, 0.0, 0.5]);
    let why = |name: &str| {
        let joints = vec![(name.to_owned(), 1.0)];
        folder.refused("a.urdf", &Wanted { joints, ..Wanted::default() })
    };
    assert_eq!(why("knee"), "\"a.urdf\" cannot be imported: it has no joint \"knee\".");
}

#[test]
fn roll_pitch_and_yaw_turn_about_fixed_axes_in_this_order() {
    let it = imported(
        r#"<robot name="r"><link name="a"><collision><origin rpy="1.5707963267948966 0 1.5707963267948966"/>
        <geometry><sphere radius="1"/></geometry></collision></link></robot>"#,
    );
    stands(&it, "a_0", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0; 3]);
}

#[test]
fn a_joint_follows_another() {
    let ball = "<collision><geometry><sphere radius='1'/></geometry></collision>";
    let joint = |name: &str, mimic: &str| {
        format!(
            "<joint name='{name}' type='prismatic'><parent link='base'/><child link='{name}'/><axis xyz='1 0 0'/>{mimic}</joint>\
             <link name='{name}'>{ball}</link>"
        )
    };
    let robot = |first: &str, second: &str| {
        format!(
            "<robot name='r'><link name='base'/>{}{}{}</robot>",
            joint("c", second),
            joint("b", first),
            joint("a", "")
        )
    };
    let text = robot("<mimic joint='a' multiplier='-2' offset='0.25'/>", "<mimic joint='b'/>");
    let folder = Folder::with(&[("a.urdf", &text)]);
    let it = folder.import("a.urdf", &Wanted { joints: vec![("a".into(), 1.0)], ..Wanted::default() });
    for (name, x) in [("a_0", 1.0), ("b_0", -1.75), ("c_0", -1.75)] {
        stands(&it, name, UPRIGHT, [x, 0.0, 0.0]);
    }
    let why = refused(&robot("<mimic joint='c'/>", "<mimic joint='b'/>"));
    assert!(why.contains("follows itself"), "{why}");
    let it = imported(&robot("<mimic joint='nobody' offset='1'/>", ""));
    stands(&it, "b_0", UPRIGHT, [0.0; 3]);
    assert_eq!(it.notes, ["The joint \"b\" follows \"nobody\", which is not there."]);
}

#[test]
fn srdf_disables_pairs_with_its_reasons() {
    let srdf = r#"<robot name="r"><disable_collisions link1="base" link2="hand" reason="Never"/>
        <disable_collisions link1="base" link2="arm" reason="Adjacent"/>
        <disable_collisions link1="base" link2="tool" reason="Never"/></robot>"#;
    let folder = Folder::with(&[("a.urdf", CHAIN), ("a.srdf", srdf)]);
    let it = folder.import("a.urdf", &Wanted { srdf: Some(folder.path("a.srdf")), ..Wanted::default() });
    let expected =
        [("hand_0", "base_0", "Never"), ("hand_0", "arm_0", "adjacent links"), ("base_0", "arm_0", "Adjacent")];
    assert_eq!(disabled(&it), expected);
    assert_eq!(it.notes, ["The SRDF file names 1 link(s) that the robot does not have, such as \"tool\"."]);
}

#[test]
fn srdf_disables_all_pairs_of_a_link_but_some() {
    let srdf = r#"<robot name="r"><disable_default_collisions link="hand"/>
        <enable_collisions link1="base" link2="hand"/></robot>"#;
    let folder = Folder::with(&[("a.urdf", CHAIN), ("a.srdf", srdf)]);
    let it = folder.import("a.urdf", &Wanted { srdf: Some(folder.path("a.srdf")), ..Wanted::default() });
    let expected = [("hand_0", "arm_0", "disabled by default"), ("base_0", "arm_0", "adjacent links")];
    assert_eq!(disabled(&it), expected);
}

#[test]
fn packages_are_found_above_the_file_and_where_they_are_given() {
    let robot = |address: &str| {
        format!(
            "<robot name='r'><link name='a'><collision><geometry><mesh filename='{address}'/></geometry></collision></link></robot>"
        )
    };
    let manifest = "<package><name>ur</name><license>BSD-3-Clause</license><license> MIT </license></package>";
    let files = |address: &str| {
        Folder::with(&[
            ("ur/urdf/a.urdf", &robot(address)),
            ("ur/package.xml", manifest),
            ("ur/meshes/t.obj", TRIANGLE),
            ("other/t.obj", TRIANGLE),
        ])
    };
    for (address, licence) in [
        ("package://ur/meshes/t.obj", Some("BSD-3-Clause, MIT")),
        ("package:///ur/meshes/t.obj", Some("BSD-3-Clause, MIT")),
        ("../meshes/t.obj", Some("BSD-3-Clause, MIT")),
        ("package://other/t.obj", None),
    ] {
        let it = files(address).import("ur/urdf/a.urdf", &Wanted::default());
        assert_eq!(object(&it, "a_0").licence.as_deref(), licence, "{address}");
        assert_eq!(object(&it, "a_0").source, address);
    }
    let folder = files("package://elsewhere/t.obj");
    let why = folder.refused("ur/urdf/a.urdf", &Wanted::default());
    assert!(why.contains("link \"a\": \"package://elsewhere/t.obj\" names a package that is not found"), "{why}");
    folder.import("ur/urdf/a.urdf", &package("elsewhere", &folder.path("other")));
}

#[test]
fn the_unit_of_collada_is_applied_and_its_up_axis_is_not() {
    let dae = r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
        <asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
        <library_geometries><geometry id="g"><mesh>
          <source id="p"><float_array id="n" count="9">100 0 0 0 200 0 0 0 300</float_array><technique_common>
            <accessor source="#n" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
            <param name="Z" type="float"/></accessor></technique_common></source>
          <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
          <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
        </mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#s"/></scene></COLLADA>"##;
    let robot = "<robot name='r'><link name='a'><collision><geometry><mesh filename='t.dae'/></geometry></collision></link></robot>";
    let it = Folder::with(&[("a.urdf", robot), ("t.dae", dae)]).import("a.urdf", &Wanted::default());
    assert_eq!(
        mesh(&it, "a_0").corners(0).map(|p| [p.x, p.y, p.z]),
        [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]]
    );
    assert_eq!(it.notes, ["\"t.dae\" is in \"centimeter\" and was converted to metres."]);
}
