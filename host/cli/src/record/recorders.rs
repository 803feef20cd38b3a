//! What records: libraries that are loaded before those of a program, and a package for Python.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use crate::failure::{Failure, Result};

/// The libraries that are loaded first, with what they record.
const PRELOADED: [(&str, &str); 2] =
    [("libocb_record_fcl.so", "FCL (libfcl)"), ("libocb_record_coal.so", "Coal (libcoal)")];

/// The recorders beside this program.
pub struct Recorders {
    folder: PathBuf,
    preloaded: Vec<(PathBuf, &'static str)>,
}

impl Recorders {
    /// Finds them in the folder `record`.
    ///
    /// # Errors
    /// When the folder is not there, or has a name that the loader of programs cannot take.
    pub fn find() -> Result<Self> {
        let program = std::env::current_exe().map_err(|e| Failure::Fault(format!("cannot find this program: {e}.")))?;
        let folder = program.with_file_name("record");
        if !folder.join("python").is_dir() {
            return Err(Failure::Input(format!(
                "The recorders are missing: there is no folder {}; build them with `make recorders`.",
                folder.display()
            )));
        }
        if folder.as_os_str().as_bytes().iter().any(|byte| b": ".contains(byte)) {
            return Err(Failure::Input(format!(
                "The recorders cannot be loaded from {}; move this program to a folder without spaces and colons.",
                folder.display()
            )));
        }
        let preloaded = PRELOADED.iter().map(|(file, what)| (folder.join(file), *what));
        let preloaded: Vec<_> = preloaded.filter(|(path, _)| path.exists()).collect();
        Ok(Self { folder, preloaded })
    }

    /// What they see, for a message.
    pub fn seen(&self) -> String {
        let preloaded = self.preloaded.iter().map(|(_, what)| *what);
        preloaded.chain(["python-fcl", "coal and mujoco in Python"]).collect::<Vec<_>>().join(", ")
    }

    /// Variables that make a program load them.
    pub fn environment(&self) -> Vec<(&'static str, OsString)> {
        let libraries: Vec<&Path> = self.preloaded.iter().map(|(path, _)| path.as_path()).collect();
        let python = self.folder.join("python");
        [("LD_PRELOAD", libraries), ("PYTHONPATH", vec![python.as_path()])]
            .into_iter()
            .filter(|(_, paths)| !paths.is_empty())
            .map(|(name, paths)| (name, before(&paths, std::env::var_os(name))))
            .collect()
    }
}

/// These paths, then what was there.
fn before(paths: &[&Path], there: Option<OsString>) -> OsString {
    let mut all: Vec<&OsStr> = paths.iter().map(|path| path.as_os_str()).collect();
    let there = there.filter(|there| !there.is_empty());
    all.extend(there.as_deref());
    all.join(OsStr::new(":"))
}
