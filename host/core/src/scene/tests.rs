use nalgebra::{Matrix3, Vector3};

use super::*;

fn object(name: &str, geometry: Geometry) -> SceneObject {
    SceneObject {
        name: name.to_owned(),
        link: Some("tool".to_owned()),
        geometry,
        pose: Pose { translation: Vector3::new(0.1, -2.0, 3e-7), ..Pose::identity() },
        source: "package://arm/tool.stl".to_owned(),
        scale: [0.001, -0.001, 0.001],
        licence: None,
    }
}

fn scene() -> Scene {
    Scene {
        name: "arm".to_owned(),
        objects: vec![
            object("box", Geometry::Box { size: [1.0, 2.0, 3.0] }),
            object("ball", Geometry::Sphere { radius: 0.5 }),
            object("rod", Geometry::Cylinder { radius: 0.5, length: 2.0 }),
            object("pill", Geometry::Capsule { radius: 0.5, length: 0.0 }),
            object("mesh", Geometry::Mesh { sha256: "0f".repeat(32), solid: false }),
        ],
        disabled: vec![DisabledPair { a: 0, b: 3, reason: "same link".to_owned() }],
    }
}

#[test]
fn a_scene_survives_its_file_bit_for_bit() {
    let mut scene = scene();
    let angle = 0.3_f64;
    let (s, c) = angle.sin_cos();
    scene.objects[1].pose.linear = Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    scene.objects[2].licence = Some("BSD-3-Clause".to_owned());
    assert_eq!(scene.check(), Ok(()));
    let text = serde_json::to_string(&scene).expect("it can be written");
    assert_eq!(serde_json::from_str::<Scene>(&text).expect("it can be read"), scene);
}

#[test]
fn files_name_the_kind_and_hold_the_upper_rows_of_the_pose() {
    let scene = scene();
    let value = serde_json::to_value(&scene.objects[0]).expect("it can be written");
    assert_eq!(
        value,
        serde_json::json!({
            "name": "box",
            "link": "tool",
            "geometry": {"kind": "box", "size": [1.0, 2.0, 3.0]},
            "pose": [1.0, 0.0, 0.0, 0.1, 0.0, 1.0, 0.0, -2.0, 0.0, 0.0, 1.0, 3e-7],
            "source": "package://arm/tool.stl",
            "scale": [0.001, -0.001, 0.001],
        })
    );
    let short = serde_json::json!({"name": "a", "geometry": {"kind": "sphere", "radius": 1.0}, "pose": [1.0, 0.0], "source": "",
        "scale": [1.0, 1.0, 1.0]});
    assert!(serde_json::from_value::<SceneObject>(short).is_err(), "a pose of two numbers");
}

/// The scene above with one thing changed is refused with these words.
#[track_caller]
fn refused(change: impl FnOnce(&mut Scene), words: &str) {
    let mut scene = scene();
    assert_eq!(scene.check(), Ok(()));
    change(&mut scene);
    let error = scene.check().expect_err("it must be refused").to_string();
    assert!(error.contains(words), "{error}");
}

#[test]
fn each_fault_is_named() {
    refused(|s| s.name.clear(), "the name of the scene must be");
    refused(|s| s.objects.clear(), "no objects");
    refused(|s| s.objects[1].name = "a\nb".to_owned(), "the name of object 1 must be");
    refused(|s| s.objects[1].name = "x".repeat(501), "1 to 500 bytes");
    refused(|s| s.objects[1].name = "box".to_owned(), "the objects 0 and 1 are both named \"box\"");
    refused(|s| s.objects[2].link = Some(String::new()), "the link of object 2");
    refused(|s| s.objects[2].source = "\u{1b}[2J".to_owned(), "the source of object 2");
    refused(|s| s.objects[2].licence = Some(String::new()), "the licence of object 2");
    refused(|s| s.objects[4].geometry = Geometry::Mesh { sha256: "0F".repeat(32), solid: false }, "64 lower-case");
    refused(
        |s| s.objects[4].geometry = Geometry::Mesh { sha256: "../../etc/passwd".to_owned(), solid: true },
        "64 lower-case",
    );
}

#[test]
fn numbers_must_be_fit_for_computing() {
    let sized = |x| Geometry::Box { size: [1.0, x, 1.0] };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e19, 1e-200] {
        refused(|s| s.objects[0].geometry = sized(bad), "the length in y of object 0");
        refused(|s| s.objects[1].geometry = Geometry::Sphere { radius: bad }, "the radius of object 1");
        refused(|s| s.objects[2].geometry = Geometry::Cylinder { radius: 1.0, length: bad }, "the length of object 2");
        refused(|s| s.objects[3].geometry = Geometry::Capsule { radius: bad, length: 0.0 }, "the radius of object 3");
    }
    refused(|s| s.objects[3].geometry = Geometry::Capsule { radius: 1.0, length: -1.0 }, "the length of object 3");
    for bad in [0.0, f64::NAN, f64::NEG_INFINITY] {
        refused(|s| s.objects[0].scale[2] = bad, "a scale of object 0");
    }
    for bad in [f64::NAN, f64::INFINITY, -1e19, 1e-200] {
        refused(|s| s.objects[0].pose.translation.z = bad, "the pose of object 0 has the number");
    }
    let mirror = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    refused(|s| s.objects[0].pose.linear = mirror, "must be a rotation and a translation");
    refused(|s| s.objects[0].pose.linear *= 1.0 + 1e-7, "at most 1e-12");
}

#[test]
fn pairs_name_two_objects_once() {
    refused(|s| s.disabled[0].b = 5, "must name two objects, the smaller number first, of 0 to 4");
    refused(|s| s.disabled[0].b = 0, "must name two objects");
    refused(|s| s.disabled[0] = DisabledPair { a: 3, b: 0, ..s.disabled[0].clone() }, "the smaller number first");
    refused(|s| s.disabled.push(s.disabled[0].clone()), "the objects 0 and 3 are a disabled pair twice");
    refused(|s| s.disabled[0].reason.clear(), "the reason of disabled pair 0");
}

#[test]
fn a_scene_has_bounded_numbers_of_objects_and_pairs() {
    refused(
        |s| {
            let many = (0..=MOST_OBJECTS).map(|i| object(&i.to_string(), Geometry::Sphere { radius: 1.0 }));
            s.objects = many.collect();
        },
        "the scene has 100001 objects, but at most 100000 are read",
    );
    refused(|s| s.disabled = vec![s.disabled[0].clone(); MOST_DISABLED + 1], "5000001 disabled pairs");
}
