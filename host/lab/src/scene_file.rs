//! Scene files: a zip archive with the scene, and the mesh of each object that is one. A recording is such a file with more in it.

use std::collections::HashMap;
use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;
use std::sync::Arc;

use ocb_core::mesh::{self, MAX_BYTES, Mesh, write_ply};
use ocb_core::scene::{Geometry, MOST_OBJECTS, Scene};
use ocb_sandbox::given;
use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::{LabError, Result, sha256_hex};

/// The scene in the archive.
const SCENE: &str = "scene.json";
/// The only format there is.
const FORMAT: &str = "opencollbench-scene/1";
/// Bytes of `scene.json`, and of all meshes together.
const MOST_SCENE: u64 = 256 << 20;
const MOST_MESHES: u64 = 4 << 30;

/// A scene with its meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// The objects.
    pub scene: Scene,
    /// The meshes that they name, by the SHA-256 (hex) of their PLY bytes.
    pub meshes: HashMap<String, Arc<Mesh>>,
}

#[derive(Serialize, Deserialize)]
struct Head<S> {
    format: String,
    scene: S,
}

impl SceneFile {
    /// Keeps a mesh and gives the geometry that names it.
    pub fn keep(meshes: &mut HashMap<String, Arc<Mesh>>, mesh: Mesh) -> Geometry {
        let sha256 = sha256_hex(&write_ply(&mesh));
        meshes.entry(sha256.clone()).or_insert_with(|| Arc::new(mesh));
        Geometry::Mesh { sha256, solid: false }
    }

    /// Reads the scene in this file, also of a recording.
    ///
    /// # Errors
    /// `Invalid`, with one sentence, for a file that is no scene.
    pub fn read(path: &Path) -> Result<Self> {
        Reader::open(path)?.scene()
    }

    /// Writes it with these files beside it; a file of that name is replaced as a whole. The same scene gives the same bytes.
    pub fn write(&self, path: &Path, beside: &[(&str, &[u8])]) -> Result<()> {
        self.scene.check().map_err(|why| LabError::Invalid(format!("This is not a scene: {why}.")))?;
        let failed = |e: &dyn std::fmt::Display| LabError::Invalid(format!("Cannot write {}: {e}.", path.display()));
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let part = NamedTempFile::new_in(folder).map_err(|e| failed(&e))?;
        let mut zip = ZipWriter::new(part);
        let mut put = |name: &str, bytes: &[u8]| {
            // Parquet is compressed already.
            let method =
                if name.ends_with(".parquet") { CompressionMethod::Stored } else { CompressionMethod::Deflated };
            let options =
                SimpleFileOptions::default().compression_method(method).large_file(true).unix_permissions(0o644);
            zip.start_file(name, options).map_err(|e| failed(&e))?;
            zip.write_all(bytes).map_err(|e| failed(&e))
        };
        let head = Head { format: FORMAT.to_owned(), scene: &self.scene };
        put(SCENE, &serde_json::to_vec_pretty(&head).map_err(|e| failed(&e))?)?;
        let mut meshes: Vec<_> = self.meshes.iter().collect();
        meshes.sort_by_key(|(sha256, _)| *sha256);
        for (sha256, mesh) in meshes {
            put(&place(sha256), &write_ply(mesh))?;
        }
        for (name, bytes) in beside {
            put(name, bytes)?;
        }
        let part = zip.finish().map_err(|e| failed(&e))?;
        part.as_file().sync_all().map_err(|e| failed(&e))?;
        part.persist(path).map_err(|e| failed(&e.error))?;
        Ok(())
    }
}

/// Where a mesh is in the archive.
fn place(sha256: &str) -> String {
    format!("objects/{sha256}.ply")
}

/// A scene file, opened. Nothing of it is believed before it is bounded and its hash has been found.
pub struct Reader {
    name: String,
    zip: ZipArchive<File>,
}

impl Reader {
    /// Opens it.
    pub fn open(path: &Path) -> Result<Self> {
        Self::open_as(path, &path.file_name().unwrap_or_default().to_string_lossy())
    }

    /// The same for a file that its owner knows by another name.
    pub fn open_as(path: &Path, name: &str) -> Result<Self> {
        let name = name.to_owned();
        let file = given::open(path).map_err(|e| LabError::Invalid(format!("{name:?} cannot be opened: {e}.")))?;
        let bad = |why: String| LabError::Invalid(format!("{name:?} is not a scene: {why}."));
        let zip = ZipArchive::new(file).map_err(|e| bad(format!("it is not a zip archive ({e})")))?;
        if zip.len() > MOST_OBJECTS + 10 {
            return Err(bad(format!("it has more than {MOST_OBJECTS} objects")));
        }
        Ok(Self { name, zip })
    }

    /// The scene with its meshes.
    pub fn scene(&mut self) -> Result<SceneFile> {
        self.whole().map_err(|why| LabError::Invalid(format!("{:?} is not a scene: {why}.", self.name)))
    }

    /// Another file in the archive, of so many bytes at most, if it is there.
    pub fn other(&mut self, name: &str, most: u64) -> Result<Option<Vec<u8>>> {
        self.file(name, most).map_err(|why| LabError::Invalid(format!("{:?} cannot be read: {why}.", self.name)))
    }

    fn whole(&mut self) -> std::result::Result<SceneFile, String> {
        let head = self.file(SCENE, MOST_SCENE)?.ok_or_else(|| format!("{SCENE} is missing"))?;
        let Head { format, scene } =
            serde_json::from_slice::<Head<Scene>>(&head).map_err(|e| format!("{SCENE} cannot be read ({e})"))?;
        if format != FORMAT {
            return Err(format!("its format is {format:?}, and only {FORMAT:?} can be read"));
        }
        scene.check().map_err(|why| why.to_string())?;
        let mut left = MOST_MESHES;
        let mut meshes = HashMap::new();
        for object in &scene.objects {
            if let Geometry::Mesh { sha256, .. } = &object.geometry
                && !meshes.contains_key(sha256)
            {
                let bad = |why: String| format!("the mesh of {:?} {why}", object.name);
                let most = left.min(MAX_BYTES as u64);
                let bytes = self.file(&place(sha256), most)?.ok_or_else(|| bad("is missing".into()))?;
                left -= bytes.len() as u64;
                if sha256_hex(&bytes) != *sha256 {
                    return Err(bad("is not the one that the scene names: its SHA-256 differs".into()));
                }
                let read = mesh::read(&bytes).map_err(|e| bad(format!("cannot be read ({e})")))?;
                meshes.insert(sha256.clone(), Arc::new(read.mesh));
            }
        }
        Ok(SceneFile { scene, meshes })
    }

    /// No more of a file is unpacked than allowed, whatever its head says.
    fn file(&mut self, name: &str, most: u64) -> std::result::Result<Option<Vec<u8>>, String> {
        let entry = match self.zip.by_name(name) {
            Ok(entry) => entry,
            Err(zip::result::ZipError::FileNotFound) => return Ok(None),
            Err(e) => return Err(format!("the file {name:?} in it cannot be read ({e})")),
        };
        let mut content = Vec::new();
        entry.take(most + 1).read_to_end(&mut content).map_err(|e| format!("{name:?} in it is damaged ({e})"))?;
        if content.len() as u64 > most {
            return Err(format!("{name:?} in it has more than {most} bytes"));
        }
        Ok(Some(content))
    }
}

#[cfg(test)]
mod tests {
    use ocb_core::pose::Pose;
    use ocb_core::scene::SceneObject;
    use ocb_core::stock;

    use super::*;

    fn scene() -> SceneFile {
        let mut meshes = HashMap::new();
        let knot = SceneFile::keep(&mut meshes, stock::generate("torus-knot", 600).unwrap());
        let object = |name: &str, geometry: &Geometry| SceneObject {
            name: name.to_owned(),
            link: None,
            geometry: geometry.clone(),
            pose: Pose::identity(),
            source: String::new(),
            scale: [1.0; 3],
            licence: None,
        };
        let ball = Geometry::Sphere { radius: 0.1 + 0.2 };
        let objects = vec![object("knot", &knot), object("again", &knot), object("ball", &ball)];
        SceneFile { scene: Scene { name: "three".into(), objects, disabled: Vec::new() }, meshes }
    }

    /// An archive with these files.
    fn zipped(files: &[(&str, &[u8])]) -> NamedTempFile {
        let mut zip = ZipWriter::new(NamedTempFile::new().unwrap());
        for (name, bytes) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(bytes).unwrap();
        }
        zip.finish().unwrap()
    }

    #[test]
    fn a_scene_comes_back_bit_for_bit_and_writes_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let [first, second] = ["a.ocbrec", "b.ocbrec"].map(|name| folder.path().join(name));
        for path in [&first, &second] {
            scene().write(path, &[("note", b"beside")]).unwrap();
        }
        assert_eq!(SceneFile::read(&first).unwrap(), scene());
        assert_eq!(std::fs::read(&first).unwrap(), std::fs::read(&second).unwrap());
        let mut reader = Reader::open(&first).unwrap();
        assert_eq!(reader.other("note", 6).unwrap().as_deref(), Some(&b"beside"[..]));
        assert_eq!(reader.other("nothing", 6).unwrap(), None);
        assert!(reader.other("note", 5).unwrap_err().to_string().contains("more than 5 bytes"));
    }

    #[test]
    fn what_is_no_scene_is_refused_with_the_reason() {
        let told = |files: &[(&str, &[u8])]| SceneFile::read(zipped(files).path()).unwrap_err().to_string();
        assert!(told(&[]).contains("scene.json is missing"));
        assert!(told(&[(SCENE, b"{}")]).contains("scene.json cannot be read"));
        let head = |format: &str| serde_json::to_vec(&Head { format: format.into(), scene: scene().scene }).unwrap();
        assert!(told(&[(SCENE, &head("other/2"))]).contains("only \"opencollbench-scene/1\" can be read"));
        assert!(told(&[(SCENE, &head(FORMAT))]).contains("the mesh of \"knot\" is missing"));
        let Geometry::Mesh { sha256, .. } = &scene().scene.objects[0].geometry else { panic!("a mesh") };
        let mesh = place(sha256);
        assert!(told(&[(SCENE, &head(FORMAT)), (&mesh, b"ply")]).contains("its SHA-256 differs"));
        let nothing = NamedTempFile::new().unwrap();
        assert!(SceneFile::read(nothing.path()).unwrap_err().to_string().contains("not a zip archive"));
        assert!(SceneFile::read(Path::new("/dev/zero")).unwrap_err().to_string().contains("not a regular file"));
    }
}
