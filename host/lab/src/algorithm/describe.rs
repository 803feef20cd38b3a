//! What a plugin file says of itself, and what its code was made of.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use ocb_sandbox::{Build, Descriptor, Ending, Launcher, Policy};

use super::Runner;
use crate::model::{AlgorithmInfo, BuildInfo, ParameterInfo};
use crate::{LabError, Result, sha256_hex};

impl Runner {
    /// The hash under which a description is kept: that of the file, and of which libraries it brings, by size and time.
    pub fn known_as(&self, file: &Path, sha256: &str) -> Result<String> {
        let trusted = self.trusts(file);
        let launcher = Launcher::new(self.program.clone(), Policy { trusted, ..Policy::default() });
        let brought = launcher.brought(file).map_err(invalid)?;
        if brought.is_empty() {
            return Ok(sha256.to_owned());
        }
        let said = |library: &PathBuf| {
            let about = fs::metadata(library).map(|about| (about.len(), about.mtime(), about.mtime_nsec()));
            format!("{} {about:?}", library.display())
        };
        Ok(sha256_hex(brought.iter().map(said).fold(sha256.to_owned(), |all, one| format!("{all}\n{one}")).as_bytes()))
    }

    /// What the file with this hash says of itself, asked in the jail.
    pub fn describe(&self, file: &Path, sha256: &str, trusted: bool) -> Result<Vec<AlgorithmInfo>> {
        let policy = Policy { trusted, profile: self.profile, ..Policy::default() };
        let alone = Launcher::new(self.program.clone(), policy.clone());
        // What is made for several threads may need a library that is for their track only.
        let threaded = Launcher::new(self.program.clone(), Policy { threads: 2, ..policy });
        let refused = |first: Ending| threaded.describe(file).map_err(|_| invalid(first));
        let descriptors = alone.describe(file).or_else(refused)?;
        let builds = builds(&alone, file)?;
        Ok(descriptors.into_iter().map(|d| info(d, sha256, builds.clone())).collect())
    }
}

fn invalid(ending: Ending) -> LabError {
    LabError::Invalid(ending.to_string())
}

/// How the file and what it brings were compiled. Nothing of the plugin runs for that, so what fails here is ours.
pub fn builds(launcher: &Launcher, file: &Path) -> Result<Vec<BuildInfo>> {
    let found = launcher.builds(file).map_err(|ending| LabError::Fault(ending.to_string()))?;
    let info =
        |(file, Build { compilers, flags, instruction_sets })| BuildInfo { file, compilers, flags, instruction_sets };
    Ok(found.into_iter().map(info).collect())
}

/// What a descriptor says, for the pages.
pub fn info(d: Descriptor, plugin_sha256: &str, builds: Vec<BuildInfo>) -> AlgorithmInfo {
    let parameter = |p: ocb_sandbox::Parameter| ParameterInfo {
        name: p.name,
        description: p.description,
        minimum: p.minimum,
        maximum: p.maximum,
        default: p.default,
        integer: p.integer,
    };
    AlgorithmInfo {
        id: d.id,
        name: d.name,
        version: d.version,
        authors: d.authors,
        license: d.license,
        url: d.url,
        paper: d.paper,
        queries: d.queries,
        counters: d.counters,
        witness_points: d.witness_points,
        single_precision: d.single_precision,
        solid: d.solid,
        coherent: d.coherent,
        threads: d.threads,
        scene: d.scene,
        usual: false,
        parameters: d.parameters.into_iter().map(parameter).collect(),
        plugin_sha256: plugin_sha256.to_owned(),
        builds,
    }
}
