//! Reading a spool, the folder that a recorder writes. The program that wrote it may have been killed at any moment.

use std::collections::{HashMap, HashSet};
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::{self, Mesh};
use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, Scene, SceneObject};
use ocb_core::workload::{Answered, Kind, Recorded};
use ocb_sandbox::given;
use serde::Deserialize;

use super::{About, Dropped, Recording};
use crate::scene_file::SceneFile;
use crate::{LabError, Result, sha256_hex};

/// The only format there is.
const FORMAT: &str = "opencollbench-spool/1";
/// Bytes of a query.
const ROW: usize = 256;
/// Limits of a spool, bytes.
const MOST_TEXT: u64 = 64 << 20;
const MOST_MESH: u64 = ocb_core::mesh::MAX_BYTES as u64;
/// Bits of a query.
const ANSWER_KNOWN: u32 = 1;
const HIT: u32 = 2;
const DISTANCE_KNOWN: u32 = 4;

/// What became of a spool.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packed {
    /// Objects of the scene.
    pub objects: usize,
    /// Queries in the recording.
    pub queries: usize,
    /// Queries that the recorder saw.
    pub seen: u64,
    /// Queries that are not in the recording, by reason.
    pub dropped: Vec<Dropped>,
}

#[derive(Deserialize)]
struct Head {
    format: String,
    #[serde(default)]
    program: String,
    #[serde(default)]
    recorder: String,
}

#[derive(Deserialize)]
struct Line {
    id: u32,
    #[serde(default)]
    name: String,
    geometry: Geometry,
    #[serde(default)]
    source: String,
    #[serde(default)]
    library: String,
    #[serde(default)]
    version: String,
}

/// Makes a recording of a spool.
///
/// # Errors
/// `Invalid`, with one sentence, for a folder that is no spool, or in which no query was recorded.
pub fn pack(spool: &Path, to: &Path) -> Result<Packed> {
    let recording = read(spool).map_err(|why| {
        let name = spool.file_name().unwrap_or_default().to_string_lossy().into_owned();
        LabError::Invalid(format!("{name:?} holds no recording: {why}."))
    })?;
    recording.write(to)?;
    let Recording { scene, about, queries } = recording;
    Ok(Packed { objects: scene.scene.objects.len(), queries: queries.len(), seen: about.seen, dropped: about.dropped })
}

fn read(spool: &Path) -> std::result::Result<Recording, String> {
    let head: Head = serde_json::from_slice(&bytes(spool, "about.json", MOST_TEXT)?)
        .map_err(|e| format!("its about.json cannot be read ({e})"))?;
    if head.format != FORMAT {
        return Err(format!("its format is {:?}, and only {FORMAT:?} can be read", head.format));
    }
    let lines = objects(spool)?;
    let mut dropped = dropped(spool)?;
    let mut queries = Vec::new();
    let mut left_out: HashMap<String, u64> = HashMap::new();
    for row in bytes(spool, "queries.bin", u64::MAX)?.as_chunks::<ROW>().0 {
        match query(row, lines.len()) {
            Ok(query) => queries.push(query),
            Err(why) => *left_out.entry(why).or_default() += 1,
        }
    }
    if queries.is_empty() {
        return Err("no query was recorded".into());
    }
    queries.sort_by_key(|query| query.sequence);
    dropped.extend(left_out.into_iter().map(|(reason, count)| Dropped { reason, count }));
    dropped.sort_by(|a, b| (b.count, &a.reason).cmp(&(a.count, &b.reason)));
    let seen = queries.len() as u64 + dropped.iter().map(|dropped| dropped.count).sum::<u64>();
    let mut libraries: Vec<String> = Vec::new();
    for line in &lines {
        let library = format!("{} {}", line.library, line.version).trim().to_owned();
        if !libraries.contains(&library) {
            libraries.push(library);
        }
    }
    let scene = scene(spool, lines, &head.program)?;
    let about = About { program: head.program, recorder: head.recorder, libraries, seen, dropped };
    Ok(Recording { scene, about, queries })
}

/// A file of the spool; one that is not there is empty.
fn bytes(spool: &Path, name: &str, most: u64) -> std::result::Result<Vec<u8>, String> {
    let failed = |e: std::io::Error| format!("its {name} cannot be read ({e})");
    let file = match given::open(&spool.join(name)) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(failed(e)),
    };
    let mut bytes = Vec::new();
    file.take(most.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > most { Err(format!("its {name} has more than {most} bytes")) } else { Ok(bytes) }
}

/// The whole lines of a file; what follows the last of them was being written when the program ended.
fn lines(spool: &Path, name: &str) -> std::result::Result<Vec<String>, String> {
    let text = String::from_utf8_lossy(&bytes(spool, name, MOST_TEXT)?).into_owned();
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    Ok(whole.lines().filter(|line| !line.trim().is_empty()).map(str::to_owned).collect())
}

fn objects(spool: &Path) -> std::result::Result<Vec<Line>, String> {
    let mut all: Vec<Line> = Vec::new();
    for (number, line) in (1..).zip(lines(spool, "objects.jsonl")?) {
        let bad = |why: String| format!("line {number} of its objects.jsonl cannot be used: {why}");
        let line: Line = serde_json::from_str(&line).map_err(|e| bad(e.to_string()))?;
        if line.id as usize != all.len() {
            return Err(bad(format!("its id is {}, not {}", line.id, all.len())));
        }
        all.push(line);
    }
    Ok(all)
}

/// The last line of each reason holds.
fn dropped(spool: &Path) -> std::result::Result<Vec<Dropped>, String> {
    let mut all: Vec<Dropped> = Vec::new();
    for (number, line) in (1..).zip(lines(spool, "dropped.jsonl")?) {
        let line: Dropped = serde_json::from_str(&line)
            .map_err(|e| format!("line {number} of its dropped.jsonl cannot be used: {e}"))?;
        match all.iter_mut().find(|known| known.reason == line.reason) {
            Some(known) => known.count = line.count,
            None => all.push(line),
        }
    }
    Ok(all)
}

/// Every object under a name of its own, with the meshes that they need.
fn scene(spool: &Path, lines: Vec<Line>, program: &str) -> std::result::Result<SceneFile, String> {
    let mut names = HashSet::new();
    let mut meshes: HashMap<String, Arc<Mesh>> = HashMap::new();
    // A recorder may write its PLY files in its own way.
    let mut known: HashMap<String, Geometry> = HashMap::new();
    let mut objects = Vec::with_capacity(lines.len());
    for Line { id, name, mut geometry, source, .. } in lines {
        if let Geometry::Mesh { sha256 } = &geometry {
            let kept = match known.get(sha256) {
                Some(kept) => kept.clone(),
                None => {
                    let mesh = mesh_of(spool, sha256).map_err(|why| format!("object {id}: {why}"))?;
                    let kept = SceneFile::keep(&mut meshes, mesh);
                    known.insert(sha256.clone(), kept.clone());
                    kept
                }
            };
            geometry = kept;
        }
        let mut unique = if name.is_empty() { format!("object {id}") } else { name };
        if !names.insert(unique.clone()) {
            unique = format!("{unique} #{id}");
            names.insert(unique.clone());
        }
        objects.push(SceneObject {
            name: unique,
            link: None,
            geometry,
            pose: Pose::identity(),
            source,
            scale: [1.0; 3],
            licence: None,
        });
    }
    let scene = Scene { name: program.to_owned(), objects, disabled: Vec::new() };
    scene.check().map_err(|why| why.to_string())?;
    Ok(SceneFile { scene, meshes })
}

fn mesh_of(spool: &Path, sha256: &str) -> std::result::Result<Mesh, String> {
    if sha256.len() != 64 || !sha256.bytes().all(|c| c.is_ascii_hexdigit()) {
        return Err("its mesh is not named by a SHA-256".into());
    }
    let bytes = bytes(spool, &format!("objects/{sha256}.ply"), MOST_MESH)?;
    if sha256_hex(&bytes) != sha256 {
        return Err(format!("the mesh objects/{sha256}.ply is missing or damaged"));
    }
    Ok(mesh::read(&bytes).map_err(|e| format!("its mesh cannot be read ({e})"))?.mesh)
}

/// One query, or why it is none.
fn query(row: &[u8; ROW], objects: usize) -> std::result::Result<Recorded, String> {
    let four = |at: usize| u32::from_le_bytes(row[at..at + 4].try_into().expect("four bytes"));
    let eight = |at: usize| u64::from_le_bytes(row[at..at + 8].try_into().expect("eight bytes"));
    let number = |at: usize| f64::from_bits(eight(at));
    let pose = |at: usize| {
        let mut matrix = Pose::identity().to_row_major();
        (0..12).for_each(|i| matrix[i] = number(at + 8 * i));
        Pose::from_row_major(&matrix).map_err(|_| "a pose is not finite".to_owned())
    };
    let objects_of = [four(16), four(20)];
    if objects_of.into_iter().any(|id| id as usize >= objects) {
        return Err("an object was not recorded".into());
    }
    let (kind, bits) = (four(216), four(220));
    let kind = Kind::NAMES.get(kind as usize).ok_or("the kind of query is unknown")?.0;
    let finite = |x: f64| x.is_finite().then_some(x);
    Ok(Recorded {
        sequence: eight(0),
        group: eight(8),
        objects: objects_of,
        configuration: Configuration { pose_a: pose(24)?, pose_b: pose(120)? },
        kind,
        limit: finite(number(224)).ok_or("the limit of a query is not finite")?,
        answered: Answered {
            hit: (bits & ANSWER_KNOWN != 0).then_some(bits & HIT != 0),
            distance: finite(number(232)).filter(|_| bits & DISTANCE_KNOWN != 0),
        },
        seconds: finite(number(240)).filter(|seconds| *seconds >= 0.0),
        library: four(248),
    })
}
