//! Scenes from descriptions of robots and worlds: their collision geometry, placed by their joints, with the pairs that are not
//! asked.
//!
//! A file is hostile: its size, nesting, links, triangles and pairs are bounded, entities are refused, and only files in the
//! folders of the robot and its packages are opened. What cannot be imported is refused with the line and the reason; what is left
//! out is told.

mod assembly;
mod element;
pub(crate) mod kinematics;
mod mjcf;
mod packages;
mod pairs;
mod sdf;
mod srdf;
#[cfg(test)]
mod tests;
mod urdf;

use std::path::{Path, PathBuf};

use ocb_sandbox::given;

use crate::scene_file::SceneFile;
use crate::{LabError, Result};
use element::Element;
use packages::Packages;

/// Most bytes of a description, without its meshes.
const MOST_BYTES: u64 = 64 << 20;

/// The value of something that a file holds, or the reason that it cannot be used: a sentence without its full stop.
type Found<T> = std::result::Result<T, String>;

/// An imported scene, with notes about its source.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// The SRDF file with the pairs that are not asked; only with URDF.
    pub srdf: Option<PathBuf>,
    /// Folders of packages by their names.
    pub packages: Vec<(String, PathBuf)>,
    /// Values of joints by their names, in radians or in the unit of length; all others are 0.
    pub joints: Vec<(String, f64)>,
}

/// What was imported.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The scene with its meshes.
    pub file: SceneFile,
    /// Links of the robot (bodies of MJCF), also those without collision geometry.
    pub links: usize,
    /// What was left out or converted, one sentence each.
    pub notes: Vec<String>,
}

/// Imports the collision geometry of a robot or model: URDF, MJCF or SDF, as its root element
/// says.
///
/// # Errors
/// `Invalid`, with one sentence, for a file that cannot be imported as a whole.
pub fn import(path: &Path, wanted: &Wanted) -> Result<Imported> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    whole(path, wanted).map_err(|why| LabError::Invalid(format!("{name:?} cannot be imported: {why}.")))
}

fn whole(path: &Path, wanted: &Wanted) -> Found<Imported> {
    let root = read(path, None)?;
    if root.name != "robot" && wanted.srdf.is_some() {
        return Err("an SRDF file belongs to a URDF file only".to_owned());
    }
    let srdf = wanted.srdf.as_deref().map(|path| read(path, Some(&path.to_string_lossy()))).transpose()?;
    let packages = Packages::new(path, &wanted.packages)?;
    match root.name.as_str() {
        "robot" => urdf::import(&root, srdf.as_ref(), wanted, packages),
        "mujoco" => mjcf::import(root, wanted, packages),
        "sdf" => sdf::import(&root, wanted, packages),
        other => Err(format!(
            "its root element is {}, and only <robot> (URDF), <mujoco> (MJCF) and <sdf> (SDF) are read",
            shown(other)
        )),
    }
}

/// The elements of a file; `name` is for messages.
fn read(path: &Path, name: Option<&str>) -> Found<Element> {
    let bytes = given::read(path, MOST_BYTES)
        .map_err(|e| name.map_or_else(|| format!("{e}"), |name| format!("{} cannot be read ({e})", shown(name))))?;
    Element::root(&bytes, name)
}

/// A text of the file in a message: in quotes, and cut.
fn shown(text: &str) -> String {
    format!("{:?}", text.chars().take(100).collect::<String>())
}
