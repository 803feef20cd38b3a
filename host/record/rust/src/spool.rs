//! The folder that is written: it only grows, and can be read at any moment, also after the program was killed. Each query is one
//! write of one row, files of meshes and counts are there as a whole or not at all, and of objects the last whole line counts.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};

use crate::query::{ROW, Row};
use crate::{Error, Refusal, Shape};

/// Bounds of a spool: objects, and bytes of their meshes.
const MOST_OBJECTS: usize = 20_000;
const MOST_MESH_BYTES: u64 = 4 << 30;
/// Time between two notes of how many queries were left out for known reasons.
const NOTED: Duration = Duration::from_millis(200);
/// The reason for queries of groups that were not kept.
const SAMPLED: &str = "sampled";

/// The spool in one folder, for one thread at a time.
pub(crate) struct Spool {
    folder: PathBuf,
    /// The end of every line of an object: the library.
    library: String,
    queries: File,
    /// Most queries that are kept, how many are, and how many were counted.
    pub limit: u64,
    rows: u64,
    seen: u64,
    /// Only groups whose number this divides are kept.
    every: u64,
    objects: HashMap<String, u32>,
    meshes: HashSet<String>,
    mesh_bytes: u64,
    left_out: BTreeMap<&'static str, u64>,
    noted: Instant,
}

impl Spool {
    /// Makes the folder, which must not exist.
    pub fn create(folder: &Path, program: &str, library: &str, version: &str) -> Result<Self, Error> {
        for path in [folder, &folder.join("objects")] {
            fs::create_dir(path).map_err(failed(path))?;
        }
        let about = format!(
            "{{\"format\": \"opencollbench-spool/1\", \"program\": {}, \"recorder\": \"opencollbench-record (Rust)\"}}\n",
            json(program)
        );
        write_whole(&folder.join("about.json"), about.as_bytes())?;
        Ok(Self {
            queries: append_to(&folder.join("queries.bin"))?,
            folder: folder.to_owned(),
            library: format!("\"library\": {}, \"version\": {}}}\n", json(library), json(version)),
            limit: u64::MAX,
            rows: 0,
            seen: 0,
            every: 1,
            objects: HashMap::new(),
            meshes: HashSet::new(),
            mesh_bytes: 0,
            left_out: BTreeMap::new(),
            noted: Instant::now(),
        })
    }

    /// The number of an object; equal objects of one name are one object.
    pub fn object(&mut self, name: &str, shape: &Shape<'_>) -> Result<u32, Error> {
        let geometry = shape.geometry(|ply| self.mesh(ply))?;
        let rest = format!("\"name\": {}, \"geometry\": {geometry}, \"source\": \"\", {}", json(name), self.library);
        if let Some(known) = self.objects.get(&rest) {
            return Ok(*known);
        }
        let number = self.objects.len();
        if number >= MOST_OBJECTS {
            return Err(Refusal::TooManyObjects.into());
        }
        let path = self.folder.join("objects.jsonl");
        let line = format!("{{\"id\": {number}, {rest}");
        append_to(&path)?.write_all(line.as_bytes()).map_err(failed(&path))?;
        self.objects.insert(rest, number as u32);
        Ok(number as u32)
    }

    fn mesh(&mut self, ply: &[u8]) -> Result<String, Error> {
        let sha256: String = Sha256::digest(ply).iter().map(|byte| format!("{byte:02x}")).collect();
        if !self.meshes.contains(&sha256) {
            let bytes = self.mesh_bytes + ply.len() as u64;
            if bytes > MOST_MESH_BYTES {
                return Err(Refusal::TooManyBytes.into());
            }
            write_whole(&self.folder.join(format!("objects/{sha256}.ply")), ply)?;
            self.mesh_bytes = bytes;
            self.meshes.insert(sha256.clone());
        }
        Ok(format!(r#"{{"kind": "mesh", "sha256": "{sha256}"}}"#))
    }

    /// Adds a query of this group, or counts why it has no row.
    pub fn query(&mut self, group: u64, row: Result<Row, Refusal>) -> Result<(), Error> {
        let sequence = self.seen;
        self.seen += 1;
        if !group.is_multiple_of(self.every) {
            return self.leave_out(SAMPLED);
        }
        let mut row = match row {
            Ok(row) => row,
            Err(refusal) => {
                self.leave_out(refusal.reason())?;
                return Err(refusal.into());
            }
        };
        if self.rows >= self.limit {
            self.thin()?;
            if !group.is_multiple_of(self.every) {
                return self.leave_out(SAMPLED);
            }
            if self.rows >= self.limit {
                return self.leave_out("a group has more queries than the limit");
            }
        }
        row.follow(sequence);
        self.queries.write_all(&row.0).map_err(failed(&self.folder.join("queries.bin")))?;
        self.rows += 1;
        Ok(())
    }

    /// Counts a query that has no row.
    fn leave_out(&mut self, reason: &'static str) -> Result<(), Error> {
        let count = self.left_out.entry(reason).or_default();
        *count += 1;
        if *count > 1 && self.noted.elapsed() < NOTED {
            return Ok(());
        }
        self.note()
    }

    /// Writes down how many queries were left out.
    pub fn note(&mut self) -> Result<(), Error> {
        self.noted = Instant::now();
        let line = |(reason, count): (&&str, &u64)| format!("{{\"reason\": {}, \"count\": {count}}}\n", json(reason));
        let lines: String = self.left_out.iter().map(line).collect();
        write_whole(&self.folder.join("dropped.jsonl"), lines.as_bytes())
    }

    /// Keeps the queries of every second group of those that are kept, until half of the limit is free or one group is left.
    fn thin(&mut self) -> Result<(), Error> {
        let path = self.folder.join("queries.bin");
        let bytes = fs::read(&path).map_err(failed(&path))?;
        let mut rows: Vec<&[u8; ROW]> = bytes.as_chunks().0.iter().collect();
        let before = rows.len();
        while rows.len() as u64 > self.limit / 2 && rows.iter().any(|row| Row::group(row) != Row::group(rows[0])) {
            self.every = self.every.saturating_mul(2);
            rows.retain(|row| Row::group(row).is_multiple_of(self.every));
        }
        if rows.len() == before {
            return Ok(());
        }
        let kept: Vec<u8> = rows.iter().flat_map(|row| row.iter().copied()).collect();
        write_whole(&path, &kept)?;
        self.queries = append_to(&path)?;
        self.rows = rows.len() as u64;
        *self.left_out.entry(SAMPLED).or_default() += (before - rows.len()) as u64;
        self.note()
    }
}

/// A text in JSON, without control characters.
fn json(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        if matches!(c, '"' | '\\') {
            quoted.push('\\');
        }
        quoted.push(if c.is_control() { '?' } else { c });
    }
    quoted.push('"');
    quoted
}

/// What happened to a file of the spool.
fn failed(path: &Path) -> impl FnOnce(std::io::Error) -> Error {
    let path = path.to_owned();
    move |source| Error::File { path, source }
}

fn append_to(path: &Path) -> Result<File, Error> {
    OpenOptions::new().append(true).create(true).open(path).map_err(failed(path))
}

/// The file is there as a whole or not at all.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let part = path.with_added_extension("new");
    fs::write(&part, bytes).map_err(failed(&part))?;
    fs::rename(&part, path).map_err(failed(path))
}
