//! The libraries that a plugin built from our own sources brings with it.
//!
//! Beside `libocb_fcl.so` lies `libocb_fcl.libraries`, written when it was linked: the files of all libraries that it needs
//! beyond the jail's own, theirs included, one path per line. They are mounted read-only into the jail, and the gate knows
//! them for this plugin. A foreign plugin has no such file: what lies beside it is never read.

use std::path::Path;

use crate::given;
use crate::outcome::{Ending, Outcome};

/// Largest list.
const MAX_LIST_BYTES: u64 = 1 << 20;

/// The list of a plugin, empty when it has none.
pub(crate) fn beside(plugin: &Path) -> Result<Vec<String>, Ending> {
    let list = plugin.with_extension("libraries");
    let refused = |reason: String| Ending::from(Outcome::LoadError { reason });
    let text = match given::read(&list, MAX_LIST_BYTES) {
        Ok(text) => String::from_utf8_lossy(&text).into_owned(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(refused(format!("{} cannot be read: {error}", list.display()))),
    };
    let libraries: Vec<String> = text.lines().map(str::to_owned).collect();
    match libraries.iter().find(|path| !Path::new(path).is_file()) {
        Some(missing) => Err(refused(format!(
            "it needs the library {missing}, which is not installed; install it or rebuild the plugin"
        ))),
        None => Ok(libraries),
    }
}
