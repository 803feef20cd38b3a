//! parry's triangle mesh behind the plugin interface, in the precision of whatever its parent calls `library`: this file
//! belongs to both modules beside it.

use super::library::math::{Matrix, Pose, Real, Rotation, Vector};
use super::library::query::{self, ClosestPoints, ShapeDistance, Unsupported};
use super::library::shape::TriMesh;
use super::{narrow, widen};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Refusal, Scene,
    Separation,
};

/// parry's triangle mesh against parry's triangle mesh.
#[derive(Debug, Default)]
pub struct Parry;

impl Algorithm for Parry {
    const ABOUT: About = super::ABOUT;

    type Object = TriMesh;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<TriMesh> {
        let vertices = mesh.positions.iter().map(|&p| vector(p)).collect();
        TriMesh::new(vertices, mesh.triangles.to_vec())
            .map_err(|error| Refusal::Error(format!("parry does not take the mesh: {error}")))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let (pose_a, pose_b) = (pose(&a), pose(&b));
        if work.is_counting() {
            let pose12 = pose_a.inv_mul(&pose_b);
            return Ok(match super::counted::first_contact(a.object, b.object, &pose12, work) {
                Some([a, b]) => Collision::Pair(a, b),
                None => Collision::Apart,
            });
        }
        let answer = query::intersection_test(&pose_a, a.object, &pose_b, b.object).map_err(unsupported)?;
        Ok(if answer.intersecting { Collision::Pair(answer.subshape1, answer.subshape2) } else { Collision::Apart })
    }
}

impl Parry {
    /// Are the surfaces no further apart than this, as parry finds it? More than 0: by its search for the closest points
    /// within a margin.
    pub fn within(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        reach: f64,
        work: &mut impl Count,
    ) -> Answer<bool> {
        if reach <= 0.0 {
            return Ok(self.collide(a, b, work)? != Collision::Apart);
        }
        let found = query::closest_points(&pose(&a), a.object, &pose(&b), b.object, narrow(reach));
        Ok(found.map_err(unsupported)? != ClosestPoints::Disjoint)
    }
}

impl Contacts for Parry {
    /// parry has no such query; this is its collision query without the early end.
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        let pose12 = pose(&a).inv_mul(&pose(&b));
        super::counted::each_contact(a.object, b.object, &pose12, work, |a, b| {
            found.push(a, b);
            true
        });
        Ok(())
    }
}

impl Distance for Parry {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let (pose_a, pose_b) = (pose(&a), pose(&b));
        let answer: ShapeDistance = if work.is_counting() {
            super::counted::distance(a.object, b.object, &pose_a.inv_mul(&pose_b), work)
        } else {
            query::distance(&pose_a, a.object, &pose_b, b.object).map_err(unsupported)?
        };
        // The distance query names the triangles but not the points; for two triangles those cost next to nothing.
        let (triangle_a, triangle_b) = (a.object.triangle(answer.subshape1), b.object.triangle(answer.subshape2));
        let points = match query::closest_points(&pose_a, &triangle_a, &pose_b, &triangle_b, Real::MAX) {
            Ok(ClosestPoints::WithinMargin(on_a, on_b)) => Some([on_a, on_b].map(|point| point.to_array().map(widen))),
            // When triangles intersect, parry does not say where.
            _ => None,
        };
        let triangles = Some([answer.subshape1, answer.subshape2]);
        Ok(Separation { distance: widen(answer.distance), points, triangles })
    }
}

/// A mesh knows nothing of others.
impl Scene for Parry {}

/// parry keeps rotations as quaternions.
fn pose(placed: &Placed<'_, Parry>) -> Pose {
    let [x, y, z] = placed.pose.rotation().map(vector);
    let rotation = Matrix::from_cols(x, y, z).transpose();
    Pose::from_parts(vector(placed.pose.translation()), Rotation::from_mat3(&rotation))
}

fn vector(p: [f64; 3]) -> Vector {
    Vector::from_array(p.map(narrow))
}

fn unsupported(_: Unsupported) -> Refusal {
    Refusal::Unsupported
}
