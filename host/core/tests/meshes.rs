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

#[test]
fn the_hierarchy_loses_nothing() {
    let mut random = Random(1);
    for object in ocb_core::stock::list() {
        // The smallest of each: all pairs are a million.
        let mesh = ocb_core::stock::generate(object.name, object.lowest_triangles).expect("a listed object");
        let object = object.name;
        let shape = Shape::new(std::sync::Arc::new(mesh));
        let pair = Pair::new(&shape, &shape);
        for _ in 0..2 {
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
    let shape = Shape::new(std::sync::Arc::new(ocb_core::stock::generate("sphere", 500).expect("a stock object")));
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
