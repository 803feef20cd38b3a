//! What plugins are compared with the reference on: the same questions for all, certified once per process.

use std::sync::{Arc, LazyLock};

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::{Method, Placed, Sampling, Separation};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::sampling::Plan;
use rayon::prelude::*;

use super::smoke::{TRIANGLES, certified, smoke_object};
use crate::{LabError, Result};

/// Pairs of stock objects with their sizes: like and unlike, the larger one first and second.
const SCENES: [(&str, f64, &str, f64); 5] = [
    ("torus-knot", 1.0, "torus-knot", 1.0),
    ("castle", 1.0, "sphere", 0.25),
    ("chair", 0.5, "sponge", 1.0),
    ("gear", 1.0, "gear", 1.0),
    ("pipes", 1.0, "wreath", 1.0),
];
/// Surface distances as shares of L; 0 is as close as the weakest precision can tell.
const DISTANCES: [f64; 5] = [0.2, 0.01, 1e-3, 1e-5, 0.0];
/// Crossings as shares of the scene's size.
const DEPTHS: [f64; 2] = [-1e-2, -1e-5];
/// Placements per distance and depth.
const RAYS: u32 = 3;
/// Of the small pair: placements, and neighbours of each.
const SMALL_RAYS: u32 = 24;
const NEIGHBOURS: usize = 60;

/// A pair of objects with certified configurations.
pub struct Scene {
    /// Its name in the report.
    pub name: String,
    /// Object A.
    pub mesh_a: Arc<Mesh>,
    /// Object B; absent when it is the same object.
    pub mesh_b: Option<Arc<Mesh>>,
    /// A as the oracle sees it.
    pub a: Shape,
    /// B.
    pub b: Shape,
    /// The configurations with their truth.
    pub placed: Vec<Placed>,
}

/// All scenes.
pub struct Suite {
    /// Objects of some hundred triangles.
    pub scenes: Vec<Scene>,
    /// Two objects of so few triangles that hundreds of thousands of questions take seconds.
    pub small: Scene,
}

/// The suite.
pub fn suite() -> Result<&'static Suite> {
    static SUITE: LazyLock<Result<Suite>> = LazyLock::new(make);
    SUITE.as_ref().map_err(|e| LabError::Fault(e.to_string()))
}

fn make() -> Result<Suite> {
    let scenes: Result<Vec<Scene>> = SCENES.par_iter().map(|scene| stock_scene(*scene)).collect();
    Ok(Suite { scenes: scenes?, small: small_scene()? })
}

fn stock_scene((a, size_a, b, size_b): (&str, f64, &str, f64)) -> Result<Scene> {
    let mesh_a = scaled(&*smoke_object(a)?, size_a)?;
    let mesh_b = if a == b { None } else { Some(scaled(&*smoke_object(b)?, size_b)?) };
    let mut scene = scene(format!("{a} and {b}, {TRIANGLES} triangles each"), mesh_a, mesh_b);
    let apart = DISTANCES.map(|distance| Separation::Relative { distance });
    let crossing = DEPTHS.map(|of_size| Separation::Step { of_size });
    for separation in apart.into_iter().chain(crossing) {
        let placed = place(&scene, separation, RAYS)?;
        scene.placed.extend(placed);
    }
    Ok(scene)
}

fn scaled(mesh: &Mesh, size: f64) -> Result<Arc<Mesh>> {
    let positions = mesh.positions().iter().map(|p| (p.coords * size).into()).collect();
    made(positions, mesh.triangles().to_vec())
}

fn made(positions: Vec<Point3<f64>>, triangles: Vec<[u32; 3]>) -> Result<Arc<Mesh>> {
    let mesh = Mesh::new(positions, triangles).and_then(Mesh::to_f32_representable);
    mesh.map(Arc::new).map_err(|e| LabError::fault("Making an object of the suite failed", e))
}

fn scene(name: String, mesh_a: Arc<Mesh>, mesh_b: Option<Arc<Mesh>>) -> Scene {
    let a = Shape::new(mesh_a.clone());
    let b = mesh_b.as_ref().map_or_else(|| a.clone(), |mesh| Shape::new(mesh.clone()));
    Scene { name, mesh_a, mesh_b, a, b, placed: Vec::new() }
}

fn place(scene: &Scene, separation: Separation, count: u32) -> Result<Vec<Placed>> {
    let method = Method::Sphere { sampling: Sampling::Count { count }, seed: 7 };
    let plan = Plan::new(&scene.a, &scene.b, &method, separation)
        .map_err(|e| LabError::fault("Placing the configurations of the suite failed", e))?;
    Ok((0..plan.units()).into_par_iter().flat_map_iter(|unit| plan.place(unit).placed).collect())
}

/// An octahedron and a tetrahedron, at every distance, with many neighbours of each configuration.
fn small_scene() -> Result<Scene> {
    let corners =
        [[1.0, 0.0, 0.0], [-1.0, 0.125, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.25], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mesh_a = made(corners.map(Point3::from).to_vec(), faces.to_vec())?;
    let corners = [[0.0, 0.0, 0.0], [0.75, 0.0, 0.0], [0.0, 0.5, 0.0], [0.125, 0.125, 0.625]];
    let mesh_b = made(corners.map(Point3::from).to_vec(), vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
    let mut scene = scene("an octahedron and a tetrahedron".into(), mesh_a, Some(mesh_b));
    let apart = [0.5, 0.1, 0.01, 1e-3, 1e-4, 1e-6, 0.0].map(|distance| Separation::Relative { distance });
    let crossing = DEPTHS.map(|of_size| Separation::Step { of_size });
    let mut found = Vec::new();
    for separation in apart.into_iter().chain(crossing) {
        found.extend(place(&scene, separation, SMALL_RAYS)?);
    }
    let pair = Pair::new(&scene.a, &scene.b);
    let neighbours = |(number, placed): (usize, &Placed)| {
        let mut numbers = Numbers::new(number as u64);
        let gap = placed.truth.distance_hi.max(placed.truth.margin).max(1e-7);
        let mut unit = || numbers.bits() as f64 / 2f64.powi(63) - 1.0;
        let moves: Vec<Vector3<f64>> = (0..NEIGHBOURS).map(|_| Vector3::new(unit(), unit(), unit()) * gap).collect();
        let near = moves.into_iter().map(|by| {
            let mut configuration = placed.configuration;
            configuration.pose_b.translation += by;
            certified(&pair, configuration)
        });
        near.collect::<Vec<_>>()
    };
    let near: Vec<Placed> = found.par_iter().enumerate().flat_map_iter(neighbours).collect();
    scene.placed = found.into_iter().chain(near).collect();
    Ok(scene)
}
