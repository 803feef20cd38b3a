//! Objects: made on demand, shipped with the service, or added by somebody.

mod ask;
pub mod sql;

use std::path::PathBuf;
use std::sync::Arc;

use ocb_core::mesh::{self, FileFormat, MAX_BYTES, Mesh, obj};
use ocb_core::stock;
use ocb_lab::mesh_file::{from_bytes, to_bytes};
use ocb_sandbox::given;
use tokio::sync::Semaphore;

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::cache::Cache;
use crate::model::{Cursor, ObjectId, ObjectInfo, Page, Part, Rounding, Visibility, stock_id};
use crate::store::{Store, now_us};
use crate::{EngineError, Result};

/// Files of `stock_dir` that become stock objects when they are there.
const SHIPPED: [&str; 2] = ["bunny", "dragon"];
/// Triangles of the meshes that are kept in memory, some 50 bytes each, and descriptions of stock objects.
const MOST_TRIANGLES: usize = 2_000_000;
const MOST_INFOS: usize = 256;
/// Longest display name in characters.
const MAX_NAME: usize = 120;

/// All objects of one engine.
pub struct Objects {
    store: Store,
    blobs: Blobs,
    stock_dir: Option<PathBuf>,
    meshes: Cache<Mesh>,
    stock_infos: Cache<ObjectInfo>,
    /// Held while a mesh is made or read: many large ones at once would need memory for all of them.
    making: Semaphore,
}

impl Objects {
    /// Over this store; shipped objects are looked for in `stock_dir`.
    pub fn new(store: Store, blobs: Blobs, stock_dir: Option<PathBuf>) -> Self {
        Self {
            store,
            blobs,
            stock_dir,
            meshes: Cache::weighing(MOST_TRIANGLES, |mesh| mesh.triangles().len()),
            stock_infos: Cache::new(MOST_INFOS),
            making: Semaphore::new(1),
        }
    }

    /// Stock objects in front of the first part, then those of the viewer and the public ones of others, newest first.
    pub async fn list(&self, viewer: Option<&str>, page: &Page) -> Result<Part<ObjectInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.store.objects_for(viewer, &from, limit + 1).await?;
        let infos = rows.into_iter().map(|row| row.shown_to(viewer)).collect();
        let mut part = Part::of(infos, limit, |info: &ObjectInfo| Cursor::behind(info.created_us, &info.id));
        if page.cursor.is_none() {
            part.entries.splice(0..0, self.stock().await?);
        }
        Ok(part)
    }

    /// What ships with the service.
    pub async fn stock(&self) -> Result<Vec<ObjectInfo>> {
        let shipped = SHIPPED.iter().filter(|name| self.shipped_file(name).is_some());
        let ids = shipped
            .map(|name| ObjectId::Stock { name, triangles: None }.to_string())
            .chain(stock::list().iter().map(|o| stock_id(o.name, o.default_triangles)));
        let mut all = Vec::new();
        for id in ids {
            all.push(self.info(&id).await?);
        }
        Ok(all)
    }

    /// One object as this viewer is shown it. The id in the answer is the canonical one: `stock:castle` has become
    /// `stock:castle@<default>`.
    pub async fn info_for(&self, id: &str, viewer: Option<&str>) -> Result<ObjectInfo> {
        if ObjectId::of(id).is_stock() {
            return self.info(id).await;
        }
        let row = self.store.object(id).await?.filter(|row| row.is_for(viewer));
        Ok(row.ok_or_else(|| unknown(id))?.shown_to(viewer))
    }

    /// Is the object there for this viewer, if it is there at all?
    pub async fn is_for(&self, id: &str, viewer: Option<&str>) -> Result<bool> {
        Ok(ObjectId::of(id).is_stock() || self.store.object(id).await?.is_none_or(|row| row.is_for(viewer)))
    }

    /// Who sees the object; what is not there any more hides nothing: its runs have taken over what it hid.
    pub async fn visibility(&self, id: &str) -> Result<Visibility> {
        if ObjectId::of(id).is_stock() {
            return Ok(Visibility::Public);
        }
        Ok(self.store.object(id).await?.map_or(Visibility::Public, |row| row.info.visibility))
    }

    /// One object, whoever asks.
    pub async fn info(&self, id: &str) -> Result<ObjectInfo> {
        let id = canonical(id);
        if !ObjectId::of(&id).is_stock() {
            return Ok(self.store.object(&id).await?.ok_or_else(|| unknown(&id))?.info);
        }
        if let Some(info) = self.stock_infos.get(&id) {
            return Ok(info.as_ref().clone());
        }
        let _alone = self.making.acquire().await;
        match self.stock_infos.get(&id) {
            Some(info) => Ok(info.as_ref().clone()),
            None => Ok(self.make_stock(&id).await?.1),
        }
    }

    /// The mesh of an object.
    pub async fn mesh(&self, id: &str) -> Result<Arc<Mesh>> {
        let id = canonical(id);
        if let Some(mesh) = self.meshes.get(&id) {
            return Ok(mesh);
        }
        let _alone = self.making.acquire().await;
        // It may have been made while this request waited.
        if let Some(mesh) = self.meshes.get(&id) {
            return Ok(mesh);
        }
        if ObjectId::of(&id).is_stock() {
            return Ok(self.make_stock(&id).await?.0);
        }
        let row = self.store.object(&id).await?.ok_or_else(|| unknown(&id))?;
        let bytes = self.blobs.get(&row.blob).await?;
        let mesh = blocking(move || Ok(from_bytes(&bytes)?)).await?;
        Ok(self.meshes.put(&id, mesh))
    }

    /// Makes or reads a stock object and remembers what there is to say of it.
    async fn make_stock(&self, id: &str) -> Result<(Arc<Mesh>, ObjectInfo)> {
        let file = match ObjectId::of(id) {
            ObjectId::Stock { name, triangles: None } => self.shipped_file(name).map(|file| (name.to_owned(), file)),
            ObjectId::Stock { .. } | ObjectId::Added(_) => None,
        };
        let for_id = id.to_owned();
        let (mesh, info) = blocking(move || match file {
            Some((name, file)) => read_shipped(&for_id, &name, &file),
            None => make_stock(&for_id),
        })
        .await?;
        self.stock_infos.put(id, info.clone());
        Ok((self.meshes.put(id, mesh), info))
    }

    /// Reads a file in any of [`mesh::FORMATS`] and keeps its mesh. Everything is checked before anything is kept.
    pub async fn add(&self, name: &str, bytes: Vec<u8>, owner: Option<&str>) -> Result<ObjectInfo> {
        let name = clean_name(name, "object");
        let shown = name.clone();
        let (mesh, warnings, format, unit) = blocking(move || {
            let bad = |e: &dyn std::fmt::Display| EngineError::Invalid(format!("{shown:?} cannot be used: {e}."));
            let read = mesh::read(&bytes).map_err(|e| bad(&e))?;
            Ok((read.mesh, read.warnings, read.format, read.unit))
        })
        .await?;
        let mut info = describe(&mesh, &uuid::Uuid::now_v7().to_string(), &name, "Added by its owner.", warnings);
        (info.created_us, info.format, info.unit) = (now_us(), Some(format), unit);
        if let Some(known) = self.store.object_with_mesh(&info.sha256, owner).await? {
            return Ok(known.shown_to(owner));
        }
        let bytes = to_bytes(&mesh);
        let length = bytes.len();
        let _keeping = self.store.locks.keeping().await?;
        let blob = self.blobs.put(bytes).await?;
        self.store.add_blob(&blob, length, "application/octet-stream").await?;
        self.store.add_object(&info, owner, &blob).await?;
        self.meshes.put(&info.id, mesh);
        Ok(ObjectInfo { mine: owner.is_some(), ..info })
    }

    fn shipped_file(&self, name: &str) -> Option<PathBuf> {
        let known = SHIPPED.contains(&name);
        self.stock_dir.as_ref().filter(|_| known).map(|dir| dir.join(format!("{name}.obj"))).filter(|f| f.is_file())
    }
}

/// There is no such object, or not for who asks: both sound alike.
pub fn unknown(id: &str) -> EngineError {
    EngineError::NotFound(format!(
        "There is no object {id:?}; `ocb object list` and GET /api/v1/objects list all objects."
    ))
}

/// `stock:castle` means castle with its default number of triangles.
fn canonical(id: &str) -> String {
    let ObjectId::Stock { name, triangles: None } = ObjectId::of(id) else { return id.to_owned() };
    let default = stock::list().iter().find(|o| o.name == name);
    default.map_or_else(|| id.to_owned(), |o| stock_id(o.name, o.default_triangles))
}

fn make_stock(id: &str) -> Result<(Mesh, ObjectInfo)> {
    let ObjectId::Stock { name, triangles: Some(triangles) } = ObjectId::of(id) else { return Err(unknown(id)) };
    let object = stock::list().iter().find(|o| o.name == name).ok_or_else(|| unknown(id))?;
    let mesh = triangles.parse().ok().and_then(|n| stock::generate(name, n)).ok_or_else(|| {
        EngineError::Invalid(format!(
            "The stock object {name:?} has {} to {} triangles, not {triangles}.",
            object.lowest_triangles,
            stock::MAX_TRIANGLES
        ))
    })?;
    let terms = format!("{} Created by OpenCollBench; free to use without conditions.", object.description);
    let mut info = describe(&mesh, id, object.name, &terms, Vec::new());
    (info.stock, info.visibility) = (true, Visibility::Public);
    Ok((mesh, info))
}

/// Largest file with the terms of a stock object.
const MAX_TERMS_BYTES: u64 = 64 << 10;

fn read_shipped(id: &str, name: &str, file: &std::path::Path) -> Result<(Mesh, ObjectInfo)> {
    let fault =
        |e: &dyn std::fmt::Display| EngineError::Fault(format!("The stock file {name}.obj cannot be used: {e}."));
    let bytes = given::read(file, MAX_BYTES as u64).map_err(|e| fault(&e))?;
    let read = obj::read(&bytes).map_err(|e| fault(&e))?;
    // The file names numbers of single precision, in as few digits as tell them apart.
    let mesh = read.mesh.to_f32_representable().map_err(|e| fault(&e))?;
    let terms = given::read(&file.with_extension("terms"), MAX_TERMS_BYTES)
        .map_err(|e| fault(&format!("its .terms file: {e}")))?;
    let terms = String::from_utf8_lossy(&terms);
    let mut info = describe(&mesh, id, name, terms.trim(), read.warnings);
    (info.stock, info.visibility, info.format) = (true, Visibility::Public, Some(FileFormat::Obj));
    Ok((mesh, info))
}

fn describe(mesh: &Mesh, id: &str, name: &str, terms: &str, warnings: Vec<String>) -> ObjectInfo {
    let bounds = mesh.bounds();
    let (lo, hi) = (bounds.min, bounds.max);
    ObjectInfo {
        id: id.to_owned(),
        name: name.to_owned(),
        triangles: mesh.triangles().len() as u32,
        vertices: mesh.positions().len() as u32,
        bounds: [lo.x, lo.y, lo.z, hi.x, hi.y, hi.z],
        sha256: mesh.sha256(),
        terms: terms.to_owned(),
        stock: false,
        closed: mesh.is_closed(),
        format: None,
        unit: None,
        rounding: rounding(mesh),
        warnings,
        created_us: 0,
        visibility: Visibility::default(),
        mine: false,
    }
}

/// What single precision changes; nothing where it holds all coordinates.
fn rounding(mesh: &Mesh) -> Option<Rounding> {
    if mesh.is_f32_representable() {
        return None;
    }
    let moved = |x: f64| (x - f64::from(x as f32)).abs();
    let moves = mesh.positions().iter().flat_map(|p| p.iter()).map(|&x| moved(x)).fold(0.0, f64::max);
    let (all, degenerate) = (mesh.triangles().len() as u32, mesh.degenerate_triangles());
    let left = mesh.clone().to_f32_representable().map(|rounded| all - rounded.degenerate_triangles());
    let flattens = left.is_err();
    Some(Rounding { moves, collapsed: (all - degenerate).saturating_sub(left.unwrap_or(0)), flattens })
}

/// Endings that names of objects lose; which format a file has, its content says.
const ENDINGS: [&str; 7] = ["obj", "stl", "ply", "off", "gltf", "glb", "dae"];

/// The file's name without folder, ending and control characters.
/// What a file is called without folder, known ending and control characters; without anything else it is a `kind`.
pub(crate) fn clean_name(name: &str, kind: &str) -> String {
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = match base.rsplit_once('.') {
        Some((stem, ending)) if ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)) => stem,
        _ => base,
    };
    let clean: String = stem.chars().filter(|c| !c.is_control()).take(MAX_NAME).collect();
    if clean.trim().is_empty() { kind.into() } else { clean.trim().into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lose_what_does_not_belong_into_a_name() {
        assert_eq!(clean_name("/some/where/Bunny.OBJ", "object"), "Bunny");
        assert_eq!(clean_name("C:\\a\u{7}b.obj", "object"), "ab");
        assert_eq!(clean_name(".obj", "object"), "object");
        assert_eq!(clean_name("ü.obj", "object"), "ü");
        assert_eq!(clean_name("part.v2.STL", "object"), "part.v2");
        assert_eq!(clean_name("part.v2", "object"), "part.v2");
    }
}
