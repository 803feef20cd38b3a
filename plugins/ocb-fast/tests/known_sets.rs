//! Answers on sets of configurations that PQP, FCL, coal and others agree on.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use std::time::Instant;

use ocb_fast::Fast;
use opencollbench_plugin::{Counts, Pose};
use support::{Loaded, check_collision, check_witness, known_set, tau};

/// `set` collides in all or in no configuration; distances agree where they are known.
fn check(mesh: &str, set: &str, collides: bool) {
    let known = known_set(mesh, set);
    let start = Instant::now();
    let mut tree = Loaded::<Fast>::new(&known.soup);
    eprintln!("{mesh} {set}: build {:?}", start.elapsed());
    let mut worst = 0.0f64;
    let (mut collision_us, mut distance_us) = (Vec::new(), Vec::new());
    let (mut collision_work, mut distance_work) = (Counts::default(), Counts::default());
    for (i, pose) in known.poses.iter().enumerate() {
        let start = Instant::now();
        let answer = tree.collide(&Pose::IDENTITY, pose);
        collision_us.push(start.elapsed().as_secs_f64() * 1e6);
        check_collision(&known.soup, &Pose::IDENTITY, pose, answer, collides);
        let start = Instant::now();
        let answer = tree.distance(&Pose::IDENTITY, pose);
        distance_us.push(start.elapsed().as_secs_f64() * 1e6);
        check_witness(&known.soup, &Pose::IDENTITY, pose, &answer, tau(&known.soup, pose));
        let expected = known.distances.as_ref().map_or(0.0, |distances| distances[i]);
        worst = worst.max((answer.distance - expected).abs() / expected.max(f64::MIN_POSITIVE));
        tree.collide_counting(&Pose::IDENTITY, pose, &mut collision_work);
        tree.distance_counting(&Pose::IDENTITY, pose, &mut distance_work);
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    eprintln!(
        "{mesh} {set}: collide {:.0} us, {} bv, {} tri; distance {:.0} us, {} bv, {} tri; worst relative error {worst:e}",
        median(&mut collision_us),
        collision_work.bv_tests / 1000,
        collision_work.primitive_tests / 1000,
        median(&mut distance_us),
        distance_work.bv_tests / 1000,
        distance_work.primitive_tests / 1000,
    );
    assert!(worst <= 1e-12, "a distance is off by {worst:e} of itself");
}

#[test]
fn bunny_nearly_touching() {
    check("bunny65k", "W1", false);
}

#[test]
fn bunny_apart() {
    check("bunny65k", "W2", false);
}

#[test]
fn bunny_colliding() {
    check("bunny65k", "W3", true);
}

#[test]
fn knot_nearly_touching() {
    check("knot65k", "W1", false);
}

#[test]
fn knot_apart() {
    check("knot65k", "W2", false);
}

#[test]
fn knot_colliding() {
    check("knot65k", "W3", true);
}
