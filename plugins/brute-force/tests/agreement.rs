//! brute-force answers as all pairs of triangles do: its boxes leave nothing out.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use ocb_brute_force::BruteForce;
use opencollbench_plugin::Counts;
use support::{Dice, Loaded, Reference, Soup, check_collision, check_witness, tau};

fn check(soup: &Soup, reach: f64, rounds: usize) {
    let (mut brute, reference) = (Loaded::<BruteForce>::new(soup), Reference(soup));
    let (mut dice, mut hits) = (Dice(7), 0);
    for round in 0..rounds {
        let (pose_a, pose_b) = (dice.pose(0.1), dice.pose(reach * round as f64 / rounds as f64));
        let contacts = brute.contacts(&pose_a, &pose_b);
        assert_eq!(contacts, reference.contacts(&pose_a, &pose_b));
        hits += usize::from(!contacts.is_empty());
        check_collision(soup, &pose_a, &pose_b, brute.collide(&pose_a, &pose_b), !contacts.is_empty());
        let tau = tau(soup, &pose_b);
        let (near, expected) = (brute.distance(&pose_a, &pose_b), reference.distance(&pose_a, &pose_b));
        assert!((near.distance - expected).abs() <= tau, "{} and {expected}", near.distance);
        assert_eq!(near.distance == 0.0, !contacts.is_empty());
        check_witness(soup, &pose_a, &pose_b, &near, tau);
    }
    assert!(hits > rounds / 10 && hits < rounds, "{hits} of {rounds} collide: this tests one side only");
}

#[test]
fn on_a_torus() {
    check(&Soup::torus(16, 8), 5.0, 60);
}

#[test]
fn on_scraps_without_area() {
    check(&Soup::scraps(), 1.5, 200);
}

#[test]
fn counts_a_query_by_hand() {
    // Four triangles against four, in one place: 8 boxes against the other object's, then 4 x 4 boxes, but the query
    // ends with the first pair, which is the first triangle and itself.
    let soup = Soup::scraps();
    let mut counts = Counts::default();
    let pose = opencollbench_plugin::Pose::IDENTITY;
    Loaded::<BruteForce>::new(&soup).collide_counting(&pose, &pose, &mut counts);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (8 + 4, 1));
}
