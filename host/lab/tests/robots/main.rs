//! The robots of `example-robot-data` (PyPI): each is imported or refused with a sentence, and stands as Pinocchio places it.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use ocb_core::mesh::Mesh;
use ocb_core::scene::{Geometry, SceneObject};
use ocb_lab::scene_file::SceneFile;
use ocb_lab::scene_import::{Imported, Wanted, import};
use serde::Deserialize;

/// Where `tests/setup/tools.sh` installs both.
const INSTALLED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../.tools/robots");
/// Largest difference of a number of a pose, and of a primitive.
const POSE: f64 = 1e-9;
/// Pinocchio reads meshes in single precision: largest difference as a share of the largest coordinate, and of the area.
const SINGLE: f64 = 1e-6;

/// Objects that Pinocchio has otherwise, for a known reason.
const OTHERWISE: [(&str, &str); 4] = [
    // The second material of this mesh is read by Coal with the vertices of the first: its triangles are false there.
    ("icub.urdf", "head_0"),
    ("icub_reduced.urdf", "head_0"),
    // An extension of Pinocchio's replaces the cylinder by a capsule, and the mesh by its hull.
    ("simple_humanoid.urdf", "BODY_0"),
    ("simple_humanoid.urdf", "BODY_1"),
];

/// What Pinocchio says of an object.
#[derive(Debug, Deserialize)]
struct Placed {
    name: String,
    pose: [f64; 12],
    kind: String,
    sizes: Vec<f64>,
}

#[test]
fn every_robot_is_imported_or_refused_with_a_sentence() {
    let mut refused = BTreeMap::new();
    let (mut robots, mut kinds) = (0, BTreeMap::new());
    for urdf in urdfs() {
        match import(&urdf, &Wanted::default()) {
            Ok(Imported { file, .. }) => {
                robots += 1;
                file.scene.objects.iter().for_each(|it| *kinds.entry(kind(&it.geometry)).or_insert(0) += 1);
            }
            Err(why) => {
                let why = why.to_string();
                let name = urdf.file_name().unwrap().to_string_lossy().into_owned();
                let why = why.strip_prefix(&format!("\"{name}\" cannot be imported: ")).expect("a sentence").to_owned();
                refused.insert(name, why);
            }
        }
    }
    let none = "it has no collision geometry (visual geometry is not imported).";
    let expected = [
        ("TwoDofs.urdf", none),
        ("alexander_v1.lowerBodyOnly.urdf", none),
        ("human.urdf", none),
        ("simple_humanoid_classical.urdf", none),
        ("ur3.urdf", "it has 0 links, and 1 to 100000 are read."),
    ];
    assert_eq!(refused, expected.map(|(name, why)| (name.to_owned(), why.to_owned())).into());
    assert_eq!(robots, 64);
    assert_eq!(kinds, [("box", 240), ("cylinder", 293), ("mesh", 950), ("sphere", 123)].into());
}

#[test]
fn robots_stand_as_pinocchio_places_them() {
    let urdfs = urdfs();
    let mut compared = Vec::new();
    let mut differences = Vec::new();
    for (urdf, placed) in urdfs.iter().zip(pinocchio(&urdfs)) {
        let name = urdf.file_name().unwrap().to_string_lossy();
        let (Ok(it), Some(placed)) = (import(urdf, &Wanted::default()), placed) else { continue };
        assert_eq!(it.file.scene.objects.len(), placed.len(), "{name}");
        for theirs in &placed {
            let ours = it.file.scene.objects.iter().find(|object| object.name == theirs.name);
            let ours = ours.unwrap_or_else(|| panic!("{name} has no {}", theirs.name));
            if OTHERWISE.contains(&(&*name, &theirs.name)) {
                assert!(
                    difference(&it.file, ours, theirs).is_some(),
                    "{name} {} does not differ any more",
                    theirs.name
                );
                continue;
            }
            differences
                .extend(difference(&it.file, ours, theirs).map(|what| format!("{name} {}: {what}", theirs.name)));
        }
        compared.push((name.into_owned(), placed.len()));
    }
    assert!(differences.is_empty(), "{} differ:\n{}", differences.len(), differences.join("\n"));
    for named in ["ur5_robot.urdf", "panda.urdf", "panda_collision.urdf", "talos_full_v2.urdf"] {
        assert!(compared.iter().any(|(name, _)| name == named), "{named} was not compared");
    }
    assert_eq!((compared.len(), compared.iter().map(|(_, objects)| objects).sum::<usize>()), (64, 1606));
}

/// What differs between an object and Pinocchio's.
fn difference(file: &SceneFile, ours: &SceneObject, theirs: &Placed) -> Option<String> {
    let matrix = ours.pose.to_row_major();
    let off = matrix.iter().zip(&theirs.pose).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    if off > POSE {
        return Some(format!("the pose is off by {off:e}"));
    }
    let sizes = sizes(file, &ours.geometry);
    if kind(&ours.geometry) != theirs.kind || sizes.len() != theirs.sizes.len() {
        return Some(format!("{:?} is {}", ours.geometry, theirs.kind));
    }
    let most = match ours.geometry {
        Geometry::Mesh { .. } => SINGLE * sizes[1..7].iter().fold(0.0, |most: f64, x| most.max(x.abs())),
        _ => POSE,
    };
    let is_mesh = matches!(ours.geometry, Geometry::Mesh { .. });
    let wrong = (0..sizes.len()).find(|&place| {
        let (ours, theirs) = (sizes[place], theirs.sizes[place]);
        match place {
            // Triangles without area in single precision are dropped there.
            0 if is_mesh => theirs > ours || theirs < 0.9 * ours,
            7 => (ours - theirs).abs() > SINGLE * ours,
            _ => (ours - theirs).abs() > most,
        }
    })?;
    Some(format!("size {wrong} is {} and not {}", sizes[wrong], theirs.sizes[wrong]))
}

fn kind(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Mesh { .. } => "mesh",
        Geometry::Box { .. } => "box",
        Geometry::Sphere { .. } => "sphere",
        Geometry::Cylinder { .. } => "cylinder",
        Geometry::Capsule { .. } => "capsule",
    }
}

/// As `placed.py` prints them.
fn sizes(file: &SceneFile, geometry: &Geometry) -> Vec<f64> {
    match geometry {
        Geometry::Mesh { sha256, .. } => mesh_sizes(&file.meshes[sha256]),
        Geometry::Box { size } => size.to_vec(),
        Geometry::Sphere { radius } => vec![*radius],
        Geometry::Cylinder { radius, length } | Geometry::Capsule { radius, length } => vec![*radius, *length],
    }
}

fn mesh_sizes(mesh: &Mesh) -> Vec<f64> {
    let bounds = mesh.bounds();
    let area = |t: u32| {
        let [a, b, c] = mesh.corners(t);
        (b - a).cross(&(c - a)).norm() / 2.0
    };
    let count = mesh.triangles().len();
    let mut sizes = vec![count as f64];
    sizes.extend(bounds.min.iter().chain(bounds.max.iter()));
    sizes.push((0..count as u32).map(area).sum());
    sizes
}

/// What Pinocchio makes of each file; nothing of those that it refuses.
#[expect(clippy::disallowed_methods, reason = "Pinocchio is a program of its own")]
fn pinocchio(urdfs: &[PathBuf]) -> Vec<Option<Vec<Placed>>> {
    let list = Path::new(env!("CARGO_TARGET_TMPDIR")).join("urdfs.txt");
    let names: Vec<_> = urdfs.iter().map(|file| file.to_str().expect("a name in UTF-8")).collect();
    std::fs::write(&list, names.join("\n")).expect("the names are written");
    let done = Command::new(format!("{INSTALLED}/bin/python"))
        .args(["-W", "ignore", concat!(env!("CARGO_MANIFEST_DIR"), "/tests/robots/placed.py")])
        .stdin(File::open(&list).expect("the names are read"))
        .stderr(Stdio::null())
        .output()
        .expect("Python starts");
    assert!(done.status.success(), "not run: Pinocchio is not installed");
    let lines = String::from_utf8(done.stdout).expect("text");
    let all: Vec<_> = lines.lines().map(|line| serde_json::from_str(line).expect("JSON of placed.py")).collect();
    assert_eq!(all.len(), urdfs.len());
    all
}

/// The URDF files, in the order of their names.
fn urdfs() -> Vec<PathBuf> {
    assert!(Path::new(INSTALLED).join("complete").is_file(), "not run: the robots are not installed");
    let mut folders = vec![PathBuf::from(INSTALLED)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
            let (path, kind) = (entry.path(), entry.file_type().expect("a kind"));
            if kind.is_dir() {
                folders.push(path);
            } else if kind.is_file() && path.extension().is_some_and(|ending| ending == "urdf") {
                files.push(path);
            }
        }
    }
    files.sort_unstable();
    assert_eq!(files.len(), 69);
    files
}
