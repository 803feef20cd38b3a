//! The oracle on meshes: against distances of independent programs, and where meshes are more than their triangles.

use crate::common::{configurations, floats, mesh, placed};
use ocb_core::configuration::{Class, Configuration};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

#[test]
fn distances_agree_with_four_independent_programs() {
    for object in ["bunny65k", "knot65k"] {
        let shape = Shape::new(mesh(object));
        let pair = Pair::new(&shape, &shape);
        for set in ["W1", "W2"] {
            let poses = configurations(&format!("configurations/{object}.{set}.f64"));
            let distances = floats(&format!("configurations/{object}.{set}.distance.f64"));
            assert_eq!((poses.len(), distances.len()), (1000, 1000));
            for (i, (c, d)) in poses.iter().zip(&distances).enumerate() {
                let t = pair.truth(c);
                assert!(!t.hit, "{object} {set} {i}");
                let error = (t.distance_lo - d).abs().max((t.distance_hi - d).abs());
                assert!(error <= 1e-12, "{object} {set} {i}: {t:?} instead of {d}");
                assert_eq!((t.class64, t.class32), (Class::Clear, Class::Clear), "{object} {set} {i}");
            }
        }
        for (i, c) in configurations(&format!("configurations/{object}.W3.f64")).iter().enumerate() {
            assert!(pair.hit(c), "{object} W3 {i}");
            let t = pair.truth(c);
            assert!(t.hit && t.class64 == Class::Colliding, "{object} W3 {i}: {t:?}");
        }
    }
}

#[test]
fn a_mesh_far_away_or_tiny_is_as_certain() {
    let shape = Shape::new(mesh("bunny1k"));
    let pair = Pair::new(&shape, &shape);
    let mut pose = Pose::identity();
    pose.translation.x = 1.25;
    let near = pair.truth(&placed(pose));
    pose.translation.x = 1.25e12;
    let far = pair.truth(&placed(pose));
    assert!(!near.hit && !far.hit && far.class64 == Class::Clear);
    assert!((far.distance_lo - 1.25e12).abs() < 1.0);
    let points: Vec<_> = shape.triangles().iter().map(|t| t.map(|v| shape.positions()[v as usize] * 1e-9)).collect();
    let tiny = Shape::from_triangles(&points);
    // A tiny bunny at a vertex of the large one.
    let mut pose = Pose::identity();
    pose.translation = shape.positions()[shape.triangles()[7][0] as usize].coords;
    let (large_tiny, tiny_large) = (Pair::new(&shape, &tiny), Pair::new(&tiny, &shape));
    let there = placed(pose);
    let back = Configuration { pose_a: pose, pose_b: Pose::identity() };
    assert_eq!(large_tiny.hit(&there), tiny_large.hit(&back));
    let (t, s) = (large_tiny.truth(&there), tiny_large.truth(&back));
    assert!(t.distance_lo <= s.distance_hi && s.distance_lo <= t.distance_hi, "{t:?} {s:?}");
}

/// A cube of 12 triangles whose face diagonals all begin at the corner -1 -1 -1 or end at 1 1 1.
pub fn cube(half: f64, centre: f64) -> Shape {
    const FACES: [[usize; 4]; 6] = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let corner = |i: usize| {
        let at = |bit: usize| centre + if i & bit == 0 { -half } else { half };
        nalgebra::Point3::new(at(4), at(2), at(1))
    };
    let positions: Vec<_> = (0..8).map(corner).collect();
    let triangles =
        FACES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|t| t.map(|i| i as u32)).collect();
    Shape::new(std::sync::Arc::new(ocb_core::mesh::Mesh::new(positions, triangles).expect("a cube")))
}

#[test]
fn cubes_that_cross_along_face_diagonals_cross_robustly() {
    // Drake #1668: every piercing point lies on an edge between coplanar triangles, so no pair of triangles has a margin.
    let (large, small) = (cube(10.0, 0.0), cube(5.0, 14.0));
    let still = placed(Pose::identity());
    for pair in [Pair::new(&large, &small), Pair::new(&small, &large)] {
        assert!(pair.contact_margins(&still).iter().all(|c| c.margin < 1e-9));
        let t = pair.truth(&still);
        assert!(t.hit);
        // The small cube's corner stands 1 deep inside (9 against 10), the others outside.
        assert!((0.49..=0.5).contains(&t.margin), "{t:?}");
        assert_eq!((t.class64, t.class32), (Class::Colliding, Class::Colliding));
    }
    // A cube inside a cube does not collide: surfaces are asked for.
    let inner = cube(2.0, 0.0);
    let t = Pair::new(&large, &inner).tightest_truth(&still);
    assert_eq!((t.hit, t.distance_lo, t.distance_hi), (false, 8.0, 8.0));
}
