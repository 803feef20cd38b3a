//! Recordings from poses that somebody wrote down: JSON with objects and queries, or a configuration file of one pair.
//!
//! In JSON, an object is `{"name": "cup", "file": "cup.stl"}` or `{"name": "table", "geometry": {"kind": "box", "size": [1, 2, 0.1]}}`,
//! and a query `{"objects": ["cup", "table"], "query": "distance", "pose_b": [1,0,0,0, 0,1,0,0, 0,0,1,0.5], "distance": 0.1}`.
//! Matrices are row-major, of 16 or 12 numbers; `pose_a` and `pose_b` place the objects in the scene. Files are looked for beside the
//! JSON file; coordinates are taken as they stand there, whatever their unit. `"scene": "robot.ocbscene"` takes the objects of a scene
//! file, with its disabled pairs, before those that are listed. A pose that is missing is that of the scene; for a listed object, the
//! identity.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use ocb_core::configuration::Configuration;
use ocb_core::mesh::{self, MAX_BYTES};
use ocb_core::scene::{Geometry, Scene};
use ocb_core::workload::{Answered, Kind, Recorded};
use ocb_sandbox::given;
use serde::Deserialize;

use super::{About, Recording, object};
use crate::configurations::{Matrix, read_file, rotations};
use crate::scene_file::SceneFile;
use crate::{LabError, Result};

type Found<T> = std::result::Result<T, String>;

/// What the recording says of where it comes from.
const RECORDER: &str = "ocb record --poses";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// The program that asked.
    #[serde(default = "unnamed")]
    program: String,
    /// The library that answered.
    #[serde(default)]
    library: String,
    /// A scene file, whose objects come first.
    scene: Option<PathBuf>,
    /// Of the scene, or more of them.
    #[serde(default)]
    objects: Vec<Object>,
    queries: Vec<Asked>,
}

fn unnamed() -> String {
    "poses".to_owned()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Object {
    name: String,
    /// A mesh in any format that is read.
    file: Option<PathBuf>,
    /// A shape instead.
    geometry: Option<Geometry>,
    /// The mesh is a solid body.
    #[serde(default)]
    solid: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// Names.
    objects: [String; 2],
    query: Kind,
    /// The length of a tolerance, or the most contacts.
    limit: Option<f64>,
    pose_a: Option<Matrix>,
    pose_b: Option<Matrix>,
    /// What belongs together has the same number; each query is its own group where it is missing.
    group: Option<u64>,
    hit: Option<bool>,
    distance: Option<f64>,
    seconds: Option<f64>,
}

/// The recording of this JSON file.
///
/// # Errors
/// `Invalid`, with one sentence, for a file that is none, names objects that are missing, or holds matrices that are no rotations.
pub fn from_json(bytes: &[u8], folder: &Path) -> Result<Recording> {
    let bad = |why: String| LabError::Invalid(format!("These are no queries with poses: {why}."));
    let written: Written = serde_json::from_slice(bytes).map_err(|e| bad(e.to_string()))?;
    recorded(written, folder).map_err(bad)
}

/// The recording of one pair of files in the poses of a configuration file, all asked the same.
///
/// # Errors
/// `Invalid`, with one sentence, for files that are no objects or no configurations.
pub fn from_pair([a, b]: [&Path; 2], poses: &[u8], query: Kind) -> Result<Recording> {
    let bad = |why: String| LabError::Invalid(format!("These poses are no recording: {why}."));
    let poses = read_file(poses)?.poses;
    let name = |path: &Path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let names = if a == b { [format!("{} A", name(a)), format!("{} B", name(b))] } else { [name(a), name(b)] };
    let of_file = |name: &String, file: &Path| Object {
        name: name.clone(),
        file: Some(file.to_owned()),
        geometry: None,
        solid: false,
    };
    let objects = vec![of_file(&names[0], a), of_file(&names[1], b)];
    let scene = with(empty(), names.join(" and "), objects, Path::new("")).map_err(bad)?;
    let query = |(number, configuration)| Recorded {
        sequence: number,
        group: number,
        objects: [0, 1],
        configuration,
        kind: query,
        limit: usual_limit(query),
        answered: Answered::default(),
        seconds: None,
        library: 0,
    };
    finish(scene, String::new(), (0..).zip(poses).map(query).collect()).map_err(bad)
}

fn recorded(written: Written, folder: &Path) -> Found<Recording> {
    let Written { program, library, scene, objects, queries } = written;
    let known = match scene {
        Some(file) => {
            SceneFile::read(&folder.join(file)).map_err(|e| e.to_string().trim_end_matches('.').to_owned())?
        }
        None => empty(),
    };
    let scene = with(known, program, objects, folder)?;
    let all = &scene.scene.objects;
    let numbers: HashMap<String, u32> = (0..).zip(all).map(|(number, it)| (it.name.clone(), number)).collect();
    let pose = |matrix: Option<Matrix>, object: u32| matrix.map_or(Ok(all[object as usize].pose), Matrix::pose);
    let (mut recorded, mut poses) = (Vec::with_capacity(queries.len()), Vec::with_capacity(queries.len()));
    for (number, asked) in (0..).zip(queries) {
        let place = |why: String| format!("query {}: {why}", number + 1);
        let found = |name: &String| numbers.get(name).copied().ok_or_else(|| format!("there is no object {name:?}"));
        let [a, b] = &asked.objects;
        let objects = [found(a).map_err(place)?, found(b).map_err(place)?];
        if objects[0] == objects[1] {
            return Err(place(format!("{a:?} is asked about itself; list it twice under two names")));
        }
        let lengths = [asked.limit, asked.seconds];
        if lengths.into_iter().flatten().any(|it| !(it.is_finite() && it >= 0.0)) {
            return Err(place("`limit` and `seconds` are 0 or more".into()));
        }
        let pose_a = pose(asked.pose_a, objects[0]).map_err(place)?;
        let pose_b = pose(asked.pose_b, objects[1]).map_err(place)?;
        poses.push(Configuration { pose_a, pose_b });
        recorded.push(Recorded {
            sequence: number,
            group: asked.group.unwrap_or(number),
            objects,
            configuration: Configuration { pose_a, pose_b },
            kind: asked.query,
            limit: asked.limit.unwrap_or_else(|| usual_limit(asked.query)),
            answered: Answered { hit: asked.hit, distance: asked.distance },
            seconds: asked.seconds,
            library: 0,
        });
    }
    for (query, configuration) in recorded.iter_mut().zip(rotations(poses)?.poses) {
        query.configuration = configuration;
    }
    finish(scene, library, recorded)
}

/// One contact, where nobody says how many.
fn usual_limit(query: Kind) -> f64 {
    if query == Kind::Contacts { 1.0 } else { 0.0 }
}

fn empty() -> SceneFile {
    let scene = Scene { name: String::new(), objects: Vec::new(), disabled: Vec::new() };
    SceneFile { scene, meshes: HashMap::new() }
}

/// The scene under this name, with these objects behind its own.
fn with(known: SceneFile, name: String, objects: Vec<Object>, folder: &Path) -> Found<SceneFile> {
    let SceneFile { mut scene, mut meshes } = known;
    scene.name = name;
    for Object { name, file, geometry, solid } in objects {
        let place = |why: String| format!("object {name:?}: {why}");
        let (geometry, source) = match (file, geometry) {
            (Some(file), None) => {
                let shown = file.display().to_string();
                let unread = |why: &dyn std::fmt::Display| place(format!("{shown} cannot be read ({why})"));
                let bytes = given::read(&folder.join(&file), MAX_BYTES as u64).map_err(|e| unread(&e))?;
                let mesh = mesh::read(&bytes).map_err(|e| unread(&e))?.mesh;
                let Geometry::Mesh { sha256, .. } = SceneFile::keep(&mut meshes, mesh) else {
                    return Err(place("a mesh is kept as a mesh".into()));
                };
                (Geometry::Mesh { sha256, solid }, shown)
            }
            (None, Some(geometry)) if !matches!(geometry, Geometry::Mesh { .. }) => (geometry, String::new()),
            _ => return Err(place("it has either a file with its mesh or the geometry of another shape".into())),
        };
        scene.objects.push(object(name, geometry, source));
    }
    scene.check().map_err(|why| why.to_string())?;
    Ok(SceneFile { scene, meshes })
}

fn finish(scene: SceneFile, library: String, queries: Vec<Recorded>) -> Found<Recording> {
    if queries.is_empty() {
        return Err("there is no query".into());
    }
    let library = if library.is_empty() { "unknown".to_owned() } else { library };
    let about = About {
        program: scene.scene.name.clone(),
        recorder: RECORDER.to_owned(),
        libraries: vec![library],
        seen: queries.len() as u64,
        dropped: Vec::new(),
    };
    Ok(Recording { scene, about, queries })
}
