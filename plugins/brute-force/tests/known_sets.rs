//! Answers on every hundredth of the known configurations, since each takes a while.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use ocb_brute_force::BruteForce;
use opencollbench_plugin::Pose;
use support::{Loaded, check_collision, check_witness, known_set, tau};

fn check(set: &str, collides: bool) {
    let known = known_set("bunny65k", set);
    let mut brute = Loaded::<BruteForce>::new(&known.soup);
    for (i, pose) in known.poses.iter().enumerate().step_by(100) {
        check_collision(&known.soup, &Pose::IDENTITY, pose, brute.collide(&Pose::IDENTITY, pose), collides);
        let answer = brute.distance(&Pose::IDENTITY, pose);
        check_witness(&known.soup, &Pose::IDENTITY, pose, &answer, tau(&known.soup, pose));
        let expected = known.distances.as_ref().map_or(0.0, |distances| distances[i]);
        let error = (answer.distance - expected).abs();
        assert!(error <= 1e-12 * expected, "{} instead of {expected}", answer.distance);
    }
}

#[test]
fn bunny_nearly_touching() {
    check("W1", false);
}

#[test]
fn bunny_apart() {
    check("W2", false);
}

#[test]
fn bunny_colliding() {
    check("W3", true);
}
