//! Wrappers of libraries that may not be shipped, built against stand-ins that have their published interface.

use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_sandbox::{Launcher, Policy, Profile, Session, Trial};
use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};

use super::support::{distance, hit};

/// Name, and how make is told where the copy is.
const OWN: [(&str, &str); 4] =
    [("pqp", "PQP_DIR"), ("rapid", "RAPID_DIR"), ("v-collide", "V_COLLIDE_DIR"), ("solid", "SOLID_DIR")];

fn build(name: &str, variable: &str, folder: &Path) -> PathBuf {
    let copy = root().join("tests/standins").join(name);
    let mut make = command("make");
    make.arg("-C").arg(root().join("plugins/cpp")).arg(name);
    make.arg(format!("{variable}={}", copy.display())).arg(format!("OUT={}", folder.display()));
    output(make.arg("CXXFLAGS=-O1"));
    folder.join(format!("libocb_{name}.so"))
}

/// A triangle far away and one around the origin; upright ones.
fn objects() -> [Mesh; 2] {
    let far = [[9.0, 9.0, 9.0], [9.0, 9.0, 8.0], [9.0, 8.0, 9.0]];
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let upright = [[0.2, 0.3, -1.0], [0.2, 0.3, 1.0], [0.3, 0.2, 1.0]];
    let soup = |all: &[[[f64; 3]; 3]]| {
        let triangles = (0..all.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Mesh::new(all.iter().flatten().map(|p| Point3::from(*p)).collect(), triangles).expect("valid")
    };
    [soup(&[far, flat]), soup(&[upright])]
}

/// A quarter turn about z, then a translation.
fn turned(x: f64, y: f64, z: f64) -> Pose {
    Pose { linear: Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0), translation: Vector3::new(x, y, z) }
}

fn start(plugin: &Path, algorithm: &str, [mesh_a, mesh_b]: &[Mesh; 2]) -> Session {
    let launcher = Launcher::new(built("ocb-runner"), Policy { profile: Profile::Dev, ..Policy::default() });
    let (parameters, semantics) = (&[][..], Semantics::Surface);
    let trial = Trial { plugin, algorithm, mesh_a, mesh_b: Some(mesh_b), parameters, semantics };
    launcher.start(&trial).unwrap_or_else(|end| panic!("{algorithm}: {end} {}", end.stderr))
}

#[test]
fn each_builds_against_a_copy_and_places_objects_as_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let still = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
    let alone = Configuration { pose_b: turned(0.0, 0.0, 0.0), ..still };
    let together = Configuration { pose_a: turned(5.0, 6.0, 7.0), pose_b: turned(5.0, 6.0, 7.0) };
    let beside = Configuration { pose_b: turned(8.0, 5.0, 9.0), ..still };
    for (name, variable) in OWN {
        let mut session = start(&build(name, variable, folder.path()), name, &objects());
        assert!(hit(&mut session, &still) && hit(&mut session, &together), "{name}");
        assert!(!hit(&mut session, &alone), "{name}");
        let Answer::Collision { pair, .. } = session.query(Query::CollisionFirst, &together).expect("an answer").answer
        else {
            panic!("{name}")
        };
        assert!(pair.is_none() || pair == Some([1, 0]), "{name}: {pair:?}");
        if name != "solid" {
            let found = session.query(Query::CollisionAll, &together).expect("an answer").answer;
            assert_eq!(found, Answer::Contacts { total: 1, pairs: vec![[1, 0]] }, "{name}");
        }
        if ["pqp", "solid"].contains(&name) {
            // Corner (9, 8, 9) of A, and (0.3, 0.2, 1) of B, which pose_b puts at (7.8, 5.3, 10).
            let found = distance(&mut session, &beside);
            let expected = (1.2f64 * 1.2 + 2.7 * 2.7 + 1.0).sqrt();
            assert!((found - expected).abs() < 1e-12, "{name}: {found}");
            let answer = session.query(Query::Proximity, &beside).expect("an answer").answer;
            let Answer::Distance { points: Some([a, b]), .. } = answer else { panic!("{name}: {answer:?}") };
            assert!((a - Point3::new(9.0, 8.0, 9.0)).norm() < 1e-12, "{name}: {a}");
            assert!((b - Point3::new(7.8, 5.3, 10.0)).norm() < 1e-12, "{name}: {b}");
        }
    }
}

#[test]
fn a_missing_copy_is_asked_for() {
    for (name, variable) in OWN {
        for told in [None, Some("/nowhere")] {
            let mut make = command("make");
            make.arg("-C").arg(root().join("plugins/cpp")).arg(name).env_remove(variable);
            make.args(told.map(|path| format!("{variable}={path}")));
            let done = make.output().expect("make runs");
            let said = String::from_utf8_lossy(&done.stderr);
            let wanted = format!("plugin-{name} needs your own copy of the library");
            assert!(!done.status.success() && said.contains(&wanted) && said.contains(variable), "{said}");
        }
    }
}
