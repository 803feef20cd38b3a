//! parry, timed and counted, against all pairs of triangles, on a mesh made here and on a few known configurations.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use ocb_parry::Parry;
use opencollbench_plugin::{Collision, Counts, Pose};
use support::{Dice, Loaded, Reference, Soup, check_collision, check_witness, known_set};

/// parry compares triangles by iteration and stops near its own epsilon.
const TOLERANCE: f64 = 1e-7;

#[test]
fn on_a_torus() {
    let soup = Soup::torus(16, 8);
    let (mut parry, reference) = (Loaded::<Parry>::new(&soup), Reference(&soup));
    let (mut dice, mut hits) = (Dice(3), 0);
    for round in 0..40 {
        let (pose_a, pose_b) = (dice.pose(0.5), dice.pose(round as f64 / 8.0));
        let expected = reference.contacts(&pose_a, &pose_b);
        hits += usize::from(!expected.is_empty());
        let mut counts = Counts::default();
        let timed = parry.collide(&pose_a, &pose_b);
        assert_eq!(parry.collide_counting(&pose_a, &pose_b, &mut counts), timed, "the written-out copy");
        assert!(counts.bv_tests > 0);
        check_collision(&soup, &pose_a, &pose_b, timed, !expected.is_empty());
        assert_eq!(parry.contacts(&pose_a, &pose_b), expected);

        let timed = parry.distance(&pose_a, &pose_b);
        let counted = parry.distance_counting(&pose_a, &pose_b, &mut counts);
        assert_eq!(counted.distance, timed.distance, "the written-out copy");
        assert!((timed.distance - reference.distance(&pose_a, &pose_b)).abs() <= TOLERANCE);
        assert!(counts.primitive_tests > 0);
        if timed.points.is_some() {
            check_witness(&soup, &pose_a, &pose_b, &timed, TOLERANCE);
        } else {
            assert_eq!(timed.distance, 0.0, "only where the surfaces meet are there no points");
        }
    }
    assert!(hits > 4 && hits < 36, "{hits} of 40 collide: this tests one side only");
}

#[test]
fn on_known_sets() {
    for (set, collides) in [("W1", false), ("W2", false), ("W3", true)] {
        let known = known_set("bunny65k", set);
        let mut parry = Loaded::<Parry>::new(&known.soup);
        for pose in known.poses.iter().step_by(25) {
            let answer = parry.collide(&Pose::IDENTITY, pose);
            assert_eq!(answer != Collision::Apart, collides, "{set}");
        }
    }
}

/// A second per query, so two of them.
#[test]
fn distance_on_a_known_set() {
    let known = known_set("bunny65k", "W2");
    let mut parry = Loaded::<Parry>::new(&known.soup);
    let expected = known.distances.expect("distances");
    for i in [0, 500] {
        let answer = parry.distance(&Pose::IDENTITY, &known.poses[i]);
        assert!((answer.distance - expected[i]).abs() <= TOLERANCE, "{} instead of {}", answer.distance, expected[i]);
        check_witness(&known.soup, &Pose::IDENTITY, &known.poses[i], &answer, TOLERANCE);
    }
}
