//! The objects of a scene as triangles: meshes as they are, primitives between two polyhedra.

use std::collections::HashMap;
use std::mem::discriminant;
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

/// What the objects of a scene are, as [`Solid::describe`] tells it, without making all of them: the usual bound grows with the size
/// of a primitive, so that those of a kind have the same number of triangles.
pub fn described(file: &SceneFile) -> Result<Vec<WorkloadObject>> {
    let mut known = HashMap::new();
    let mut all = Vec::new();
    for object in &file.scene.objects {
        let (name, geometry) = (&object.name, &object.geometry);
        let kind = (discriminant(geometry), matches!(geometry, Geometry::Capsule { length: 0.0, .. }));
        let described = match known.get(&kind) {
            Some(&triangles) => {
                WorkloadObject { name: name.clone(), triangles, bound: Some(tessellate::default_bound(geometry)) }
            }
            None => solid(file, geometry)?.describe(name),
        };
        if !matches!(geometry, Geometry::Mesh { .. }) {
            known.insert(kind, described.triangles);
        }
        all.push(described);
    }
    Ok(all)
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

#[cfg(test)]
mod tests {
    use ocb_core::pose::Pose;
    use ocb_core::scene::{Scene, SceneObject};
    use ocb_core::stock;

    use super::*;

    #[test]
    fn objects_are_described_as_those_that_are_made() {
        let mut meshes = HashMap::new();
        let mut shapes = vec![SceneFile::keep(&mut meshes, stock::generate("torus-knot", 800).expect("a mesh"))];
        for size in [1.0, 0.037, 1234.5] {
            shapes.extend([
                Geometry::Sphere { radius: size },
                Geometry::Box { size: [size, 1.0, 2.0] },
                Geometry::Cylinder { radius: size, length: 3.0 },
                Geometry::Capsule { radius: size, length: 0.5 },
                Geometry::Capsule { radius: size, length: 0.0 },
            ]);
        }
        let object = |(i, geometry): (usize, Geometry)| SceneObject {
            name: format!("object {i}"),
            link: None,
            geometry,
            pose: Pose::identity(),
            source: String::new(),
            scale: [1.0; 3],
            licence: None,
        };
        let objects: Vec<_> = shapes.into_iter().enumerate().map(object).collect();
        let scene = Scene { name: String::new(), objects, disabled: Vec::new() };
        let file = SceneFile { scene, meshes };
        let made = solids(&file).expect("they can be made");
        let made: Vec<_> = made.iter().zip(&file.scene.objects).map(|(solid, it)| solid.describe(&it.name)).collect();
        assert_eq!(described(&file).expect("they can be described"), made);
    }
}
