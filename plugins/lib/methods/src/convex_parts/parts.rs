//! Cutting an object into parts that are nearly convex, and the hulls of these.

use opencollbench_plugin::Mesh;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::SupportMap;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// A convex part: the hull of some points, with or without volume.
#[derive(Debug)]
pub struct Part {
    /// The corners of the hull, and of a part that is flat, more.
    pub points: Vec<Vector>,
    /// How many triangles the hull has; of a flat part, as many as its points would make in its plane.
    pub triangles: usize,
    /// The middle of a ball around it.
    pub middle: Vector,
    /// The ball's radius.
    pub radius: f64,
}

/// How much concavity is left in a part, as V-HACD measures it. So little that the depth decides.
const CONCAVITY: f64 = 0.001;

/// At most 2^`depth` hulls, which together hold all of the surface.
pub fn decompose(mesh: &Mesh<'_>, depth: u32, resolution: u32) -> Vec<Part> {
    let points: Vec<Vector> = mesh.positions.iter().map(|&p| Vector::from_array(p)).collect();
    // parry cuts once more often than this number asks for, and does not put parts together again.
    let max_convex_hulls = 1 << (depth - 1);
    let parameters =
        VHACDParameters { concavity: CONCAVITY, max_convex_hulls, resolution, ..VHACDParameters::default() };
    let cut = VHACD::decompose(&parameters, &points, mesh.triangles, true);
    let parts = cut.voxel_parts().iter().map(|part| part.compute_primitive_intersections(&points, mesh.triangles));
    parts.filter(|points| !points.is_empty()).map(Part::around).collect()
}

impl Part {
    fn around(points: Vec<Vector>) -> Self {
        // What has no volume has no hull as parry makes them, but a furthest point all the same.
        let (points, triangles) = match try_convex_hull(&points) {
            Ok((corners, triangles)) => (corners, triangles.len()),
            Err(_) => {
                let triangles = points.len().saturating_sub(2);
                (points, triangles)
            }
        };
        let limit = |pick: fn(Vector, Vector) -> Vector| points.iter().copied().reduce(pick).unwrap_or_default();
        let middle = 0.5 * (limit(Vector::min) + limit(Vector::max));
        let radius = points.iter().map(|&p| (p - middle).length()).fold(0.0, f64::max);
        Self { points, triangles, middle, radius }
    }
}

impl SupportMap for Part {
    #[inline]
    fn local_support_point(&self, direction: Vector) -> Vector {
        let further = |p: Vector, q: Vector| if q.dot(direction) > p.dot(direction) { q } else { p };
        self.points.iter().copied().reduce(further).unwrap_or_default()
    }
}
