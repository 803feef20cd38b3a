//! Meshes and sets of configurations of the project's shared data.

use std::path::{Path, PathBuf};

use opencollbench_plugin::Pose;

use super::Soup;

/// A set of configurations whose answers several independent libraries agree on.
pub struct KnownSet {
    pub soup: Soup,
    /// Placements of B in A's frame.
    pub poses: Vec<Pose>,
    /// Their distances; none for a set in which all collide.
    pub distances: Option<Vec<f64>>,
}

/// A file of the project's shared data.
fn shared(folder: &str, name: &str) -> PathBuf {
    // Plugins and their libraries lie at different depths.
    let beside = || {
        let mut above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
        above.find(|folder| folder.join("Cargo.lock").is_file()).expect("the repository").join("../shared")
    };
    let root = std::env::var_os("OCB_SHARED").map_or_else(beside, PathBuf::from);
    assert!(root.join("meshes").is_dir(), "not run: objects missing, set OCB_SHARED");
    root.join(folder).join(name)
}

/// What is in a file of the project's shared data.
pub fn shared_file(folder: &str, name: &str) -> Vec<u8> {
    read(&shared(folder, name))
}

fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| {
        panic!(
            "this needs {}: {error}. Put the project's shared data (folders `meshes` and `configurations`) in the folder \
             `shared` beside the repository, or say where it is by the environment variable OCB_SHARED",
            path.display()
        )
    })
}

/// A mesh of the project's shared data.
pub fn known_mesh(mesh: &str) -> Soup {
    let text = read(&shared("meshes", &format!("{mesh}.obj")));
    let mut soup = Soup { positions: Vec::new(), triangles: Vec::new() };
    for line in String::from_utf8_lossy(&text).lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                // The coordinates are those of single precision, written with as many digits as that needs.
                let mut number = || {
                    let single: Option<f32> = words.next().and_then(|word| word.parse().ok());
                    f64::from(single.expect("a coordinate"))
                };
                soup.positions.push([number(), number(), number()]);
            }
            Some("f") => {
                let mut index = || {
                    let word = words.next().and_then(|word| word.split('/').next()).expect("a corner");
                    word.parse::<u32>().expect("a vertex number") - 1
                };
                soup.triangles.push([index(), index(), index()]);
            }
            _ => {}
        }
    }
    soup
}

/// The poses of a set of the project's shared data, and their distances if they are known; none if there is no such set.
pub fn known_poses(mesh: &str, set: &str) -> Option<(Vec<Pose>, Option<Vec<f64>>)> {
    let file = |end: &str| shared("configurations", &format!("{mesh}.{set}{end}"));
    let numbers = |path: PathBuf| -> Option<Vec<f64>> {
        path.exists().then(|| read(&path).as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
    };
    let poses = numbers(file(".f64"))?.as_chunks::<16>().0.iter().map(|m| Pose(*m)).collect();
    Some((poses, numbers(file(".distance.f64"))))
}

/// Reads `<mesh>.<set>` from the project's shared data.
pub fn known_set(mesh: &str, set: &str) -> KnownSet {
    let soup = known_mesh(mesh);
    let (poses, distances) = known_poses(mesh, set).unwrap_or_else(|| panic!("{mesh}.{set} is not in the shared data"));
    assert_eq!(poses.len(), 1000, "{mesh}.{set} is not the set that this test knows");
    KnownSet { soup, poses, distances }
}
