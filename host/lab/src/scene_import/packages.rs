//! Where the files are that a robot names: inside its own folder and the folders of packages, never elsewhere.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

use ocb_sandbox::given;

use super::element::Element;
use super::{Found, shown};

/// Folders above the file in which a package is looked for.
const MOST_UP: usize = 6;
/// A folder that is looked into has so many parts at least (`/`, `a`, `b`): a robot must not name `/etc` a package.
const LEAST_DEEP: usize = 3;
/// Bytes of `package.xml`.
const MOST_MANIFEST: u64 = 1 << 20;

/// A file that was found.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where it is, without symbolic links.
    pub path: PathBuf,
    /// The licences that `package.xml` states, if there is one.
    pub licence: Option<String>,
}

/// A folder from which files are read.
#[derive(Clone, Debug)]
struct Root {
    folder: PathBuf,
    licence: Option<String>,
}

impl Root {
    fn new(folder: PathBuf) -> Self {
        let licence = licence(&folder);
        Self { folder, licence }
    }
}

/// The folders of one robot.
pub struct Packages {
    /// The folder of the file.
    folder: PathBuf,
    /// The package that the file is in, or else its folder.
    own: Root,
    known: HashMap<String, Root>,
}

impl Packages {
    /// For the robot in this file, with these folders of packages.
    pub fn new(file: &Path, given: &[(String, PathBuf)]) -> Found<Self> {
        let failed = |path: &Path, e: &std::io::Error| format!("{} cannot be opened ({e})", shown_path(path));
        let whole = file.canonicalize().map_err(|e| failed(file, &e))?;
        let folder = whole.parent().unwrap_or(Path::new("/")).to_owned();
        let own = above(&folder).find(|folder| folder.join("package.xml").is_file()).unwrap_or(&folder);
        let own = Root::new(own.to_owned());
        let mut known = HashMap::new();
        for (name, folder) in given {
            let whole = folder.canonicalize().map_err(|e| failed(folder, &e))?;
            if !whole.is_dir() {
                return Err(format!("the package {} is not a folder", shown(name)));
            }
            if known.insert(name.clone(), Root::new(whole)).is_some() {
                return Err(format!("the package {} is given twice", shown(name)));
            }
        }
        Ok(Self { folder, own, known })
    }

    /// The licences of the package that the file is in.
    pub fn licence(&self) -> Option<&str> {
        self.own.licence.as_deref()
    }

    /// The file that a robot names: `package://NAME/PATH`, `model://NAME/PATH`, `file://PATH`, or a path that starts at the
    /// folder of the robot.
    pub fn find(&mut self, address: &str) -> Found<Place> {
        let named = ["package://", "model://"].into_iter().find_map(|scheme| address.strip_prefix(scheme));
        if let Some(named) = named {
            let (name, path) = named.trim_start_matches('/').split_once('/').unwrap_or_default();
            let root = self.package(name).ok_or_else(|| {
                format!("{} names a package that is not found; give it with --package NAME=DIR", shown(address))
            })?;
            return inside(&root, &root.folder.join(path.trim_start_matches('/')), address);
        }
        let path = address.strip_prefix("file://").unwrap_or(address);
        if path.contains("://") {
            return Err(format!("{} is not a file on this machine, and nothing else is opened", shown(address)));
        }
        let path = self.folder.join(path);
        let roots = std::iter::once(&self.own).chain(self.known.values());
        let mut found = roots.map(|root| inside(root, &path, address));
        let first = found.next().unwrap_or_else(|| Err(String::new()));
        if first.is_ok() { first } else { found.find(Result::is_ok).unwrap_or(first) }
    }

    /// The package of this name: given, or a folder of that name above the file or beside such a folder.
    fn package(&mut self, name: &str) -> Option<Root> {
        if let Some(root) = self.known.get(name) {
            return Some(root.clone());
        }
        let mut parts = Path::new(name).components();
        if !matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None)) {
            return None;
        }
        let folder = above(&self.folder).find_map(|folder| {
            if folder.ends_with(name) {
                return Some(folder.to_owned());
            }
            let beside = folder.join(name).canonicalize().ok()?;
            (beside.is_dir() && beside.starts_with(folder)).then_some(beside)
        })?;
        let root = Root::new(folder);
        self.known.insert(name.to_owned(), root.clone());
        Some(root)
    }
}

/// A folder and those above it, as far as packages are looked for.
fn above(folder: &Path) -> impl Iterator<Item = &Path> {
    folder.ancestors().take(MOST_UP).take_while(|folder| folder.components().count() >= LEAST_DEEP)
}

/// The file, if it is in the folder also when symbolic links are followed.
fn inside(root: &Root, path: &Path, address: &str) -> Found<Place> {
    let path = path.canonicalize().map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => format!("the file {} does not exist", shown(address)),
        _ => format!("the file {} cannot be opened ({e})", shown(address)),
    })?;
    if !path.starts_with(&root.folder) {
        return Err(format!(
            "{} leads out of the folder of the robot or package; give the folder that it is in with --package NAME=DIR",
            shown(address)
        ));
    }
    Ok(Place { path, licence: root.licence.clone() })
}

/// The licences that a package states.
fn licence(folder: &Path) -> Option<String> {
    let bytes = given::read(&folder.join("package.xml"), MOST_MANIFEST).ok()?;
    let package = Element::root(&bytes, None).ok()?;
    let mut licences: Vec<String> = Vec::new();
    for licence in package.named("license") {
        let words: Vec<&str> = licence.text.split_whitespace().collect();
        let text = ocb_sandbox::text::one_line(&words.join(" "), 100);
        if !text.is_empty() && licences.len() < 20 && !licences.contains(&text) {
            licences.push(text);
        }
    }
    (!licences.is_empty()).then(|| licences.join(", "))
}

fn shown_path(path: &Path) -> String {
    shown(&path.to_string_lossy())
}
