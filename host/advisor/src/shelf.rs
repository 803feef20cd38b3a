//! Certificates that were found before, by the content of what they speak of.

use std::fs;
use std::path::{Path, PathBuf};

use ocb_core::mesh::Mesh;

use crate::certificate::{Certificate, VERSION};

/// A folder of certificates, or none.
#[derive(Clone, Debug)]
pub struct Shelf(Option<PathBuf>);

impl Shelf {
    /// Keeps certificates in a folder, which is made when the first one comes.
    pub fn folder(folder: &Path) -> Self {
        Self(Some(folder.to_owned()))
    }

    /// Keeps nothing.
    pub fn none() -> Self {
        Self(None)
    }

    /// What is known of a mesh that stands for an object. What cannot be read is not known.
    pub fn get(&self, object: &Mesh, reduced: &Mesh) -> Option<Certificate> {
        let (object, reduced_hash) = (object.sha256(), reduced.sha256());
        let bytes = fs::read(self.file(&object, &reduced_hash)?).ok()?;
        let found: Certificate = serde_json::from_slice(&bytes).ok()?;
        let triangles = reduced.triangles().len();
        let fits = found.version == VERSION && found.object == object && found.reduced == reduced_hash;
        (fits && found.thickness.len() == triangles && found.deviation.len() == triangles).then_some(found)
    }

    /// Keeps a certificate; one that cannot be kept is found again the next time.
    pub fn put(&self, certificate: &Certificate) {
        let Some(file) = self.file(&certificate.object, &certificate.reduced) else { return };
        let Ok(bytes) = serde_json::to_vec(certificate) else { return };
        let folder = file.parent().unwrap_or(&file);
        // Whole or not at all: under another name first.
        let draft = folder.join(format!("{}-{}.draft", certificate.reduced, std::process::id()));
        let _ =
            fs::create_dir_all(folder).and_then(|()| fs::write(&draft, bytes)).and_then(|()| fs::rename(&draft, file));
    }

    fn file(&self, object: &str, reduced: &str) -> Option<PathBuf> {
        Some(self.0.as_ref()?.join(format!("{object}-{reduced}-{VERSION}.json")))
    }
}
