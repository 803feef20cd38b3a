//! Makes one recording of the spools that the processes of a program wrote.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_core::scene::{Geometry, Scene, SceneObject};
use ocb_core::workload::Recorded;

use super::spool::{self, Spool};
use super::{About, Dropped, Recording, object};
use crate::scene_file::SceneFile;
use crate::{LabError, Result};

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

/// Makes a recording of a spool, or of all spools in a folder: one for each process, whose queries follow those of the process
/// before it by name. Objects of several processes that are the same become one.
///
/// # Errors
/// `Invalid`, with one sentence, for a folder that is and holds no spool, and where no query was recorded.
pub fn pack(folder: &Path, to: &Path) -> Result<Packed> {
    let recording = read(folder).map_err(|why| {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        LabError::Invalid(format!("{name:?} holds no recording: {why}."))
    })?;
    recording.write(to)?;
    Ok(recording.packed())
}

fn read(folder: &Path) -> std::result::Result<Recording, String> {
    let mut merged = Merged::default();
    for folder in spools(folder)? {
        merged.add(spool::read(&folder)?)?;
    }
    merged.finish()
}

/// The folder itself, or those in it.
fn spools(folder: &Path) -> std::result::Result<Vec<PathBuf>, String> {
    let is_spool = |path: &PathBuf| path.join(spool::ABOUT).exists();
    let entries = fs::read_dir(folder).map_err(|e| format!("it cannot be read ({e})"))?;
    let mut inside: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).filter(is_spool).collect();
    inside.sort();
    Ok(if inside.is_empty() { vec![folder.to_owned()] } else { inside })
}

#[derive(Default)]
struct Merged {
    programs: Vec<String>,
    recorders: Vec<String>,
    libraries: Vec<String>,
    objects: Vec<SceneObject>,
    meshes: HashMap<String, Arc<Mesh>>,
    /// Numbers of the objects that are described by the same words, in their order in a spool.
    known: HashMap<[String; 4], Vec<u32>>,
    names: HashSet<String>,
    queries: Vec<Recorded>,
    dropped: Vec<Dropped>,
}

impl Merged {
    fn add(&mut self, spool: Spool) -> std::result::Result<(), String> {
        let Spool { folder, head, objects, queries, dropped } = spool;
        for (list, word) in [(&mut self.programs, head.program), (&mut self.recorders, head.recorder)] {
            if !word.is_empty() && !list.contains(&word) {
                list.push(word);
            }
        }
        for Dropped { reason, count } in dropped {
            match self.dropped.iter_mut().find(|known| known.reason == reason) {
                Some(known) => known.count += count,
                None => self.dropped.push(Dropped { reason, count }),
            }
        }
        let mut libraries: Vec<String> = Vec::new();
        let mut numbers = Vec::with_capacity(objects.len());
        let mut taken: HashMap<[String; 4], usize> = HashMap::new();
        // A recorder may write its PLY files in its own way.
        let mut read: HashMap<String, Geometry> = HashMap::new();
        for (id, mut line) in objects.into_iter().enumerate() {
            if let Geometry::Mesh { sha256, .. } = &line.geometry {
                let kept = match read.get(sha256) {
                    Some(kept) => kept.clone(),
                    None => {
                        let mesh = spool::mesh_of(&folder, sha256).map_err(|why| format!("object {id}: {why}"))?;
                        let kept = SceneFile::keep(&mut self.meshes, mesh);
                        read.insert(sha256.clone(), kept.clone());
                        kept
                    }
                };
                line.geometry = kept;
            }
            let library = line.library();
            if !libraries.contains(&library) {
                libraries.push(library.clone());
            }
            let key = [line.name.clone(), format!("{:?}", line.geometry), line.source.clone(), library];
            let place = taken.entry(key.clone()).or_default();
            let number = match self.known.get(&key).and_then(|all| all.get(*place)) {
                Some(number) => *number,
                None => {
                    let number = self.object(line);
                    self.known.entry(key).or_default().push(number);
                    number
                }
            };
            *place += 1;
            numbers.push(number);
        }
        let libraries: Vec<u32> = libraries.into_iter().map(|library| self.library(library)).collect();
        self.follow(queries, &numbers, &libraries);
        Ok(())
    }

    /// Takes an object under a name of its own; gives its number.
    fn object(&mut self, line: spool::Line) -> u32 {
        let spool::Line { name, geometry, source, .. } = line;
        let number = self.objects.len();
        let mut name = if name.is_empty() { format!("object {number}") } else { name };
        if !self.names.insert(name.clone()) {
            name = format!("{name} #{number}");
            self.names.insert(name.clone());
        }
        self.objects.push(object(name, geometry, source));
        number as u32
    }

    fn library(&mut self, library: String) -> u32 {
        let known = self.libraries.iter().position(|known| *known == library);
        known.unwrap_or_else(|| {
            self.libraries.push(library);
            self.libraries.len() - 1
        }) as u32
    }

    /// Takes queries behind those that are there.
    fn follow(&mut self, queries: Vec<Recorded>, numbers: &[u32], libraries: &[u32]) {
        let behind = |of: fn(&Recorded) -> u64| self.queries.iter().map(of).max().map_or(0, |last| last + 1);
        let (sequence, group) = (behind(|query| query.sequence), behind(|query| query.group));
        self.queries.extend(queries.into_iter().map(|query| Recorded {
            sequence: sequence.saturating_add(query.sequence),
            group: group.saturating_add(query.group),
            objects: query.objects.map(|object| numbers[object as usize]),
            library: libraries.get(query.library as usize).copied().unwrap_or(query.library),
            ..query
        }));
    }

    fn finish(mut self) -> std::result::Result<Recording, String> {
        if self.queries.is_empty() {
            let reasons: Vec<&str> = self.dropped.iter().map(|dropped| dropped.reason.as_str()).collect();
            let why = if reasons.is_empty() { String::new() } else { format!(" (left out: {})", reasons.join("; ")) };
            return Err(format!("no query was recorded{why}"));
        }
        self.dropped.sort_by(|a, b| (b.count, &a.reason).cmp(&(a.count, &b.reason)));
        let seen = self.queries.len() as u64 + self.dropped.iter().map(|dropped| dropped.count).sum::<u64>();
        let program = self.programs.join(", ");
        let scene = Scene { name: program.clone(), objects: self.objects, disabled: Vec::new() };
        scene.check().map_err(|why| why.to_string())?;
        let recorder = self.recorders.join(", ");
        let about = About { program, recorder, libraries: self.libraries, seen, dropped: self.dropped };
        Ok(Recording { scene: SceneFile { scene, meshes: self.meshes }, about, queries: self.queries })
    }
}
