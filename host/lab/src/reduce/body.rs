//! A shape made ready for the oracle, between two polyhedra where it is curved.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

/// Lengths below this share of the size are rounding.
pub const ROUNDING: f64 = 1e-11;
/// Triangles of a mesh that is tried for being convex, at most: each is compared with each vertex.
const MOST_PLANES: usize = 4096;

/// Which points are in the body.
#[derive(Debug)]
enum Inside {
    /// Only its surface counts.
    Nothing,
    /// What is behind all of these planes: outward normals, and how far along them.
    Planes(Vec<(Vector3<f64>, f64)>),
    /// A solid that is not convex: nothing is known of any point.
    Unknown,
}

/// Is a point in a body?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contains {
    /// Certainly not.
    No,
    /// It may be.
    Perhaps,
    /// Certainly.
    Yes,
}

/// A shape in the frame of its object.
#[derive(Debug)]
pub struct Body {
    /// It is in this polyhedron, or is this mesh.
    pub outer: Shape,
    /// It contains this polyhedron; absent where both are the same.
    inner: Option<Shape>,
    inside: Inside,
    /// The body is in this ball.
    pub centre: Point3<f64>,
    /// Its radius.
    pub radius: f64,
}

impl Body {
    /// A mesh of which the surface counts.
    pub fn surface(mesh: Arc<Mesh>) -> Self {
        Self::of(mesh, None, Inside::Nothing)
    }

    /// A convex body in one polyhedron and around another one; absent where both are the same. Both are closed and convex.
    pub fn convex(outer: Arc<Mesh>, inner: Option<Arc<Mesh>>) -> Self {
        let planes = planes(&outer);
        Self::of(outer, inner, Inside::Planes(planes))
    }

    /// A mesh that stands for a solid body. If it is not closed and convex, or has too many triangles to find that out, nothing is
    /// known of what is inside.
    pub fn solid(mesh: Arc<Mesh>) -> Self {
        let body = Self::of(mesh.clone(), None, Inside::Unknown);
        if mesh.triangles().len() > MOST_PLANES || !body.outer.is_closed() {
            return body;
        }
        let planes = planes(&mesh);
        let rounding = ROUNDING * mesh.bounds().min.coords.amax().max(mesh.bounds().max.coords.amax());
        let behind = |p: &Point3<f64>| beyond(&planes, &p.coords, rounding) <= rounding;
        match mesh.positions().iter().all(behind) {
            true => Self { inside: Inside::Planes(planes), ..body },
            false => body,
        }
    }

    fn of(outer: Arc<Mesh>, inner: Option<Arc<Mesh>>, inside: Inside) -> Self {
        let centre = outer.bounds().center();
        let radius = outer.positions().iter().map(|p| (p - centre).norm()).fold(0.0, f64::max) * (1.0 + ROUNDING);
        Self { outer: Shape::new(outer), inner: inner.map(Shape::new), inside, centre, radius }
    }

    /// Does it certainly contain all of a mesh in the same frame? Its surface does not meet the mesh, and each part of the mesh has
    /// a vertex inside.
    pub fn surrounds(&self, mesh: &Self) -> bool {
        let Inside::Planes(planes) = &self.inside else { return false };
        let rounding = ROUNDING * (self.radius + self.centre.coords.norm());
        let here = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
        mesh.outer.part_vertices().all(|p| beyond(planes, &p.coords, rounding) < -rounding)
            && !Pair::new(&self.outer, &mesh.outer).hit(&here)
    }

    /// The polyhedron in it.
    pub fn inner(&self) -> &Shape {
        self.inner.as_ref().unwrap_or(&self.outer)
    }

    /// Are its two polyhedra different ones?
    pub fn is_between(&self) -> bool {
        self.inner.is_some()
    }

    /// Is a body, whose surface does not meet this one's, inside it? The other one's poses and this one's are given.
    pub fn contains(&self, own: &Pose, other: &Self, its: &Pose) -> Contains {
        let planes = match &self.inside {
            Inside::Nothing => return Contains::No,
            Inside::Unknown => return Contains::Perhaps,
            Inside::Planes(planes) => planes,
        };
        let size = self.radius + (its.translation - own.translation).norm() + other.radius + other.centre.coords.norm();
        let rounding = ROUNDING * (size + self.centre.coords.norm() + own.translation.amax() + its.translation.amax());
        let mut found = Contains::No;
        for start in other.outer.part_vertices() {
            let p = own.linear.transpose() * (its.apply(start).coords - own.translation);
            match beyond(planes, &p, rounding) {
                off if off > rounding => {}
                // Of a body between two polyhedra only the outer one's planes are known.
                off if off < -rounding && !self.is_between() => return Contains::Yes,
                _ => found = Contains::Perhaps,
            }
        }
        found
    }
}

/// Of each triangle: its outward normal, and how far along that it is.
fn planes(mesh: &Mesh) -> Vec<(Vector3<f64>, f64)> {
    let plane = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle);
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
        Some((normal, normal.dot(&a.coords)))
    };
    (0..mesh.triangles().len() as u32).filter_map(plane).collect()
}

/// How far a point is beyond the plane that it is farthest beyond of; the first by more than `enough` will do.
fn beyond(planes: &[(Vector3<f64>, f64)], p: &Vector3<f64>, enough: f64) -> f64 {
    let mut most = f64::NEG_INFINITY;
    for (normal, at) in planes {
        most = most.max(normal.dot(p) - at);
        if most > enough {
            break;
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use ocb_core::scene::{Geometry, tessellate};
    use ocb_core::stock;

    use super::*;

    fn at(x: f64) -> Pose {
        Pose { translation: Vector3::new(x, 0.0, 0.0), ..Pose::identity() }
    }

    #[test]
    fn a_body_in_another_is_found_also_where_one_of_several_parts_is() {
        let cuboid = |size: f64| Arc::new(tessellate::outside(&Geometry::Box { size: [size; 3] }, 0.0).expect("a box"));
        let (large, small) = (Body::solid(cuboid(2.0)), Body::surface(cuboid(0.5)));
        assert_eq!(large.contains(&at(7.0), &small, &at(7.5)), Contains::Yes);
        assert_eq!(large.contains(&at(7.0), &small, &at(9.0)), Contains::No);
        assert_eq!(small.contains(&at(7.5), &large, &at(7.0)), Contains::No);
        // Two boxes as one mesh: the first outside, the second inside.
        let one = cuboid(0.5);
        let positions = [3.0, 0.0].iter().flat_map(|x| one.positions().iter().map(move |p| p + Vector3::x() * *x));
        let triangles = one.triangles().iter().copied();
        let both =
            Mesh::new(positions.collect(), triangles.clone().chain(triangles.map(|t| t.map(|v| v + 8))).collect());
        let both = Body::surface(Arc::new(both.expect("a mesh")));
        assert_eq!(large.contains(&at(0.0), &both, &at(0.0)), Contains::Yes);
        assert_eq!(large.contains(&at(0.0), &both, &at(2.0)), Contains::No);
    }

    #[test]
    fn of_a_solid_that_is_not_convex_nothing_is_known() {
        let knot = Arc::new(stock::generate("torus-knot", 600).expect("a knot"));
        let (knot, ball) = (Body::solid(knot.clone()), Body::surface(knot));
        assert_eq!(knot.contains(&at(0.0), &ball, &at(100.0)), Contains::Perhaps);
    }
}
