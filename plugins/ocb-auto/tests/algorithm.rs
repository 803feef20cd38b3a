//! ocb-auto answers as every algorithm must, by its rules and by each method, and its README says why it chooses what.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_auto::Auto;
use ocb_auto::features::{Ball, Feature, Features};
use ocb_auto::rules::{Choice, Query, RULES, choose};
use ocb_triangles::Frame;
use opencollbench_plugin::{Algorithm, Collision, Counts, Pose};
use support::algorithm::{Terms, with};
use support::{Loaded, Soup};

algorithm!(Terms::exact(|| [0.0, 2.0].map(|method| with::<Auto>(&[("method", method)])).into()));

/// Two poses of a torus, 1.5 across from the middle: what is chosen for each query.
fn chosen(pose_b: &Pose, size: f64, count: usize) -> [Choice; 3] {
    let (a, b) = (Soup::torus(16, 8), Soup::torus(16 * count, 8).moved(size, 0.0));
    let frame = Frame::new(Pose::IDENTITY.rotation(), [0.0; 3], pose_b.rotation(), pose_b.translation());
    let features = Features::new(&frame, &Ball::around(&a.view()), &Ball::around(&b.view()));
    [Query::Collision, Query::Contacts, Query::Distance].map(|query| choose(&RULES, query, &features))
}

#[test]
fn each_rule_has_its_configurations() {
    let at = |x: f64| {
        let mut pose = Pose::IDENTITY;
        pose.0[3] = x;
        pose
    };
    let (nothing, fast, simdop) = (Choice::Nothing, Choice::Fast, Choice::SimDop);
    assert_eq!(chosen(&at(4.0), 1.0, 1), [nothing, nothing, fast]);
    assert_eq!(chosen(&at(2.2), 1.0, 1), [fast; 3]);
    assert_eq!(chosen(&at(0.5), 1.0, 1), [fast, fast, Choice::CollisionFirst]);
    assert_eq!(chosen(&at(1.1), 0.05, 1), [simdop, fast, fast]);
    assert_eq!(chosen(&at(1.1), 0.05, 100), [fast; 3]);
}

/// A ball is no reason to miss a contact, however large the numbers are.
#[test]
fn balls_tell_nothing_apart_that_may_meet() {
    let soup = Soup::of(&[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    for size in [1e-300, 1e-160, 1.0, 1e150, 1e300] {
        let large = soup.moved(size, 0.0);
        let mut loaded = Loaded::<Auto>::new(&large);
        assert_ne!(loaded.collide(&Pose::IDENTITY, &Pose::IDENTITY), Collision::Apart, "{size:e}");
        let mut touching = Pose::IDENTITY;
        touching.0[3] = size;
        assert_ne!(loaded.collide(&Pose::IDENTITY, &touching), Collision::Apart, "{size:e}");
        let ball = Ball::around(&large.view());
        let frame = Frame::new(Pose::IDENTITY.rotation(), [0.0; 3], touching.rotation(), touching.translation());
        assert!(Features::new(&frame, &ball, &ball).get(Feature::Clearance) <= 0.0);
    }
}

#[test]
fn what_the_features_answer_is_counted() {
    let soup = Soup::torus(16, 8);
    let mut auto = Loaded::<Auto>::new(&soup);
    let (mut tests_a, mut tests_b) = (vec![0; soup.triangles.len()], vec![0; soup.triangles.len()]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let mut far = Pose::IDENTITY;
    far.0[3] = 10.0;
    assert_eq!(auto.collide_counting(&Pose::IDENTITY, &far, &mut counts), Collision::Apart);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (1, 0));
}

#[test]
fn the_readme_gives_every_reason() {
    let readme = include_str!("../README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    for rule in &RULES {
        assert!(
            readme.contains(rule.reason),
            "{}: README.md does not say: {}",
            Auto::ABOUT.id.to_string_lossy(),
            rule.reason
        );
    }
}
