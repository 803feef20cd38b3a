//! Wrappers of libraries that may not be shipped, built against stand-ins that have their published interface.

use std::path::{Path, PathBuf};
use std::process::Command;

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_sandbox::{Launcher, Objects, Policy, Profile, Session, Trial};
use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};

use super::support::{distance, hit};

/// Name, and how make is told where the copy is.
const OWN: [(&str, &str); 4] =
    [("pqp", "PQP_DIR"), ("rapid", "RAPID_DIR"), ("v-collide", "V_COLLIDE_DIR"), ("solid", "SOLID_DIR")];

fn build(name: &str, variable: &str, folder: &Path) -> PathBuf {
    output(&mut make(name, variable, &root().join("tests/standins").join(name), folder));
    folder.join(format!("libocb_{name}.so"))
}

/// Builds the wrapper against this copy, into this folder.
fn make(name: &str, variable: &str, copy: &Path, folder: &Path) -> Command {
    let mut make = command("make");
    make.arg("-C").arg(root().join("plugins/cpp")).arg(name);
    make.arg(format!("{variable}={}", copy.display())).arg(format!("OUT={}", folder.display()));
    make.arg("CXXFLAGS=-O1");
    make
}

/// A copy of SOLID: these files of the stand-in, others with this text.
fn solid(folder: &Path, standin: &[(&str, &str)], text: &[(&str, &str)]) {
    let from = root().join("tests/standins");
    let place = |to: &str| {
        let path = folder.join(to);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        path
    };
    for (file, to) in standin {
        std::fs::copy(from.join(file), place(to)).expect("a copy");
    }
    for (to, text) in text {
        std::fs::write(place(to), text).expect("a file");
    }
}

const HEADER: (&str, &str) = ("solid/SOLID.h", "include/SOLID/SOLID.h");

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
    let trial = Trial { plugin, algorithm, objects: Objects::Pair(mesh_a, Some(mesh_b)), parameters, semantics };
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

/// As SOLID 3's own folder: headers apart, sources in folders, some of them in C, one for old compilers and one a program.
#[test]
fn sources_may_lie_in_folders_and_be_in_c() {
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("solid3");
    let standin = [
        ("solid/SOLID.h", "include/SOLID.h"),
        ("solid/SOLID.cpp", "src/complex/DT_Complex.cpp"),
        ("standin.hpp", "src/standin.hpp"),
    ];
    let text = [
        (
            "src/DT_Object.cpp",
            "#include <DT_Convex.h>\nextern \"C\" int qh_new(int);\nint any() { return qh_new(CONVEX); }\n",
        ),
        ("src/convex/DT_Convex.cpp", "#include \"DT_Convex.h\"\n"),
        ("src/convex/DT_Convex.h", "#ifndef USE_DOUBLES\n#error\n#endif\n#define CONVEX 1\n"),
        // Not C++: a variable of that name, and two C sources, since the compiler may take only the first as C.
        ("src/qhull/geom.c", "int qh_other(int new);\nint qh_new(int new) { return qh_other(new); }\n"),
        ("src/qhull/other.c", "int qh_other(int new) { return new; }\n"),
        ("src/qhull/unix.c", "int main(void) { return absent(); }\n"),
        ("src/qhull/qhull_interface.cpp", "#include <iostream.h>\n"),
    ];
    solid(&copy, &standin, &text);
    output(&mut make("solid", "SOLID_DIR", &copy, folder.path()));
    let mut session = start(&folder.path().join("libocb_solid.so"), "solid", &objects());
    assert!(hit(&mut session, &Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() }));
}

#[test]
fn an_installed_library_is_linked_and_listed_under_either_name() {
    for name in ["libsolid3.so", "libsolid.so"] {
        let folder = tempfile::tempdir().expect("a folder");
        let prefix = folder.path().join("prefix");
        solid(
            &prefix,
            &[
                HEADER,
                ("solid/SOLID.h", "src/SOLID.h"),
                ("solid/SOLID.cpp", "src/SOLID.cpp"),
                ("standin.hpp", "standin.hpp"),
            ],
            &[],
        );
        let library = prefix.join("lib").join(name);
        std::fs::create_dir_all(prefix.join("lib")).expect("a folder");
        let mut compiler = command("g++");
        compiler.args(["-std=c++17", "-shared", "-fPIC", "-o"]).arg(&library).arg(prefix.join("src/SOLID.cpp"));
        for headers in ["plugins/cpp/common", "plugin-api/include"] {
            compiler.arg("-I").arg(root().join(headers));
        }
        output(compiler.arg(format!("-Wl,-soname,{name}")));
        // What is installed is linked; sources beside it are not compiled once more.
        std::fs::write(prefix.join("src/SOLID.cpp"), "#error").expect("a file");
        output(&mut make("solid", "SOLID_DIR", &prefix, folder.path()));
        let listed = std::fs::read_to_string(folder.path().join("libocb_solid.libraries")).expect("a list");
        assert_eq!(listed.trim(), library.display().to_string());
    }
}

#[test]
fn a_header_without_a_library_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("solid3");
    solid(&copy, &[HEADER], &[]);
    let done = make("solid", "SOLID_DIR", &copy, folder.path()).output().expect("make runs");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(!done.status.success() && said.contains("neither sources beside it nor a library"), "{said}");
    // A source that defines nothing of what the wrapper needs.
    solid(&copy, &[], &[("src/empty.cpp", "")]);
    let done = make("solid", "SOLID_DIR", &copy, folder.path()).output().expect("make runs");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(!done.status.success() && said.contains("undefined reference"), "{said}");
    assert!(!folder.path().join("libocb_solid.so").exists());
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
