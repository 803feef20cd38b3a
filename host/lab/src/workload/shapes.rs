//! The objects of a scene as triangles: meshes as they are, primitives between two polyhedra.

use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_core::scene::{Geometry, tessellate};

use crate::model::WorkloadObject;
use crate::scene_file::SceneFile;
use crate::{LabError, Result};

/// One object.
pub struct Solid {
    /// The mesh, or a polyhedron around the primitive. It is what algorithms get.
    pub outer: Arc<Mesh>,
    /// A polyhedron inside the primitive, or the solid mesh itself; absent for a mesh of which only the surface counts.
    pub inner: Option<Arc<Mesh>>,
    /// How far a point of both polyhedra may be from the primitive.
    pub bound: Option<f64>,
}

impl Solid {
    /// The mesh inside, which for a mesh is itself.
    pub fn inner(&self) -> &Arc<Mesh> {
        self.inner.as_ref().unwrap_or(&self.outer)
    }

    /// For the report.
    pub fn describe(&self, name: &str) -> WorkloadObject {
        WorkloadObject { name: name.to_owned(), triangles: self.outer.triangles().len() as u64, bound: self.bound }
    }
}

/// All objects of a scene.
pub fn solids(file: &SceneFile) -> Result<Vec<Solid>> {
    file.scene.objects.iter().map(|object| solid(file, &object.geometry)).collect()
}

/// One object.
pub fn solid(file: &SceneFile, geometry: &Geometry) -> Result<Solid> {
    if let Geometry::Mesh { sha256, solid } = geometry {
        let mesh = file.meshes.get(sha256);
        let mesh = mesh.ok_or_else(|| LabError::Invalid(format!("The scene has no mesh {sha256}.")))?;
        return Ok(Solid { outer: mesh.clone(), inner: solid.then(|| mesh.clone()), bound: solid.then_some(0.0) });
    }
    let bad = |why| LabError::Invalid(format!("A primitive of the scene cannot be tessellated: {why}."));
    let bound = tessellate::default_bound(geometry);
    let [outer, inner] = [tessellate::outside(geometry, bound), tessellate::inside(geometry, bound)];
    Ok(Solid { outer: Arc::new(outer.map_err(bad)?), inner: Some(Arc::new(inner.map_err(bad)?)), bound: Some(bound) })
}
