use super::*;

const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const ABOUT_Z: [[f64; 3]; 3] = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
const BALL: &str = "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>";

fn folder(inside: &str) -> Folder {
    Folder::with(&[("a.sdf", &format!("<sdf version='1.9'>\n{inside}</sdf>")), ("t.obj", TRIANGLE)])
}

fn world(inside: &str) -> Imported {
    folder(inside).import("a.sdf", &Wanted::default())
}

#[test]
fn each_shape_is_kept() {
    let geometry = |inside: &str| {
        let it = world(&format!(
            "<model name='m'><link name='a'><collision name='c'><geometry>{inside}</geometry></collision></link></model>"
        ));
        object(&it, "a_0").geometry.clone()
    };
    assert_eq!(geometry("<box><size>1 2 3</size></box>"), Geometry::Box { size: [1.0, 2.0, 3.0] });
    assert_eq!(geometry("<sphere><radius> 2 </radius></sphere>"), Geometry::Sphere { radius: 2.0 });
    let [cylinder, capsule] =
        ["cylinder", "capsule"].map(|it| geometry(&format!("<{it}><radius>1</radius><length>4</length></{it}>")));
    assert_eq!(cylinder, Geometry::Cylinder { radius: 1.0, length: 4.0 });
    assert_eq!(capsule, Geometry::Capsule { radius: 1.0, length: 4.0 });
    assert_eq!(geometry("<ellipsoid><radii>2 2 2</radii></ellipsoid>"), Geometry::Sphere { radius: 2.0 });
    let mesh = geometry("<mesh><uri>t.obj</uri><scale>2 2 2</scale></mesh>");
    assert!(matches!(mesh, Geometry::Mesh { .. }));
}

#[test]
fn links_stand_in_their_models_and_on_each_other() {
    let it = world(&format!(
        "<world name='w'><model name='m'><pose>1 0 0 0 0 1.5707963267948966</pose>
           <link name='a'><pose degrees='true'>0 1 0 0 0 90</pose>{BALL}</link>
           <link name='b'><pose relative_to='a' rotation_format='quat_xyzw'>1 0 0 0 0 0 1</pose>
             <collision name='c'><pose>0 0 5 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry></collision></link>
           <joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>
           <joint name='k' type='fixed'><parent>world</parent><child>a</child></joint></model>
         <model name='n'><link name='a'>{BALL}<collision name='d'><geometry><plane/></geometry></collision></link></model></world>"
    ));
    let half = [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
    stands(&it, "m::a_0", half, [0.0, 0.0, 0.0]);
    stands(&it, "m::b_0", half, [-1.0, 0.0, 5.0]);
    stands(&it, "n::a_0", UPRIGHT, [0.0; 3]);
    assert_eq!(disabled(&it), [("m::a_0", "m::b_0", "adjacent links")]);
    assert_eq!((it.file.scene.name.as_str(), it.links), ("w", 3));
    assert_eq!(it.notes, ["1 collision geometries of the kind plane were left out."]);
    let it = world(&format!(
        "<model name='m'><link name='a'><pose>0 0 0 0 0 1.5707963267948966</pose>{BALL}</link></model>"
    ));
    stands(&it, "a_0", ABOUT_Z, [0.0; 3]);
}

#[test]
fn what_is_not_simple_is_refused_with_its_line() {
    let why = |inside: &str| folder(inside).refused("a.sdf", &Wanted::default());
    let link = |inside: &str| why(&format!("<model name='m'><link name='a'>{inside}{BALL}</link></model>"));
    assert!(why("<include><uri>model://x</uri></include>").contains("line 2: <include> is not read"));
    assert!(why("<model name='m'><model name='n'/></model>").contains("a model in a model is not read"));
    assert!(
        link("<pose relative_to='j'>0 0 0 0 0 0</pose>").contains("relative to \"j\", which is no link, is not read")
    );
    assert!(link("<pose relative_to='a'>0 0 0 0 0 0</pose>").contains("its pose is relative to itself"));
    assert!(link("<pose>0 0 0</pose>").contains("pose needs 6 number(s) and has 3"));
    assert!(
        link("<collision name='x'><geometry><polyline/></geometry></collision>").contains("\"polyline\" is not read")
    );
    let joint = "<model name='m'><link name='a'/><joint name='j'><parent>a</parent><child>x</child></joint></model>";
    assert!(why(joint).contains("a joint names \"x\", which is no link of its model"));
    let joints = Wanted { joints: vec![("j".to_owned(), 1.0)], ..Wanted::default() };
    assert!(folder(joint).refused("a.sdf", &joints).contains("values of joints are for URDF and MJCF"));
}
