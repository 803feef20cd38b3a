//! The oracle on meshes: against distances of independent programs and against trying all pairs.

mod common;

use common::{Random, configurations, floats, mesh, placed};
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
            // Every fifth: a second, not five.
            for (i, (c, d)) in poses.iter().zip(&distances).enumerate().step_by(5) {
                let t = pair.truth(c);
                assert!(!t.hit, "{object} {set} {i}");
                let error = (t.distance_lo - d).abs().max((t.distance_hi - d).abs());
                assert!(error <= 1e-12, "{object} {set} {i}: {t:?} instead of {d}");
                assert_eq!((t.class64, t.class32), (Class::Clear, Class::Clear), "{object} {set} {i}");
            }
        }
        for (i, c) in configurations(&format!("configurations/{object}.W3.f64")).iter().enumerate().step_by(5) {
            assert!(pair.hit(c), "{object} W3 {i}");
            let t = pair.truth(c);
            assert!(t.hit && t.class64 == Class::Colliding, "{object} W3 {i}: {t:?}");
        }
    }
}

/// All pairs of triangles, each as an object of its own.
fn brute_force(a: &Shape, b: &Shape, c: &Configuration) -> (f64, f64, Vec<[u32; 2]>) {
    let single = |s: &Shape, i: usize| Shape::from_triangles(&[s.triangles()[i].map(|v| s.positions()[v as usize])]);
    let list = |s: &Shape| -> Vec<Shape> { (0..s.triangles().len()).map(|i| single(s, i)).collect() };
    let (list_a, list_b) = (list(a), list(b));
    let (mut lo, mut hi, mut contacts) = (f64::INFINITY, f64::INFINITY, Vec::new());
    for (i, x) in list_a.iter().enumerate() {
        for (j, y) in list_b.iter().enumerate() {
            let t = Pair::new(x, y).truth(c);
            lo = lo.min(t.distance_lo);
            hi = hi.min(t.distance_hi);
            if t.hit {
                contacts.push([i as u32, j as u32]);
            }
        }
    }
    (lo, hi, contacts)
}

/// About 120 triangles spread over a stock object, so that all pairs can be tried.
fn sparse(object: &str) -> Shape {
    let mesh = ocb_core::stock::generate(object, 1200).expect("a stock object");
    let corners = mesh.triangles().iter().step_by(10).map(|t| t.map(|v| mesh.positions()[v as usize]));
    Shape::from_triangles(&corners.collect::<Vec<_>>())
}

#[test]
fn the_hierarchy_loses_nothing() {
    let mut random = Random(1);
    for object in ocb_core::stock::list() {
        let shape = sparse(object.name);
        let object = object.name;
        let pair = Pair::new(&shape, &shape);
        for _ in 0..8 {
            let c = Configuration { pose_a: random.pose(0.2), pose_b: random.pose(0.6) };
            let t = pair.truth(&c);
            let (lo, hi, contacts) = brute_force(&shape, &shape, &c);
            assert_eq!(pair.contacts(&c), contacts, "{object} {c:?}");
            assert_eq!(t.hit, !contacts.is_empty());
            assert_eq!(t.hit, pair.hit(&c));
            // Both intervals hold the same number.
            assert!(t.distance_lo <= hi && lo <= t.distance_hi, "{object}: {t:?}, all pairs [{lo}, {hi}]");
        }
    }
}

#[test]
fn any_affine_map_is_taken_at_its_word() {
    let mut random = Random(2);
    let shape = sparse("sphere");
    let pair = Pair::new(&shape, &shape);
    for round in 0..6 {
        let mut pose = random.pose(1.0);
        // Shear, scale and mirror; from rounding to gross.
        let amount = [1e-15, 1e-7, 1e-5, 1e-2, 1.0, 3.0][round];
        pose.linear += nalgebra::Matrix3::from_fn(|_, _| amount * random.signed());
        let c = Configuration { pose_a: random.pose(0.3), pose_b: pose };
        let t = pair.truth(&c);
        let (lo, hi, contacts) = brute_force(&shape, &shape, &c);
        assert_eq!(pair.contacts(&c), contacts);
        assert!(t.distance_lo <= hi && lo <= t.distance_hi, "{t:?}, all pairs [{lo}, {hi}]");
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
fn cube(half: f64, centre: f64) -> Shape {
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

#[test]
fn the_margin_survives_perturbation() {
    let shape = Shape::new(mesh("bunny1k"));
    let pair = Pair::new(&shape, &shape);
    let mut random = Random(3);
    let mut tried = 0;
    while tried < 300 {
        let c = Configuration { pose_a: random.pose(0.1), pose_b: random.pose(0.4) };
        let t = pair.truth(&c);
        if !t.hit || t.margin == 0.0 {
            continue;
        }
        tried += 1;
        // Only the pair that has the margin, each vertex moved by 0.99 of it.
        let corners =
            |pose: &Pose, i: u32| shape.triangles()[i as usize].map(|v| pose.apply(&shape.positions()[v as usize]));
        let (a, b) = (corners(&c.pose_a, t.witness.triangle_a), corners(&c.pose_b, t.witness.triangle_b));
        for _ in 0..34 {
            let mut moved = |p: nalgebra::Point3<f64>| {
                let direction = nalgebra::Vector3::new(random.signed(), random.signed(), random.signed());
                p + direction.normalize() * (0.99 * t.margin)
            };
            let (a, b) = (Shape::from_triangles(&[a.map(&mut moved)]), Shape::from_triangles(&[b.map(&mut moved)]));
            assert!(Pair::new(&a, &b).hit(&placed(Pose::identity())), "{c:?}");
        }
    }
}
