//! Where the repository, the built programs and the shared test data are.

use std::path::{Path, PathBuf};

/// The top of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the repository").to_path_buf()
}

/// A built file of this profile, e.g. `ocb` or `libocb_parry.so`. Test programs run from `target/<profile>/deps`.
pub fn built(name: &str) -> PathBuf {
    let here = std::env::current_exe().expect("a test program knows where it is");
    let path = here.ancestors().nth(2).expect("target/<profile>/deps/test").join(name);
    assert!(path.exists(), "{} is not built: run `cargo build --release --workspace` first", path.display());
    path
}

/// A file of the test data that lies beside the repository (or where `OCB_SHARED` says). Where there are none at all, the test
/// says that it was not run, which `make test` counts apart.
pub fn shared(name: &str) -> PathBuf {
    let directory = std::env::var_os("OCB_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from);
    assert!(directory.join("meshes").is_dir(), "not run: objects missing, set OCB_SHARED");
    let path = directory.join(name);
    assert!(path.exists(), "the test data {} is missing: set OCB_SHARED to the folder that holds it", path.display());
    path
}

/// The files that git tracks, relative to [`root`].
pub fn tracked() -> Vec<PathBuf> {
    let list = crate::process::output(crate::process::command("git").arg("-C").arg(root()).args(["ls-files", "-z"]));
    list.split('\0').filter(|p| !p.is_empty() && root().join(p).is_file()).map(PathBuf::from).collect()
}

/// The text of a tracked file; `None` for pictures and other binary files.
pub fn text(path: &Path) -> Option<String> {
    let full = root().join(path);
    let bytes = std::fs::read(&full).unwrap_or_else(|e| panic!("{}: {e}", full.display()));
    String::from_utf8(bytes).ok()
}
