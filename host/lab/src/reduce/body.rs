//! A shape made ready for the oracle, between two polyhedra where it is curved.

use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

use super::cover;

/// Lengths below this share of the size are rounding.
pub const ROUNDING: f64 = 1e-11;

/// Which points are in the body.
#[derive(Debug)]
enum Inside {
    /// Only its surface counts.
    Nothing,
    /// What its surface encloses; of a surface that is not closed nothing is known.
    Enclosed,
    /// What any of these encloses. Together they are the whole surface, and they may overlap.
    Parts(Vec<Shape>),
}

/// Is a body in another one?
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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

    /// A solid body in one closed polyhedron and around another one; absent where both are the same.
    pub fn between(outer: Arc<Mesh>, inner: Option<Arc<Mesh>>) -> Self {
        Self::of(outer, inner, Inside::Enclosed)
    }

    /// A mesh that stands for a solid body.
    pub fn solid(mesh: Arc<Mesh>) -> Self {
        Self::of(mesh, None, Inside::Enclosed)
    }

    /// A mesh that consists of these closed ones, each of which is solid.
    pub fn union(mesh: Arc<Mesh>, parts: &[Arc<Mesh>]) -> Self {
        Self::of(mesh, None, Inside::Parts(parts.iter().cloned().map(Shape::new).collect()))
    }

    fn of(outer: Arc<Mesh>, inner: Option<Arc<Mesh>>, inside: Inside) -> Self {
        let centre = outer.bounds().center();
        let radius = outer.positions().iter().map(|p| (p - centre).norm()).fold(0.0, f64::max) * (1.0 + ROUNDING);
        Self { outer: Shape::new(outer), inner: inner.map(Shape::new), inside, centre, radius }
    }

    /// Does it certainly contain all of a mesh in the same frame?
    pub fn surrounds(&self, mesh: &Self) -> bool {
        let here = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
        match &self.inside {
            Inside::Nothing => false,
            Inside::Parts(parts) => cover::covers(parts, &mesh.outer),
            Inside::Enclosed => {
                let pair = Pair::new(&self.outer, &mesh.outer);
                !pair.hit(&here)
                    && pair.parts_of_b_in_a(&here).is_some_and(|parts| parts.into_iter().all(|inside| inside))
            }
        }
    }

    /// The polyhedron in it.
    pub fn inner(&self) -> &Shape {
        self.inner.as_ref().unwrap_or(&self.outer)
    }

    /// Are its two polyhedra different ones?
    pub fn is_between(&self) -> bool {
        self.inner.is_some()
    }

    /// Is part of another body, whose outer surface does not meet this one's, inside it? This one's pose and the other's are given.
    pub fn contains(&self, own: &Pose, other: &Self, its: &Pose) -> Contains {
        let configuration = Configuration { pose_a: *own, pose_b: *its };
        let in_it = |solid: &Shape| match Pair::new(solid, &other.outer).parts_of_b_in_a(&configuration) {
            None => Contains::Perhaps,
            Some(parts) if !parts.contains(&true) => Contains::No,
            // What is in its outer polyhedron need not be in the body.
            Some(_) if self.is_between() => Contains::Perhaps,
            Some(_) => Contains::Yes,
        };
        match &self.inside {
            Inside::Nothing => Contains::No,
            Inside::Enclosed => in_it(&self.outer),
            Inside::Parts(parts) => parts.iter().map(in_it).max().unwrap_or(Contains::No),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use ocb_core::scene::{Geometry, tessellate};

    use super::super::tests::ring;
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
    fn a_solid_that_is_not_convex_has_an_inside_if_it_is_closed() {
        let ring = Arc::new(ring(40, 40));
        let size = [0.05; 3];
        let grain = Body::surface(Arc::new(tessellate::outside(&Geometry::Box { size }, 0.0).expect("a box")));
        let (solid, surface) = (Body::solid(ring.clone()), Body::surface(ring.clone()));
        // In its hole, in the ring, outside.
        for (x, inside) in [(0.0, Contains::No), (1.0, Contains::Yes), (2.0, Contains::No)] {
            assert_eq!(solid.contains(&at(0.0), &grain, &at(x)), inside, "{x}");
            assert_eq!(surface.contains(&at(0.0), &grain, &at(x)), Contains::No);
        }
        let open = Arc::new(Mesh::new(ring.positions().to_vec(), ring.triangles()[1..].to_vec()).expect("a mesh"));
        assert_eq!(Body::solid(open.clone()).contains(&at(0.0), &grain, &at(2.0)), Contains::Perhaps);
        // Of several parts, the one that is known to contain it decides.
        for (parts, inside) in [(vec![open.clone()], Contains::Perhaps), (vec![open.clone(), ring], Contains::Yes)] {
            assert_eq!(Body::union(open.clone(), &parts).contains(&at(0.0), &grain, &at(1.0)), inside);
        }
    }
}
