//! What may stand for an object.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Point3;
use ocb_advice::Watch;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, around, tessellate};

use super::body::Body;
use super::{Make, Simplified, grown};
use crate::model::{BodyKind, FRONTIER, ReduceTerms};
use crate::scene_file::SceneFile;
use crate::{LabError, Result};

/// A curved body is known to this share of the tolerance.
const PRECISION: f64 = 1.0 / 20.0;
/// But to this share of the usual bound at best, which limits the triangles of its polyhedra.
const FINEST: f64 = 1.0 / 50.0;
/// A hull is larger by this share, so that rounding leaves no vertex outside.
const HULL: f64 = 1e-9;
/// So are the hulls of parts, which have to overlap where the object was cut.
const PART: f64 = 1e-6;

/// A body that may stand for an object, or the object itself.
#[derive(Clone, Debug)]
pub struct StandIn {
    /// Which kind.
    pub kind: BodyKind,
    /// Its geometry.
    pub geometry: Geometry,
    /// Where its own frame lies in the object's.
    pub place: Pose,
    /// Its triangles, where it is a mesh.
    pub mesh: Option<Arc<Mesh>>,
    /// The convex hulls that it consists of, where it is several.
    pub hulls: Vec<Arc<Mesh>>,
    /// What an algorithm has to do with, about: triangles; 1 for a ball, 2 for a capsule, 6 for a box or a cylinder.
    pub elements: u64,
    pub(super) body: Arc<Body>,
}

/// All that may stand for a geometry, the simplest first and the object itself last; nothing when it was stopped.
pub fn of<E: From<LabError>>(
    scene: &SceneFile,
    geometry: &Geometry,
    name: &str,
    terms: ReduceTerms,
    make: Make<E>,
    watch: &dyn Watch,
) -> Result<Option<Vec<StandIn>>, E> {
    let Geometry::Mesh { sha256, solid } = geometry else {
        // A primitive is as simple as an object can be.
        return Ok(Some(vec![primitive(BodyKind::Object, geometry, Pose::identity(), terms)?]));
    };
    let object = scene.meshes.get(sha256).ok_or_else(|| LabError::fault("A scene lacks a mesh", sha256))?;
    let Some(made) = make(name, object)? else { return Ok(None) };
    let mut all = Vec::new();
    let used: Vec<Point3<f64>> = {
        let mut used: Vec<u32> = object.triangles().as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        used.into_iter().map(|v| object.positions()[v as usize]).collect()
    };
    type Around = fn(&[Point3<f64>]) -> Option<around::Placed>;
    let bodies: [(BodyKind, Around); 3] =
        [(BodyKind::Sphere, around::ball), (BodyKind::Capsule, around::capsule), (BodyKind::Box, around::cuboid)];
    for (kind, around) in bodies {
        if let Some((geometry, place)) = around(&used) {
            all.push(primitive(kind, &geometry, place, terms)?);
        }
    }
    let own = mesh(BodyKind::Object, object.clone(), *solid);
    let Simplified { levels, hull, parts } = made;
    all.extend(hull.and_then(|hull| contains(mesh(BodyKind::Hull, scaled(&hull, HULL)?, true), &own)));
    all.extend(parts.iter().filter_map(|parts| contains(hulls(parts)?, &own)));
    for level in levels.into_iter().filter(|level| level.triangles().len() < object.triangles().len()) {
        match terms.outside_only {
            true => all.extend(containing(&level, &own, &used, terms, watch)),
            false => all.push(mesh(BodyKind::Level, level, *solid)),
        }
    }
    all.retain(|stand_in| stand_in.elements < own.elements);
    all.sort_by_key(|stand_in| stand_in.elements);
    all.push(own);
    Ok(Some(all))
}

fn mesh(kind: BodyKind, mesh: Arc<Mesh>, solid: bool) -> StandIn {
    let mut kept = HashMap::new();
    let geometry = match SceneFile::keep(&mut kept, Mesh::clone(&mesh)) {
        Geometry::Mesh { sha256, .. } => Geometry::Mesh { sha256, solid },
        other => other,
    };
    let body = if solid { Body::solid(mesh.clone()) } else { Body::surface(mesh.clone()) };
    let elements = mesh.triangles().len() as u64;
    StandIn {
        kind,
        geometry,
        place: Pose::identity(),
        mesh: Some(mesh),
        hulls: Vec::new(),
        elements,
        body: Arc::new(body),
    }
}

fn primitive(kind: BodyKind, geometry: &Geometry, place: Pose, terms: ReduceTerms) -> Result<StandIn> {
    let bad = |why| LabError::Invalid(format!("A primitive of the scene cannot be tessellated: {why}."));
    let usual = tessellate::default_bound(geometry);
    let bound = usual.min((PRECISION * terms.tolerance).max(FINEST * usual));
    let placed = |mesh: Mesh| -> Result<Arc<Mesh>> {
        let positions = mesh.positions().iter().map(|p| place.apply(p)).collect();
        let moved = Mesh::new(positions, mesh.triangles().to_vec());
        moved.map(Arc::new).map_err(|e| LabError::fault("A primitive cannot be placed", e))
    };
    let outer = placed(tessellate::outside(geometry, bound).map_err(bad)?)?;
    let inner = match geometry {
        Geometry::Box { .. } => None,
        _ => Some(placed(tessellate::inside(geometry, bound).map_err(bad)?)?),
    };
    let elements = match geometry {
        Geometry::Sphere { .. } => 1,
        Geometry::Capsule { .. } => 2,
        _ => 6,
    };
    let body = Arc::new(Body::between(outer, inner));
    Ok(StandIn { kind, geometry: geometry.clone(), place, mesh: None, hulls: Vec::new(), elements, body })
}

/// Only what certainly contains the object. A foreign library made most of it.
fn contains(stand_in: StandIn, own: &StandIn) -> Option<StandIn> {
    stand_in.body.surrounds(&own.body).then_some(stand_in)
}

/// A convex mesh larger by this share.
fn scaled(mesh: &Mesh, by: f64) -> Option<Arc<Mesh>> {
    let centre = Point3::from(around::mean(mesh.positions())?);
    let positions = mesh.positions().iter().map(|p| centre + (p - centre) * (1.0 + by)).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).ok().map(Arc::new)
}

/// Convex hulls as one mesh.
fn hulls(parts: &[Arc<Mesh>]) -> Option<StandIn> {
    let parts: Vec<Arc<Mesh>> = parts.iter().map(|part| scaled(part, PART)).collect::<Option<_>>()?;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for part in &parts {
        let first = positions.len() as u32;
        positions.extend_from_slice(part.positions());
        triangles.extend(part.triangles().iter().map(|corners| corners.map(|v| v + first)));
    }
    let whole = mesh(BodyKind::Hulls, Arc::new(Mesh::new(positions, triangles).ok()?), true);
    let body = Arc::new(Body::union(whole.mesh.clone()?, &parts));
    Some(StandIn { hulls: parts, body, ..whole })
}

/// A level that has grown just so far that it contains the object; nothing where it would have to grow too much.
fn containing(
    level: &Mesh,
    own: &StandIn,
    corners: &[Point3<f64>],
    terms: ReduceTerms,
    watch: &dyn Watch,
) -> Option<StandIn> {
    // Where nothing comes near, more than the tolerance does no harm.
    let most = FRONTIER.into_iter().fold(1.0, f64::max) * terms.tolerance;
    let grown = grown::around(level, &own.body.outer, corners, most, watch)?;
    contains(mesh(BodyKind::Level, grown, true), own)
}
