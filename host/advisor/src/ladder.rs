//! The ladder of levels of detail of one object: each about half of the one before, each certified.

use std::sync::Arc;

use meshopt::{SimplifyOptions, simplify_decoder};
use ocb_advice::{Certificate, Watch};
use ocb_core::lod::{Lod, LodError};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;

/// No level has fewer triangles than this.
const FEWEST: usize = 32;
/// A level is no level when it has more than this share of the one before.
const MOST_SHARE: f64 = 0.8;

/// One level of detail.
#[derive(Clone, Debug)]
pub struct Level {
    /// The mesh; level 0 is the object.
    pub mesh: Arc<Mesh>,
    /// Its certificate; the object itself has none.
    pub certificate: Option<Certificate>,
    /// Both, made ready for queries.
    pub lod: Lod,
}

impl Level {
    /// The object itself.
    pub fn whole(object: Arc<Mesh>) -> Self {
        Self { lod: Lod::exact(Shape::new(object.clone())), mesh: object, certificate: None }
    }

    /// A mesh that stands for the object; `None` when it was stopped.
    pub fn certified(object: &Mesh, mesh: Mesh, known: &[Certificate], watch: &dyn Watch) -> Option<Self> {
        let hash = mesh.sha256();
        let certificate = match known.iter().find(|certificate| certificate.reduced == hash) {
            Some(certificate) => certificate.clone(),
            None => Certificate::find(object, &mesh, watch)?,
        };
        Some(Self::known(mesh, certificate).expect("what was found fits"))
    }

    /// A mesh that stands for the object, of which this is known.
    pub fn known(mesh: Mesh, certificate: Certificate) -> Result<Self, LodError> {
        let mesh = Arc::new(mesh);
        let lod = certificate.lod(mesh.clone())?;
        Ok(Self { mesh, certificate: Some(certificate), lod })
    }
}

/// The object and its levels, finest first, where certificates of some of them are known; `None` when it was stopped.
pub fn ladder(object: &Arc<Mesh>, known: &[Certificate], watch: &dyn Watch) -> Option<Vec<Level>> {
    let meshes = meshes(object);
    let mut levels = vec![Level::whole(object.clone())];
    let total = meshes.len() as u64;
    for (done, mesh) in meshes.into_iter().enumerate() {
        watch.step("levels", done as u64, total);
        levels.push(Level::certified(object, mesh, known, watch)?);
    }
    watch.step("levels", total, total);
    Some(levels)
}

/// Half of the object's triangles, a quarter, and so on, as far as that goes.
pub(crate) fn meshes(object: &Mesh) -> Vec<Mesh> {
    let mut meshes: Vec<Mesh> = Vec::new();
    let mut target = object.triangles().len() / 2;
    while target >= FEWEST {
        let before = meshes.last().unwrap_or(object).triangles().len();
        match simplified(object, target) {
            Some(mesh) if mesh.triangles().len() as f64 <= MOST_SHARE * before as f64 => meshes.push(mesh),
            _ => break,
        }
        target /= 2;
    }
    meshes
}

/// The object with about so many triangles, whose corners are corners of the object; borders stay as they are. `None`
/// when nothing is left that is a mesh.
pub fn simplified(object: &Mesh, triangles: usize) -> Option<Mesh> {
    // In single precision: relative to the middle and the size, so that nothing is lost for an object far away.
    let (middle, size) = (object.bounds().center(), object.longest_side());
    let positions: Vec<[f32; 3]> =
        object.positions().iter().map(|p| ((p - middle) / size).data.0[0].map(|x| x as f32)).collect();
    let indices = object.triangles().as_flattened();
    let left = simplify_decoder(indices, &positions, 3 * triangles, f32::MAX, SimplifyOptions::LockBorder, None);
    // Only the vertices that are still used, in their order.
    let mut used = left.clone();
    used.sort_unstable();
    used.dedup();
    let number = |v: &u32| used.binary_search(v).map_or(0, |place| place as u32);
    let corners = left.as_chunks::<3>().0.iter().map(|t| t.each_ref().map(number)).collect();
    Mesh::new(used.iter().map(|&v| object.positions()[v as usize]).collect(), corners).ok()
}
