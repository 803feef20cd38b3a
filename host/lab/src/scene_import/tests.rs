//! Robots that the tests write themselves, compared with places computed by hand.

mod hostile;
mod mjcf;
mod sdf;
mod urdf;

use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use ocb_core::mesh::Mesh;
use ocb_core::scene::{Geometry, SceneObject};
use tempfile::TempDir;

use super::{Imported, Wanted, import};

/// One triangle, with its front towards positive z.
const TRIANGLE: &str = "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\n";

/// A folder `robot` with files in it, in a folder of its own.
struct Folder {
    whole: TempDir,
}

impl Folder {
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self { whole: tempfile::tempdir().unwrap() };
        for (name, content) in files {
            let path = folder.path(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, content).unwrap();
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.whole.path().join("robot").join(name)
    }

    fn import(&self, name: &str, wanted: &Wanted) -> Imported {
        import(&self.path(name), wanted).unwrap()
    }

    /// Why a file is refused: one sentence.
    fn refused(&self, name: &str, wanted: &Wanted) -> String {
        let why = import(&self.path(name), wanted).unwrap_err().to_string();
        assert!(why.ends_with('.') && !why.contains('\n') && why.len() < 500, "no sentence: {why:?}");
        why
    }
}

/// The robot of this text, imported.
fn imported(text: &str) -> Imported {
    Folder::with(&[("a.urdf", text), ("t.obj", TRIANGLE)]).import("a.urdf", &Wanted::default())
}

/// Why the robot of this text is refused.
fn refused(text: &str) -> String {
    Folder::with(&[("a.urdf", text), ("t.obj", TRIANGLE)]).refused("a.urdf", &Wanted::default())
}

fn object<'a>(imported: &'a Imported, name: &str) -> &'a SceneObject {
    let objects = &imported.file.scene.objects;
    objects.iter().find(|object| object.name == name).unwrap_or_else(|| panic!("no {name} in {objects:?}"))
}

fn mesh<'a>(imported: &'a Imported, name: &str) -> &'a Mesh {
    let Geometry::Mesh { sha256, .. } = &object(imported, name).geometry else { panic!("{name} is no mesh") };
    &imported.file.meshes[sha256]
}

/// Is an object there, up to rounding?
#[track_caller]
fn stands(imported: &Imported, name: &str, linear: [[f64; 3]; 3], translation: [f64; 3]) {
    let pose = &object(imported, name).pose;
    let linear = Matrix3::from_fn(|row, column| linear[row][column]);
    let off = (pose.linear - linear).amax().max((pose.translation - Vector3::from(translation)).amax());
    assert!(off < 1e-12, "{name} is off by {off}: {pose:?}");
}

/// The disabled pairs by the names of their objects.
fn disabled(imported: &Imported) -> Vec<(&str, &str, &str)> {
    let scene = &imported.file.scene;
    let name = |index: u32| scene.objects[index as usize].name.as_str();
    scene.disabled.iter().map(|pair| (name(pair.a), name(pair.b), pair.reason.as_str())).collect()
}

fn package(name: &str, folder: &Path) -> Wanted {
    Wanted { packages: vec![(name.to_owned(), folder.to_owned())], ..Wanted::default() }
}
