//! A scene that is put together: objects with their links, and the meshes that they share.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::{self, FileFormat, MAX_BYTES, Mesh};
use ocb_core::pose::{AS_IT_IS, Pose};
use ocb_core::scene::{DisabledPair, Geometry, MOST_OBJECTS, Scene, SceneObject, tessellate};
use ocb_sandbox::given;

use super::packages::{Packages, Place};
use super::{Found, Imported, shown};
use crate::scene_file::SceneFile;

/// Most triangles and vertices that are read and kept; a file that is used at several scales counts for each.
const MOST_PARTS: usize = 40_000_000;
/// How far a polyhedron may be inside an ellipsoid, as a share of its half axes.
const BOUND: f64 = 0.005;
/// Numbers of a pose nearer to 0 than this are products of rounding errors, and become 0.
const NOTHING: f64 = 1e-90;

/// The shape of an object, as a description states it.
#[derive(Clone, Debug)]
pub enum Shape {
    /// The triangles in a file, scaled along its axes.
    File {
        /// As in [`Packages::find`].
        address: String,
        /// Negative for a mirror.
        scale: [f64; 3],
    },
    /// A primitive.
    Primitive(Geometry),
    /// Triangles that stand for another shape, which the text describes.
    Triangles(Mesh, String),
}

impl Shape {
    /// A polyhedron inside an ellipsoid with these half axes, or a sphere.
    pub fn ellipsoid(half: [f64; 3]) -> Found<Self> {
        let [x, y, z] = half;
        if x == y && y == z {
            return Ok(Self::Primitive(Geometry::Sphere { radius: x }));
        }
        if half.iter().any(|&axis| axis <= 0.0) {
            return Err("the half axes of an ellipsoid must be above 0".to_owned());
        }
        let ball = tessellate::inside(&Geometry::Sphere { radius: 1.0 }, BOUND).map_err(|why| why.to_string())?;
        let mesh = scale_mesh(&ball, half).map_err(|why| why.to_string())?;
        Ok(Self::Triangles(mesh, format!("ellipsoid with half axes {x} {y} {z}")))
    }
}

/// One object.
#[derive(Clone, Debug)]
pub struct Part {
    /// Index of its link.
    pub link: usize,
    /// Its name; it gets another ending if it is taken.
    pub name: String,
    /// Its shape in its own frame.
    pub shape: Shape,
    /// Its frame in the scene.
    pub pose: Pose,
}

/// A file that was read.
#[derive(Clone)]
struct Stored {
    mesh: Arc<Mesh>,
    /// One unit of the file in metres, where it states that.
    metres: f64,
}

/// A scene, and what it is made of so far.
pub struct Assembly {
    packages: Packages,
    links: Vec<String>,
    objects: Vec<SceneObject>,
    link_of: Vec<usize>,
    names: HashSet<String>,
    meshes: HashMap<String, Arc<Mesh>>,
    stored: HashMap<PathBuf, Stored>,
    scaled: HashMap<(PathBuf, [u64; 3]), Geometry>,
    parts: usize,
    notes: BTreeSet<String>,
}

impl Assembly {
    /// No objects yet, of these links.
    pub fn new(packages: Packages, links: Vec<String>) -> Self {
        Self {
            packages,
            links,
            objects: Vec::new(),
            link_of: Vec::new(),
            names: HashSet::new(),
            meshes: HashMap::new(),
            stored: HashMap::new(),
            scaled: HashMap::new(),
            parts: 0,
            notes: BTreeSet::new(),
        }
    }

    /// Says what was left out or converted; the same is said once.
    pub fn note(&mut self, sentence: String) {
        self.notes.insert(sentence);
    }

    /// The link of each object.
    pub fn link_of(&self) -> &[usize] {
        &self.link_of
    }

    /// Adds an object.
    pub fn add(&mut self, part: Part) -> Found<()> {
        let Part { link, name, shape, pose } = part;
        if self.objects.len() == MOST_OBJECTS {
            return Err(format!("it has more than {MOST_OBJECTS} objects; split it"));
        }
        let (geometry, source, scale, licence) = match shape {
            Shape::Primitive(geometry) => {
                (geometry, String::new(), [1.0; 3], self.packages.licence().map(str::to_owned))
            }
            Shape::Triangles(mesh, what) => {
                self.count(&mesh)?;
                let licence = self.packages.licence().map(str::to_owned);
                (SceneFile::keep(&mut self.meshes, mesh), what, [1.0; 3], licence)
            }
            Shape::File { address, scale } => {
                let place = self.packages.find(&address)?;
                (self.scaled(&place, &address, scale)?, address, scale, place.licence)
            }
        };
        let mut name = name;
        while !self.names.insert(name.clone()) {
            name.push('\'');
        }
        let (pose, link_name) = (clean(pose), Some(self.links[link].clone()));
        self.objects.push(SceneObject { name, link: link_name, geometry, pose, source, scale, licence });
        self.link_of.push(link);
        Ok(())
    }

    /// The scene of this name, without these pairs.
    pub fn finish(self, name: &str, disabled: Vec<DisabledPair>) -> Found<Imported> {
        if self.objects.is_empty() {
            return Err("it has no collision geometry (visual geometry is not imported)".to_owned());
        }
        let scene = Scene { name: name.to_owned(), objects: self.objects, disabled };
        scene.check().map_err(|why| why.to_string())?;
        let file = SceneFile { scene, meshes: self.meshes };
        Ok(Imported { file, links: self.links.len(), notes: self.notes.into_iter().collect() })
    }

    /// The geometry of a file at a scale. Coordinates are metres, unless the file states another unit (COLLADA); axes stay.
    fn scaled(&mut self, place: &Place, address: &str, scale: [f64; 3]) -> Found<Geometry> {
        if let Some(zero) = scale.iter().position(|&factor| factor == 0.0) {
            return Err(format!(
                "the scale of {} in {} is 0, which flattens it",
                shown(address),
                ["x", "y", "z"][zero]
            ));
        }
        let key = (place.path.clone(), scale.map(f64::to_bits));
        if let Some(known) = self.scaled.get(&key) {
            return Ok(known.clone());
        }
        let Stored { mesh, metres } = self.stored(place, address)?;
        let factors = scale.map(|factor| factor * metres);
        let mesh = if factors == [1.0; 3] {
            (*mesh).clone()
        } else {
            scale_mesh(&mesh, factors).map_err(|why| format!("the mesh {} at its scale: {why}", shown(address)))?
        };
        self.count(&mesh)?;
        let geometry = SceneFile::keep(&mut self.meshes, mesh);
        self.scaled.insert(key, geometry.clone());
        Ok(geometry)
    }

    fn stored(&mut self, place: &Place, address: &str) -> Found<Stored> {
        if let Some(known) = self.stored.get(&place.path) {
            return Ok(known.clone());
        }
        let bytes = given::read(&place.path, MAX_BYTES as u64)
            .map_err(|e| format!("the mesh {} cannot be read ({e})", shown(address)))?;
        let read = mesh::read(&bytes).map_err(|why| format!("the mesh {} cannot be read ({why})", shown(address)))?;
        self.count(&read.mesh)?;
        let metres = match read.unit {
            Some(unit) if read.format == FileFormat::Collada && unit.metres != 1.0 => {
                self.note(format!("{} is in {} and was converted to metres.", shown(address), shown(&unit.name)));
                unit.metres
            }
            _ => 1.0,
        };
        let stored = Stored { mesh: Arc::new(read.mesh), metres };
        self.stored.insert(place.path.clone(), stored.clone());
        Ok(stored)
    }

    fn count(&mut self, mesh: &Mesh) -> Found<()> {
        self.parts += mesh.triangles().len() + mesh.positions().len();
        if self.parts > MOST_PARTS {
            return Err(format!("its meshes have more than {MOST_PARTS} triangles and vertices; reduce them"));
        }
        Ok(())
    }
}

/// A mesh scaled along its axes. A mirror turns the triangles around, so that their front stays outside.
fn scale_mesh(mesh: &Mesh, factors: [f64; 3]) -> Result<Mesh, mesh::MeshError> {
    let factors = Vector3::from(factors);
    let positions = mesh.positions().iter().map(|p| Point3::from(p.coords.component_mul(&factors))).collect();
    let mirrored = factors.iter().filter(|&&factor| factor < 0.0).count() % 2 == 1;
    let turned = |&[a, b, c]: &[u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
    Mesh::new(positions, mesh.triangles().iter().map(turned).collect())
}

/// Without what rounding left: products of many rotations are not quite one, and what should be 0 may be nearly.
fn clean(pose: Pose) -> Pose {
    let mut pose = if pose.off_rotation() > AS_IT_IS { pose.straightened().unwrap_or(pose) } else { pose };
    for number in pose.linear.iter_mut().chain(pose.translation.iter_mut()) {
        if number.abs() < NOTHING {
            *number = 0.0;
        }
    }
    pose
}
