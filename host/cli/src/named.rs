//! Objects as commands name them: an id, or a file.

use std::path::Path;

use ocb_core::mesh::{self, MAX_BYTES};
use ocb_core::stock;
use ocb_service::Engine;
use ocb_service::model::{ObjectId, stock_id};

use crate::failure::{Failure, Result};
use crate::open::{OWNER, read_bounded};

/// An object as it was named.
pub enum Object {
    /// By its id.
    Known(String),
    /// As a file.
    File { name: String, bytes: Vec<u8> },
}

impl Object {
    /// What was named; a file is read.
    pub fn named(named: &str) -> Result<Self> {
        object(named)
    }

    /// Is a file an object?
    pub fn check(&self) -> Result<()> {
        match self {
            Self::Known(_) => Ok(()),
            Self::File { name, bytes } => {
                mesh::read(bytes).map(|_| ()).map_err(|e| Failure::Input(format!("{name}: {e}.")))
            }
        }
    }

    /// Gives a file to the engine; the id.
    pub async fn into_id(self, engine: &Engine) -> Result<String> {
        match self {
            Self::Known(id) => Ok(id),
            Self::File { name, bytes } => {
                let object = engine.add_object(&name, bytes, Some(OWNER)).await?;
                for warning in &object.warnings {
                    eprintln!("ocb: {name}: {warning}");
                }
                Ok(object.id)
            }
        }
    }
}

/// The id of an object that is always there and quickly made.
pub fn stand_in() -> String {
    let simplest = stock::list().iter().min_by_key(|object| object.lowest_triangles);
    simplest.map_or_else(String::new, |object| stock_id(object.name, object.lowest_triangles))
}

fn object(named: &str) -> Result<Object> {
    if ObjectId::of(named).is_stock() {
        return Ok(Object::Known(named.to_owned()));
    }
    let path = Path::new(named);
    // The id of an object of an earlier command, as `ocb object list` shows it.
    if !path.exists() && named.len() == 36 && named.bytes().all(|c| c.is_ascii_hexdigit() || c == b'-') {
        return Ok(Object::Known(named.to_owned()));
    }
    let bytes = read_bounded(path, MAX_BYTES)?;
    let name = path.file_name().map_or_else(|| named.to_owned(), |name| name.to_string_lossy().into_owned());
    Ok(Object::File { name, bytes })
}
