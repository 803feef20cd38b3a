//! Submitted plugins, as far as somebody may benchmark them.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ocb_lab::algorithm::Algorithm;

use crate::blobs::Blobs;
use crate::model::{AlgorithmInfo, Owner, PluginState};
use crate::plugins::sql::PluginRow;
use crate::store::Store;
use crate::{EngineError, Result};

/// An algorithm of a submitted plugin.
pub struct Submitted {
    /// Under the name by which it is asked for: the newest public version under its id, others as `id@version`.
    pub algorithm: Arc<Algorithm>,
    /// Who submitted it.
    pub owner: String,
    /// Everybody may ask for it.
    pub public: bool,
}

impl Submitted {
    /// May this viewer ask for it?
    pub fn is_for(&self, viewer: Option<&str>) -> bool {
        self.public || viewer == Some(self.owner.as_str())
    }
}

/// The submitted plugins.
#[derive(Default)]
pub struct AllSubmitted {
    /// The offered ones.
    pub plugins: Vec<Submitted>,
    /// Why others are not offered, as sentences.
    pub problems: Vec<String>,
}

/// Every algorithm that may be asked for, with its file on the disk of this machine. A file that cannot be read keeps no other
/// from being offered.
pub async fn submitted(store: &Store, blobs: &Blobs, data: &Path) -> Result<AllSubmitted> {
    let (mut all, mut problems): (Vec<Submitted>, Vec<String>) = Default::default();
    let rows = store.plugins().await?;
    for row in rows.iter().filter(|row| row.state.is_usable()) {
        let file = match plugin_file(blobs, data, &row.blob).await {
            Ok(file) => file,
            Err(e) => {
                tracing::error!("plugin {}: {e}", row.id);
                let (name, version) = (&row.manifest.name, &row.manifest.version);
                problems.push(format!(
                    "The plugin {name} {version} cannot be read and is not available; see the log of the service."
                ));
                continue;
            }
        };
        for info in &row.algorithms {
            let public = row.state == PluginState::Public;
            let newest = public && all.iter().all(|b| !b.public || b.algorithm.info.id != info.id);
            all.push(one(row, info, &file, public, newest));
        }
    }
    Ok(AllSubmitted { plugins: all, problems })
}

fn one(row: &PluginRow, info: &AlgorithmInfo, file: &Path, public: bool, newest: bool) -> Submitted {
    let mut algorithm = Algorithm::plain(info.clone(), file.to_owned(), false);
    if !newest {
        algorithm.info.id = format!("{}@{}", info.id, row.manifest.version);
        algorithm.info.name = format!("{} {}", info.name, row.manifest.version);
    }
    // One's own is measured without being named; everybody's would make every run longer.
    algorithm.info.usual = !public;
    Submitted { algorithm: Arc::new(algorithm), owner: Owner::Account(&row.account).to_string(), public }
}

/// The file of a plugin on this disk, under its hash; the jail needs a path.
pub async fn plugin_file(blobs: &Blobs, data: &Path, sha256: &str) -> Result<PathBuf> {
    let folder = data.join("plugins");
    let file = cached(data, sha256);
    if !file.is_file() {
        let bytes = blobs.get(sha256).await?;
        let fault = |e: std::io::Error| EngineError::fault("Writing a plugin file failed", e);
        std::fs::create_dir_all(&folder).map_err(fault)?;
        // Whole under its name or not at all: synced to the disk before it gets the name.
        let draft = folder.join(format!("{sha256}.{}", uuid::Uuid::new_v4().simple()));
        let write = || {
            let mut opened = std::fs::File::create(&draft)?;
            opened.write_all(&bytes)?;
            opened.sync_all()?;
            std::fs::rename(&draft, &file)
        };
        write().map_err(fault)?;
    }
    Ok(file)
}

/// Takes the file of a plugin that is gone off this disk.
pub fn forget_file(data: &Path, sha256: &str) -> Result<()> {
    match std::fs::remove_file(cached(data, sha256)) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
            Err(EngineError::fault("Removing a plugin file failed", e))
        }
        _ => Ok(()),
    }
}

fn cached(data: &Path, sha256: &str) -> PathBuf {
    data.join("plugins").join(format!("{sha256}.so"))
}
