//! What parry's mesh queries do, written out with parry's own parts, because parry does not count.
//!
//! A mesh is a composite shape to parry: the hierarchy of A is searched with the box around the whole of B, and each
//! triangle of A that is left is then queried against B, whose hierarchy is searched with the box around that triangle.

use std::cell::RefCell;

use super::library::bounding_volume::{Aabb, BoundingVolume};
use super::library::math::{Pose, Real};
use super::library::partitioning::BvhNode;
use super::library::query::{self, ShapeDistance};
use super::library::shape::{Shape, TriMesh, Triangle};
use opencollbench_plugin::Count;

/// As `query::intersection_test`.
pub fn first_contact(a: &TriMesh, b: &TriMesh, pose12: &Pose, work: &mut impl Count) -> Option<[u32; 2]> {
    let mut found = None;
    each_contact(a, b, pose12, work, |a, b| {
        found = Some([a, b]);
        false
    });
    found
}

/// The same for all contacts, until the visitor says false.
pub fn each_contact(
    a: &TriMesh,
    b: &TriMesh,
    pose12: &Pose,
    work: &mut impl Count,
    mut visit: impl FnMut(u32, u32) -> bool,
) {
    let work = RefCell::new(work);
    let meets = |bounds: Aabb| {
        let work = &work;
        move |node: &BvhNode| {
            work.borrow_mut().bv_tests(1);
            node.aabb().intersects(&bounds)
        }
    };
    let pose21 = pose12.inverse();
    for id_a in a.bvh().leaves(meets(b.compute_aabb(pose12))) {
        let triangle_a = a.triangle(id_a);
        for id_b in b.bvh().leaves(meets(triangle_a.compute_aabb(&pose21))) {
            work.borrow_mut().primitive_test(id_a, id_b);
            if intersect(&pose21, &b.triangle(id_b), &triangle_a) && !visit(id_a, id_b) {
                return;
            }
        }
    }
}

/// As `query::distance`. The search in B begins without a bound for every triangle of A, as it does there.
pub fn distance(a: &TriMesh, b: &TriMesh, pose12: &Pose, work: &mut impl Count) -> ShapeDistance {
    let work = RefCell::new(work);
    let gap = |bounds: Aabb| {
        let work = &work;
        move |node: &BvhNode, _: Real| {
            work.borrow_mut().bv_tests(1);
            let (center, half) = (bounds.center(), bounds.half_extents());
            Aabb { mins: node.mins() - center - half, maxs: node.maxs() - center + half }.distance_to_origin()
        }
    };
    let pose21 = pose12.inverse();
    let nearest = a.bvh().find_best(Real::MAX, gap(b.compute_aabb(pose12)), |id_a, _| {
        let triangle_a = a.triangle(id_a);
        let (id_b, distance) = b.bvh().find_best(Real::MAX, gap(triangle_a.compute_aabb(&pose21)), |id_b, _| {
            work.borrow_mut().primitive_test(id_a, id_b);
            query::distance(&Pose::IDENTITY, &b.triangle(id_b), &pose21, &triangle_a).ok()
        })?;
        Some(ShapeDistance { subshape2: id_b, ..distance })
    });
    match nearest {
        Some((id_a, distance)) => ShapeDistance { subshape1: id_a, ..distance },
        None => ShapeDistance::new(Real::MAX),
    }
}

fn intersect(pose: &Pose, first: &Triangle, second: &Triangle) -> bool {
    query::intersection_test(&Pose::IDENTITY, first, pose, second).is_ok_and(|answer| answer.intersecting)
}
