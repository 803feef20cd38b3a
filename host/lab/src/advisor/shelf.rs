//! Certificates that were found before, by the content of the object that they speak of.

use std::fs;
use std::path::{Path, PathBuf};

use ocb_advice::{Certificate, VERSION};

/// A folder of certificates, made when the first ones come.
#[derive(Clone, Debug)]
pub struct Shelf(PathBuf);

impl Shelf {
    /// Keeps certificates in this folder.
    pub fn folder(folder: &Path) -> Self {
        Self(folder.to_owned())
    }

    /// Known certificates of the levels of an object; unreadable ones are ignored.
    pub fn get(&self, object: &str) -> Vec<Certificate> {
        let read = || serde_json::from_slice::<Vec<Certificate>>(&fs::read(self.file(object)).ok()?).ok();
        let fits = |known: &Certificate| known.version == VERSION && known.object == object;
        read().unwrap_or_default().into_iter().filter(fits).collect()
    }

    /// Keeps the certificates of an object's levels; what cannot be kept is found again the next time.
    pub fn put(&self, object: &str, known: &[Certificate]) {
        let Ok(bytes) = serde_json::to_vec(known) else { return };
        // Whole or not at all: under another name first.
        let draft = self.0.join(format!("{object}-{}.draft", std::process::id()));
        let written = fs::create_dir_all(&self.0).and_then(|()| fs::write(&draft, bytes));
        let _ = written.and_then(|()| fs::rename(&draft, self.file(object)));
    }

    fn file(&self, object: &str) -> PathBuf {
        self.0.join(format!("{object}-{VERSION}.json"))
    }
}
