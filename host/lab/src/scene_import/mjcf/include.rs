//! Files that an MJCF file includes: their elements stand where they are included.

use std::collections::HashSet;
use std::path::PathBuf;

use ocb_sandbox::given;

use crate::scene_import::element::{Element, MOST_DEPTH};
use crate::scene_import::packages::Packages;
use crate::scene_import::{Found, MOST_BYTES, shown};

/// Most files.
const MOST_FILES: usize = 100;

/// The budget of includes, and the files included so far: MuJoCo includes a file once.
pub struct Including<'a> {
    packages: &'a mut Packages,
    done: HashSet<PathBuf>,
    left: u64,
}

impl<'a> Including<'a> {
    /// Nothing yet.
    pub fn new(packages: &'a mut Packages) -> Self {
        Self { packages, done: HashSet::new(), left: MOST_BYTES }
    }

    /// Replaces each `<include>` by the content of its file; `depth` elements are around this one.
    pub fn expand(&mut self, element: &mut Element, depth: usize) -> Found<()> {
        if depth > MOST_DEPTH {
            return Err(element.fault(&format!("elements are nested more than {MOST_DEPTH} deep")));
        }
        for mut child in std::mem::take(&mut element.children) {
            if child.name == "include" {
                let mut included = self.read(&child)?;
                self.expand(&mut included, depth + 1)?;
                element.children.append(&mut included.children);
            } else {
                self.expand(&mut child, depth + 1)?;
                element.children.push(child);
            }
        }
        Ok(())
    }

    fn read(&mut self, include: &Element) -> Found<Element> {
        let file = include.required("file")?;
        let fault = |why: String| include.fault(&why);
        let place = self.packages.find(file).map_err(fault)?;
        if !self.done.insert(place.path.clone()) || self.done.len() > MOST_FILES {
            return Err(include.fault(&format!("{} is included twice, or is one too many", shown(file))));
        }
        let bytes = given::read(&place.path, self.left)
            .map_err(|e| include.fault(&format!("{} cannot be read ({e})", shown(file))))?;
        self.left -= bytes.len() as u64;
        Element::root(&bytes, Some(file))
    }
}
