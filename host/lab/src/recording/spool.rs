//! Reading a spool, the folder that a recorder writes. The program that wrote it may have been killed at any moment.

use std::collections::HashMap;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use ocb_core::configuration::Configuration;
use ocb_core::mesh::{self, Mesh};
use ocb_core::pose::Pose;
use ocb_core::scene::Geometry;
use ocb_core::workload::{Answered, Kind, Recorded};
use ocb_sandbox::given;
use serde::Deserialize;

use super::Dropped;
use crate::sha256_hex;

/// What says that a folder is a spool.
pub const ABOUT: &str = "about.json";
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

/// What a recorder wrote in one process.
pub struct Spool {
    /// Where it was written.
    pub folder: PathBuf,
    /// The recorded program, and what recorded it.
    pub head: Head,
    /// The objects.
    pub objects: Vec<Line>,
    /// In the order in which they were asked.
    pub queries: Vec<Recorded>,
    /// Queries that are not in it, by reason.
    pub dropped: Vec<Dropped>,
}

/// What a spool says of itself.
#[derive(Deserialize)]
pub struct Head {
    format: String,
    #[serde(default)]
    pub program: String,
    #[serde(default)]
    pub recorder: String,
}

/// An object as a recorder writes it.
#[derive(Deserialize)]
pub struct Line {
    id: u32,
    #[serde(default)]
    pub name: String,
    pub geometry: Geometry,
    #[serde(default)]
    pub source: String,
    #[serde(default)]
    library: String,
    #[serde(default)]
    version: String,
}

impl Line {
    /// The library that knows it, with its version.
    pub fn library(&self) -> String {
        format!("{} {}", self.library, self.version).trim().to_owned()
    }
}

/// Reads the spool in a folder; one in which no query was recorded is one, too.
///
/// # Errors
/// Why it cannot be read, without a full stop.
pub fn read(spool: &Path) -> Result<Spool, String> {
    let head: Head = serde_json::from_slice(&bytes(spool, ABOUT, MOST_TEXT)?)
        .map_err(|e| format!("its {ABOUT} cannot be read ({e})"))?;
    if head.format != FORMAT {
        return Err(format!("its format is {:?}, and only {FORMAT:?} can be read", head.format));
    }
    let objects = objects(spool)?;
    let mut dropped = dropped(spool)?;
    let mut queries = Vec::new();
    let mut left_out: HashMap<String, u64> = HashMap::new();
    for row in bytes(spool, "queries.bin", u64::MAX)?.as_chunks::<ROW>().0 {
        match query(row, objects.len()) {
            Ok(query) => queries.push(query),
            Err(why) => *left_out.entry(why).or_default() += 1,
        }
    }
    queries.sort_by_key(|query| query.sequence);
    dropped.extend(left_out.into_iter().map(|(reason, count)| Dropped { reason, count }));
    Ok(Spool { folder: spool.to_owned(), head, objects, queries, dropped })
}

/// A file of the spool; one that is not there is empty.
fn bytes(spool: &Path, name: &str, most: u64) -> Result<Vec<u8>, String> {
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
fn lines(spool: &Path, name: &str) -> Result<Vec<String>, String> {
    let text = String::from_utf8_lossy(&bytes(spool, name, MOST_TEXT)?).into_owned();
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    Ok(whole.lines().filter(|line| !line.trim().is_empty()).map(str::to_owned).collect())
}

fn objects(spool: &Path) -> Result<Vec<Line>, String> {
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
fn dropped(spool: &Path) -> Result<Vec<Dropped>, String> {
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

/// The mesh of this hash.
pub fn mesh_of(spool: &Path, sha256: &str) -> Result<Mesh, String> {
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
fn query(row: &[u8; ROW], objects: usize) -> Result<Recorded, String> {
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
