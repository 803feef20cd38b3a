//! The robot with simpler collision geometry, imported again.

use std::path::Path;

use super::*;
use crate::scene_import::{self, Wanted};

const ROBOT: &str = r#"<?xml version="1.0"?>
<robot name="two">
  <!-- This stays. -->
  <link name="base">
    <collision name="the &lt;base&gt;">
      <origin xyz="0.5 0 -1" rpy="0.3 -0.2 1.1"/>
      <geometry><mesh filename="knot.obj"/></geometry>
    </collision>
  </link>
  <link name="arm">
    <visual><geometry><mesh filename="knot.obj"/></geometry></visual>
    <collision><geometry><mesh filename="knot.obj"/></geometry></collision>
    <collision><geometry><sphere radius="0.25"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/><origin xyz="9 0 0"/>
  </joint>
</robot>
"#;

/// A robot beside its mesh, and a recording of it in which its parts are far apart.
fn robot(folder: &Path, kind: Kind) -> (std::path::PathBuf, Recording) {
    let path = folder.join("two.urdf");
    std::fs::write(&path, ROBOT).expect("a file");
    std::fs::write(folder.join("knot.obj"), ocb_core::mesh::obj::write(&knot(2000))).expect("a file");
    let scene = scene_import::import(&path, &Wanted::default()).expect("a robot").file;
    let poses: Vec<Pose> = scene.scene.objects.iter().map(|object| object.pose).collect();
    let query = |sequence: u64, objects: [u32; 2]| Recorded {
        sequence,
        group: 0,
        objects,
        configuration: Configuration { pose_a: poses[objects[0] as usize], pose_b: poses[objects[1] as usize] },
        kind,
        limit: 0.0,
        answered: Answered::default(),
        seconds: None,
        library: 0,
    };
    let queries = vec![query(0, [0, 1]), query(1, [0, 2])];
    (path, Recording { scene, about: About::default(), queries })
}

#[test]
fn a_rewritten_robot_has_the_bodies_where_the_reduced_scene_has_them() {
    let folder = tempfile::tempdir().expect("a folder");
    for (kind, outside_only) in [(Kind::Collide, true), (Kind::Distance, false)] {
        let (path, before) = robot(folder.path(), kind);
        let terms = ReduceTerms { tolerance: 0.01, near: 0.0, outside_only, frontier: false };
        let after = done(&before, terms, &make);
        let written = Robot::read(&path, &Wanted::default(), &before).expect("a robot").with(&after);
        assert!(written.text.contains("<!-- This stays. -->") && written.text.contains("the &lt;base>"));
        assert!(written.text != ROBOT && written.text.contains("<visual><geometry><mesh filename=\"knot.obj\"/>"));
        let out = folder.path().join("out.urdf");
        std::fs::write(&out, &written.text).expect("a file");
        for (name, bytes) in &written.meshes {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, bytes).expect("a file");
        }
        let again = scene_import::import(&out, &Wanted::default()).expect("a robot").file;
        let reduced = &after.recording.scene.scene.objects;
        let mut found = again.scene.objects.iter();
        for object in reduced {
            // A capsule is its cylinder and the balls at its ends.
            let parts = match object.geometry {
                Geometry::Capsule { radius, length } => {
                    let ball = |up: f64| (Geometry::Sphere { radius }, Vector3::z() * (up * length / 2.0));
                    vec![(Geometry::Cylinder { radius, length }, Vector3::zeros()), ball(-1.0), ball(1.0)]
                }
                _ => vec![(object.geometry.clone(), Vector3::zeros())],
            };
            for (geometry, at) in parts {
                let own = found.next().expect("as many bodies");
                let same = match (&own.geometry, &geometry) {
                    (Geometry::Mesh { sha256: own, .. }, Geometry::Mesh { sha256: reduced, .. }) => own == reduced,
                    (own, reduced) => own == reduced,
                };
                assert!(same, "{own:?} {geometry:?}");
                assert!((own.pose.linear - object.pose.linear).amax() < 1e-12);
                let at = object.pose.translation + object.pose.linear * at;
                assert!((own.pose.translation - at).amax() < 1e-12, "{own:?} {object:?}");
            }
        }
        assert!(found.next().is_none());
    }
}

#[test]
fn a_robot_that_was_not_recorded_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, mut before) = robot(folder.path(), Kind::Collide);
    std::fs::write(folder.path().join("knot.obj"), ocb_core::mesh::obj::write(&knot(700))).expect("a file");
    let refused = |before: &Recording| {
        Robot::read(&path, &Wanted::default(), before).err().map(|e| e.to_string()).unwrap_or_default()
    };
    assert!(refused(&before).contains("another shape"), "{}", refused(&before));
    for object in &mut before.scene.scene.objects {
        object.name.insert(0, 'x');
    }
    assert!(refused(&before).contains("no object of the recording"), "{}", refused(&before));
}

#[test]
fn of_several_hulls_each_is_an_element() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, before) = robot(folder.path(), Kind::Collide);
    let terms = ReduceTerms { tolerance: 0.01, near: 0.0, outside_only: true, frontier: false };
    let halves = |_: &str, object: &Arc<Mesh>| {
        let ([x, y, z], middle) = (object.bounds().sides().into(), object.bounds().center());
        let half = |side: f64| {
            let half =
                tessellate::outside(&Geometry::Box { size: [0.51 * x, 1.01 * y, 1.01 * z] }, 0.0).expect("a box");
            let at = middle.coords + Vector3::x() * (side * 0.25 * x);
            let moved = half.positions().iter().map(|p| p + at).collect();
            Arc::new(Mesh::new(moved, half.triangles().to_vec()).expect("a box"))
        };
        Ok(Some(Simplified { parts: vec![vec![half(-1.0), half(1.0)]], ..Simplified::default() }))
    };
    let mut after = done(&before, terms, &halves);
    let base = &before.scene.scene.objects[0];
    let all = stand_in::of(&before.scene, &base.geometry, "", terms, &halves, &Unwatched)
        .expect("bodies")
        .expect("nothing stops it");
    after.stand_ins[0] = all.into_iter().find(|it| it.kind == BodyKind::Hulls).expect("they cover the knot");
    let written = Robot::read(&path, &Wanted::default(), &before).expect("a robot").with(&after);
    let out = folder.path().join("out.urdf");
    std::fs::write(&out, &written.text).expect("a file");
    std::fs::create_dir(folder.path().join("collision")).expect("a folder");
    for (name, bytes) in &written.meshes {
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    let again = scene_import::import(&out, &Wanted::default()).expect("a robot").file;
    for (own, hull) in again.scene.objects.iter().zip(&after.stand_ins[0].hulls) {
        let Geometry::Mesh { sha256, .. } = &own.geometry else { panic!("{own:?} is no mesh") };
        assert_eq!((&*again.meshes[sha256], own.link.as_deref()), (&**hull, Some("base")));
        assert!((own.pose.linear - base.pose.linear).amax() < 1e-12);
        assert!((own.pose.translation - base.pose.translation).amax() < 1e-12);
    }
    assert_eq!(again.scene.objects[2].link.as_deref(), Some("arm"));
}
