//! The plugin file as it is opened for a jail: found, looked at, and the one that is meant.

use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::gate::MAX_BYTES;
use crate::given;
use crate::outcome::{Ending, Outcome};
use crate::shared::memory_file;

/// Read at a time.
const CHUNK: usize = 1 << 20;

/// An opened plugin file, at its beginning.
pub(crate) struct Opened {
    /// Where it lies, without links.
    pub path: PathBuf,
    pub file: File,
    pub bytes: u64,
}

/// Where no plugin is to be loaded: an empty file, and the program in its place.
pub(crate) fn nothing(program: &Path) -> Result<Opened, Ending> {
    let fault = |error: io::Error| Ending::from(Outcome::fault("Start", format!("{}: {error}", program.display())));
    let path = program.canonicalize().map_err(fault)?;
    let file = File::from(memory_file(c"ocb-nothing", 0).map_err(fault)?);
    Ok(Opened { path, file, bytes: 0 })
}

/// Opens the file, which must have this SHA-256 if one is given.
pub(crate) fn open(plugin: &Path, sha256: Option<&str>) -> Result<Opened, Ending> {
    let unreadable = |error: io::Error| -> Ending {
        let reason = format!("{} cannot be read: {error}", plugin.display());
        // It could be read when its hash was made.
        if sha256.is_some() { Outcome::FileReplaced { reason } } else { Outcome::LoadError { reason } }.into()
    };
    let path = plugin.canonicalize().map_err(unreadable)?;
    let file = given::open(&path).map_err(unreadable)?;
    let bytes = file.metadata().map_err(unreadable)?.len();
    if bytes > MAX_BYTES {
        let reason = format!("it has {bytes} bytes, but at most {MAX_BYTES} are allowed; strip its debug symbols");
        return Err(Outcome::LoadError { reason }.into());
    }
    if let Some(expected) = sha256 {
        let found = hash_of(&file, bytes).map_err(unreadable)?;
        if found != expected {
            let reason = format!("its SHA-256 is {found}, not {expected}");
            return Err(Outcome::FileReplaced { reason }.into());
        }
    }
    Ok(Opened { path, file, bytes })
}

/// Leaves the file at its beginning: the jail copies it from there.
fn hash_of(file: &File, bytes: u64) -> io::Result<String> {
    let (mut hash, mut chunk, mut at) = (Sha256::new(), vec![0; CHUNK], 0);
    while at < bytes {
        let n = file.read_at(&mut chunk, at)?;
        if n == 0 {
            break;
        }
        hash.update(&chunk[..n]);
        at += n as u64;
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
