//! An algorithm that can be measured: what its plugin file says of it, and the settings it was asked for with.
//! A plugin is only ever loaded by the jailed runner, also to read its name.

mod choice;
mod describe;

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use ocb_core::query::{Query, Semantics};
use ocb_sandbox::{Ending, Launcher, Objects, Policy, Profile, Trial, given};

use crate::model::AlgorithmInfo;
use crate::{LabError, Result, sha256_hex};

pub(crate) use describe::{builds, info};

/// Largest plugin file that is looked at, bytes.
const MAX_PLUGIN_BYTES: u64 = 64 << 20;

/// One algorithm and the file that holds it.
#[derive(Clone, Debug)]
pub struct Algorithm {
    /// What it says of itself; the id with the settings that were chosen.
    pub info: AlgorithmInfo,
    /// The id that the plugin knows.
    pub id_in_plugin: String,
    /// Values of parameters that are not the default ones.
    pub settings: Vec<(String, f64)>,
    /// CPUs that it may use; 1 is the single-threaded track.
    pub threads: usize,
    /// The plugin file.
    pub file: PathBuf,
    /// Built from our own sources, beside the runner.
    pub trusted: bool,
}

impl Algorithm {
    /// As it is when nothing is set.
    pub fn plain(info: AlgorithmInfo, file: PathBuf, trusted: bool) -> Self {
        Self { id_in_plugin: info.id.clone(), info, settings: Vec::new(), threads: 1, file, trusted }
    }

    /// The same with the settings that follow its id in a name such as `box-tree:leaf_size=4`; without those that change nothing, in
    /// the declared order.
    pub fn with_settings(&self, settings: &str) -> Result<Self> {
        choice::with_settings(self, settings)
    }

    /// What a process is started for: this algorithm with its settings, on these objects.
    pub fn trial<'a>(&'a self, objects: Objects<'a>, semantics: Semantics) -> Trial<'a> {
        Trial { parameters: &self.settings, semantics, ..Trial::of(&self.file, &self.id_in_plugin, objects) }
    }
}

/// The program that alone loads plugins, and how much of a jail foreign ones need.
#[derive(Clone, Debug)]
pub struct Runner {
    /// The `ocb-runner` binary.
    pub program: PathBuf,
    /// How much of a jail.
    pub profile: Profile,
}

impl Runner {
    /// A launcher for this plugin under the given policy; only our own plugins may run under a weaker jail.
    pub fn launcher(&self, algorithm: &Algorithm, policy: Policy) -> Launcher {
        // What is measured is what was described, and nothing that came to lie there since.
        let plugin_sha256 = Some(algorithm.info.plugin_sha256.clone());
        let trusted = algorithm.trusted;
        Launcher::new(self.program.clone(), Policy { trusted, plugin_sha256, profile: self.profile, ..policy })
    }

    /// The kinds of query that an algorithm answers with its settings: it is asked for them in the jail.
    pub fn queries(&self, algorithm: &Algorithm) -> std::result::Result<Vec<Query>, Ending> {
        let launcher = self.launcher(algorithm, Policy { threads: algorithm.threads, ..Policy::default() });
        launcher.queries(&algorithm.file, &algorithm.id_in_plugin, &algorithm.settings)
    }

    /// A plugin that lies beside the runner was built and installed with it. Links are followed: a link there is no plugin of ours.
    pub fn trusts(&self, file: &Path) -> bool {
        let folder = |path: &Path| path.canonicalize().ok()?.parent().map(Path::to_owned);
        matches!((folder(&self.program), folder(file)), (Some(ours), Some(its)) if ours == its)
    }
}

/// SHA-256 of a plugin file as it is now.
pub fn plugin_hash(file: &Path) -> Result<String> {
    Ok(sha256_hex(&read_plugin(file)?))
}

/// The bytes of a plugin file that is at least an ELF file.
pub fn read_plugin(file: &Path) -> Result<Vec<u8>> {
    // Its folder is nobody's business who reads a report.
    let shown = file.file_name().unwrap_or_default().display();
    let bad = |why: String| LabError::Invalid(format!("{shown} is not a plugin: {why}."));
    let bytes = given::read(file, MAX_PLUGIN_BYTES).map_err(|e| match e.kind() {
        // Their words are sentences of their own.
        ErrorKind::FileTooLarge | ErrorKind::InvalidInput | ErrorKind::IsADirectory => bad(e.to_string()),
        _ => bad(format!("it cannot be read ({e})")),
    })?;
    if !bytes.starts_with(b"\x7fELF") {
        return Err(bad("it is not an ELF file; build a shared library (.so) for Linux".into()));
    }
    Ok(bytes)
}

/// The named files, and the `*.so` of the named folders, by name.
pub fn plugin_files(places: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for place in places {
        if place.is_dir() {
            let entries = fs::read_dir(place).into_iter().flatten().flatten().map(|entry| entry.path());
            let mut here: Vec<PathBuf> =
                entries.filter(|path| path.is_file() && path.extension().is_some_and(|e| e == "so")).collect();
            here.sort();
            files.extend(here);
        } else {
            files.push(place.clone());
        }
    }
    files
}
