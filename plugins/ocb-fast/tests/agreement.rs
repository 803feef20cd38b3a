//! ocb-fast answers as all pairs of triangles do, on meshes made here.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use ocb_fast::Fast;
use opencollbench_plugin::{Collision, Counts, Parameters, Pose};
use support::{Dice, Loaded, Reference, Soup, check_collision, check_witness, tau};

/// A mesh against itself, at all distances up to `reach`, both objects turned.
fn check(soup: &Soup, width: f64, reach: f64, rounds: usize) {
    let mut algorithm = Fast::default();
    algorithm.set("width", width).expect("the parameter exists");
    let mut tree = Loaded::with(algorithm, soup);
    let reference = Reference(soup);
    let (mut dice, mut hits) = (Dice(width as u64), 0);
    for round in 0..rounds {
        let pose_a = dice.pose(0.1);
        let pose_b = dice.pose(reach * round as f64 / rounds as f64);
        let contacts = tree.contacts(&pose_a, &pose_b);
        assert_eq!(contacts, reference.contacts(&pose_a, &pose_b));
        let collides = !contacts.is_empty();
        hits += usize::from(collides);
        let answer = tree.collide(&pose_a, &pose_b);
        check_collision(soup, &pose_a, &pose_b, answer, collides);
        if let Collision::Pair(a, b) = answer {
            assert!(contacts.binary_search(&(a, b)).is_ok());
        }
        let tau = tau(soup, &pose_b);
        let (near, expected) = (tree.distance(&pose_a, &pose_b), reference.distance(&pose_a, &pose_b));
        assert!((near.distance - expected).abs() <= tau, "{} and {expected}", near.distance);
        assert_eq!(near.distance == 0.0, collides);
        check_witness(soup, &pose_a, &pose_b, &near, tau);
    }
    assert!(hits > rounds / 10 && hits < rounds, "{hits} of {rounds} collide: this tests one side only");
}

#[test]
fn on_a_torus() {
    check(&Soup::torus(24, 12), 16.0, 5.0, 60);
}

#[test]
fn with_fewer_instructions() {
    check(&Soup::torus(16, 8), 1.0, 5.0, 40);
    check(&Soup::torus(16, 8), 8.0, 5.0, 40);
}

#[test]
fn on_scraps_without_area() {
    check(&Soup::scraps(), 16.0, 1.5, 200);
}

/// In one pose, every triangle touches itself and its neighbours in their very corners.
#[test]
fn on_itself() {
    let soup = Soup::torus(10, 6);
    let (mut tree, reference) = (Loaded::<Fast>::new(&soup), Reference(&soup));
    let pose = Dice(5).pose(3.0);
    let contacts = tree.contacts(&pose, &pose);
    assert_eq!(contacts, reference.contacts(&pose, &pose));
    for triangle in 0..soup.triangles.len() as u32 {
        assert!(contacts.binary_search(&(triangle, triangle)).is_ok());
    }
}

/// Objects far from the world's origin lose no more digits than the pose itself has lost.
#[test]
fn far_from_the_origin() {
    let soup = Soup::torus(16, 8);
    let mut tree = Loaded::<Fast>::new(&soup);
    let mut dice = Dice(9);
    for _ in 0..20 {
        let (mut pose_a, mut pose_b) = (dice.pose(0.0), dice.pose(3.0));
        let here = tree.distance(&pose_a, &pose_b).distance;
        for axis in [3, 7, 11] {
            pose_a.0[axis] += 1e6;
            pose_b.0[axis] += 1e6;
        }
        assert!((tree.distance(&pose_a, &pose_b).distance - here).abs() <= 1e6 * 4.0 * f64::EPSILON);
    }
}

/// Single precision poses and worse: culling must stay on the safe side of a rotation that is none.
#[test]
fn rotations_that_are_not_quite_rotations() {
    let soup = Soup::torus(24, 12);
    let (mut tree, reference) = (Loaded::<Fast>::new(&soup), Reference(&soup));
    let mut dice = Dice(11);
    for _ in 0..30 {
        let [pose_a, pose_b] = [0.2, 1.8].map(|distance| {
            let mut pose = dice.pose(distance);
            for entry in [0, 1, 2, 4, 5, 6, 8, 9, 10] {
                pose.0[entry] += 1e-4 * (dice.roll() - 0.5);
            }
            pose
        });
        assert_eq!(tree.contacts(&pose_a, &pose_b), reference.contacts(&pose_a, &pose_b));
        let (near, expected) = (tree.distance(&pose_a, &pose_b), reference.distance(&pose_a, &pose_b));
        assert!((near.distance - expected).abs() <= tau(&soup, &pose_b));
    }
}

#[test]
fn counts_a_query_by_hand() {
    // Two strips of five triangles: a root with two leaves each, of four triangles and of one.
    let soup = Soup {
        positions: (0..7).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.0]).collect(),
        triangles: (0..5).map(|i| [i, i + 1, i + 2]).collect(),
    };
    let mut fast = Loaded::<Fast>::new(&soup);
    let (mut tests_a, mut tests_b) = ([0; 5], [0; 5]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let mut above = Pose::IDENTITY;
    above.0[11] = 0.5;
    assert_eq!(fast.collide_counting(&Pose::IDENTITY, &above, &mut counts), Collision::Apart);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (4, 0));
    // Upright through y = 0.5, along x: crosses all.
    let upright = Pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.5, 0.0, 1.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1.0]);
    assert_ne!(fast.collide_counting(&Pose::IDENTITY, &upright, &mut counts), Collision::Apart);
    assert_eq!(counts.bv_tests, 8);
    assert_eq!(counts.primitive_tests, u64::from(counts.tests_a.iter().sum::<u32>()));
    assert_eq!(counts.tests_a.iter().sum::<u32>(), counts.tests_b.iter().sum::<u32>());
    assert!([1, 4, 16].contains(&counts.primitive_tests), "{}", counts.primitive_tests);
}
