//! Stand-ins that people use without a certificate: boxes and convex hulls around the objects.
//!
//! Both contain the object, so as solid bodies they are never further apart than the objects; how much nearer they are,
//! nothing says.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::lod::{Lod, LodPair};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

/// A convex body around an object.
#[derive(Clone, Debug)]
pub struct Proxy {
    lod: Lod,
    /// Outward normals and points of the planes around it.
    planes: Vec<(Vector3<f64>, Point3<f64>)>,
}

impl Proxy {
    /// The box along the axes of the object's file.
    pub fn around(mesh: &Mesh) -> Option<Self> {
        let (min, max) = (mesh.bounds().min, mesh.bounds().max);
        let corner = |i: usize| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
            Point3::new(pick(0), pick(1), pick(2))
        };
        // Pairs of triangles, seen from outside.
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Self::convex(Mesh::new((0..8).map(corner).collect(), triangles).ok()?)
    }

    /// The convex hull; `None` where there is none (a flat object).
    pub fn hull(mesh: &Mesh) -> Option<Self> {
        Self::convex(hull(mesh)?)
    }

    fn convex(mesh: Mesh) -> Option<Self> {
        let planes = planes(&mesh);
        Some(Self { lod: Lod::exact(Shape::new(Arc::new(mesh))), planes })
    }

    /// How many triangles it has.
    pub fn triangles(&self) -> usize {
        self.lod.shape().triangles().len()
    }

    fn contains(&self, point: &Point3<f64>) -> bool {
        self.planes.iter().all(|(normal, on)| normal.dot(&(point - on)) <= 0.0)
    }
}

/// Outward normals and points of the planes of all triangles.
pub(crate) fn planes(mesh: &Mesh) -> Vec<(Vector3<f64>, Point3<f64>)> {
    let plane = |t: u32| {
        let [a, b, c] = mesh.corners(t);
        Some(((b - a).cross(&(c - a)).try_normalize(0.0)?, a))
    };
    (0..mesh.triangles().len() as u32).filter_map(plane).collect()
}

/// The convex hull of a mesh; `None` where there is none.
pub fn hull(mesh: &Mesh) -> Option<Mesh> {
    hull_of(mesh.triangles().as_flattened().iter().map(|&v| mesh.positions()[v as usize]))
}

/// The convex hull of points; `None` where there is none.
pub(crate) fn hull_of(points: impl Iterator<Item = Point3<f64>>) -> Option<Mesh> {
    let mut points: Vec<Vector> = points.map(|p| Vector::new(p.x, p.y, p.z)).collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    points.dedup();
    let (corners, triangles) = try_convex_hull(&points).ok()?;
    Mesh::new(corners.iter().map(|p| Point3::new(p.x, p.y, p.z)).collect(), triangles).ok()
}

/// The distance of two proxies as solid bodies, as f64 computes it.
pub fn distance([a, b]: [&Proxy; 2], configuration: &Configuration) -> f64 {
    let Configuration { pose_a, pose_b } = configuration;
    // A corner of each in the other's frame: one inside the other is a distance of nothing.
    let corner_b = pose_b.apply(&b.lod.shape().positions()[0]) - pose_a.translation;
    let corner_a = pose_a.apply(&a.lod.shape().positions()[0]) - pose_b.translation;
    if a.contains(&(pose_a.linear.transpose() * corner_b)) || b.contains(&(pose_b.linear.transpose() * corner_a)) {
        return 0.0;
    }
    LodPair::new(&a.lod, &b.lod).distance(configuration, 0.0).lo
}
