//! Writing an archive.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{FORMAT, RECIPE};
use crate::model::{Recipe, RecipeFile};
use crate::sha256_hex;
use crate::{LabError, Result};

/// What a person finds in the archive.
const READ_ME: &str = "The answers of a collision detection benchmark, with everything that determines them.\n\n\
    ocb replay FILE.zip   repeats every query in a jail and compares every answer bit by bit\n\n\
    recipe.json             queries, seed, versions, objects, algorithms, and the hash of every file\n\
    configurations.parquet  poses and certified truth\n\
    answers/*.parquet       one row per answer: time, answer, verdict, and the instance of the query\n\
    objects/*.obj           objects that are not stock objects\n\
    plugins/*.so            plugins whose licences permit redistribution\n";

/// An archive that grows file by file.
pub struct Packing {
    zip: ZipWriter<File>,
    files: Vec<RecipeFile>,
}

impl Packing {
    /// In a file of this folder that has no name, and is gone when it is closed.
    pub fn begin(folder: &Path) -> Result<Self> {
        let file = tempfile::tempfile_in(folder).map_err(fault)?;
        let mut packing = Self { zip: ZipWriter::new(file), files: Vec::new() };
        packing.add("README.txt", READ_ME.as_bytes())?;
        Ok(packing)
    }

    /// Adds a file and gives its path.
    pub fn add(&mut self, path: &str, bytes: &[u8]) -> Result<String> {
        self.write(path, bytes)?;
        let (path, sha256) = (path.to_owned(), sha256_hex(bytes));
        self.files.push(RecipeFile { path: path.clone(), bytes: bytes.len() as u64, sha256 });
        Ok(path)
    }

    /// Is there a file of this path already?
    pub fn has(&self, path: &str) -> bool {
        self.files.iter().any(|file| file.path == path)
    }

    /// Writes the recipe, which gets the list of the files, and gives the archive from its beginning.
    pub fn finish(mut self, recipe: Recipe) -> Result<File> {
        let recipe = Recipe { format: FORMAT, files: std::mem::take(&mut self.files), ..recipe };
        self.write(RECIPE, &serde_json::to_vec_pretty(&recipe).map_err(fault)?)?;
        let mut file = self.zip.finish().map_err(fault)?;
        file.seek(SeekFrom::Start(0)).map_err(fault)?;
        Ok(file)
    }

    /// Without a date, so that the same run gives the same bytes.
    fn write(&mut self, path: &str, bytes: &[u8]) -> Result<()> {
        // Parquet is compressed already.
        let method = if path.ends_with(".parquet") { CompressionMethod::Stored } else { CompressionMethod::Deflated };
        let options = SimpleFileOptions::default().compression_method(method).unix_permissions(0o644);
        self.zip.start_file(path, options).map_err(fault)?;
        self.zip.write_all(bytes).map_err(fault)
    }
}

fn fault(e: impl std::fmt::Display) -> LabError {
    LabError::fault("Packing the archive failed", e)
}
