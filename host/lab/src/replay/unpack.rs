//! Reading an archive that somebody gives us: nothing of it is believed before it is bounded and its hash has been found.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use ocb_core::configuration::Configuration;
use ocb_core::instance;
use ocb_core::mesh::MAX_BYTES;
use ocb_sandbox::given;
use zip::ZipArchive;

use super::{FORMAT, RECIPE};
use crate::columns::{AnswerRow, read_answers, read_poses};
use crate::model::{Recipe, RecipeAlgorithm, RecipeFile, RecipeObject};
use crate::sha256_hex;
use crate::{LabError, Result};

/// Files of an archive.
const MOST_FILES: usize = 500;
/// Bytes of the recipe, of a file and of all of them.
const MOST_RECIPE: u64 = 4 << 20;
const MOST_FILE: u64 = MAX_BYTES as u64;
const MOST_BYTES: u64 = 2 << 30;

/// An archive, read as a whole: every file is what the recipe says.
pub struct Unpacked {
    /// What it says of itself.
    pub recipe: Recipe,
    /// Poses of the configurations.
    pub poses: Vec<Configuration>,
    files: BTreeMap<String, Vec<u8>>,
}

impl Unpacked {
    /// Reads the archive in this file.
    ///
    /// # Errors
    /// `Invalid`, with one sentence, for whatever is no archive of ours.
    pub fn read(path: &Path) -> Result<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        read(path).map_err(|why| LabError::Invalid(format!("{name:?} cannot be replayed: {why}.")))
    }

    /// The answers of an algorithm.
    pub fn answers(&self, of: &RecipeAlgorithm) -> Result<Vec<AnswerRow>> {
        let bad = |why: String| LabError::Invalid(format!("The answers of {:?} cannot be read: {why}.", of.id));
        let rows = read_answers(&self.files[&of.answers]).map_err(bad)?;
        match rows.iter().find(|row| row.configuration as usize >= self.poses.len()) {
            Some(row) => Err(bad(format!("it has no configuration {}", row.configuration))),
            None => Ok(rows),
        }
    }

    /// The OBJ file of an object, if it came with one.
    pub fn object(&self, of: &RecipeObject) -> Option<&[u8]> {
        of.file.as_ref().map(|path| &self.files[path][..])
    }

    /// The file of an algorithm's plugin, if it came with it.
    pub fn plugin(&self, of: &RecipeAlgorithm) -> Option<&[u8]> {
        of.plugin.as_ref().map(|path| &self.files[path][..])
    }
}

fn read(path: &Path) -> std::result::Result<Unpacked, String> {
    let file = given::open(path).map_err(|e| format!("it cannot be opened ({e})"))?;
    let mut zip = ZipArchive::new(file).map_err(|e| format!("it is not a zip archive ({e})"))?;
    if zip.len() > MOST_FILES + 1 || zip.has_duplicate_names() {
        return Err(format!("it has a file twice, or more than {MOST_FILES} files"));
    }
    let recipe = taken(&mut zip, RECIPE, MOST_RECIPE, None)?;
    let recipe = recipe_of(&recipe)?;
    let known = |path: &str| path == RECIPE || recipe.files.iter().any(|file| file.path == path);
    for name in zip.file_names() {
        let name = name.map_err(|_| "a file name in it is not valid text".to_owned())?;
        if !known(&name) {
            return Err(format!("it contains the file {name:?}, which {RECIPE} does not list"));
        }
    }
    let mut files = BTreeMap::new();
    for RecipeFile { path, bytes, sha256 } in &recipe.files {
        let content = taken(&mut zip, path, MOST_FILE, Some(*bytes))?;
        if sha256_hex(&content) != *sha256 {
            return Err(format!("{path:?} in it does not match {RECIPE}: its SHA-256 differs"));
        }
        files.insert(path.clone(), content);
    }
    let missing = [&recipe.configurations]
        .into_iter()
        .chain(recipe.objects.iter().filter_map(|object| object.file.as_ref()))
        .chain(recipe.algorithms.iter().flat_map(|a| [&a.answers].into_iter().chain(&a.plugin)))
        .find(|path| !files.contains_key(*path))
        .cloned();
    if let Some(missing) = missing {
        return Err(format!("{RECIPE} refers to the file {missing:?} but does not list it"));
    }
    let poses =
        read_poses(&files[&recipe.configurations]).map_err(|e| format!("{:?} in it: {e}", recipe.configurations))?;
    Ok(Unpacked { recipe, poses, files })
}

/// A file of the archive, of so many bytes at most: no more of it is unpacked, whatever its head says.
fn taken(
    zip: &mut ZipArchive<File>,
    path: &str,
    most: u64,
    exactly: Option<u64>,
) -> std::result::Result<Vec<u8>, String> {
    let entry = zip.by_name(path).map_err(|e| format!("the file {path:?} in it cannot be read ({e})"))?;
    if !entry.is_file() {
        return Err(format!("{path:?} in it is not a regular file"));
    }
    let length = exactly.unwrap_or(entry.size());
    if length > most {
        return Err(format!("{path:?} in it has {length} bytes, more than {most}"));
    }
    let mut content = Vec::new();
    entry.take(length + 1).read_to_end(&mut content).map_err(|e| format!("{path:?} in it is damaged ({e})"))?;
    if content.len() as u64 != length {
        return Err(format!("{path:?} in it does not have the {length} bytes declared"));
    }
    Ok(content)
}

fn recipe_of(bytes: &[u8]) -> std::result::Result<Recipe, String> {
    let value: serde_json::Value =
        serde_json::from_slice(bytes).map_err(|e| format!("{RECIPE} in it is not valid JSON ({e})"))?;
    let format = value["format"].as_u64();
    if format != Some(u64::from(FORMAT)) {
        let said = format.map_or_else(|| "none".to_owned(), |format| format.to_string());
        return Err(format!("its format is {said}, but this program reads format {FORMAT}"));
    }
    let recipe: Recipe = serde_json::from_value(value).map_err(|e| format!("{RECIPE} in it is not valid ({e})"))?;
    let ours = instance::VERSION;
    if recipe.versions.instances != ours {
        let (theirs, version) = (recipe.versions.instances, &recipe.version);
        return Err(format!(
            "it was measured with instances of version {theirs}, but this program creates version {ours}; use ocb \
             {version}"
        ));
    }
    if let Some(file) = recipe.files.iter().find(|file| !is_plain(&file.path)) {
        return Err(format!("{:?} is not a path inside an archive", file.path));
    }
    let all = recipe.files.iter().fold(0, |sum: u64, file| sum.saturating_add(file.bytes));
    if recipe.files.len() > MOST_FILES || all > MOST_BYTES {
        return Err(format!("it would unpack to {} files of {all} bytes", recipe.files.len()));
    }
    if recipe.objects.is_empty() || recipe.objects.len() > 2 {
        return Err("a run has one object or two".to_owned());
    }
    Ok(recipe)
}

/// Names one below the other; nothing is ever written under them, but nobody else may come to harm either.
fn is_plain(path: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-@=+".contains(c);
    path.split('/').all(|part| !part.is_empty() && !part.starts_with('.') && part.chars().all(plain))
}

#[cfg(test)]
mod tests;
