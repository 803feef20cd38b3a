//! V-Clip against GJK on 100,000 random configurations.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_bodies::{Body, Found, Pair, Surface};
use ocb_triangles::Frame;
use ocb_v_clip::VClip;
use opencollbench_plugin::{Collision, Pose, Uncounted};
use support::convex::{cut_box, ellipsoid, prism};
use support::{Dice, Loaded, Scene, Soup};

/// Of each pair of objects.
const CONFIGURATIONS: usize = 1600;

fn body(soup: &Soup) -> Body {
    Surface::of(&soup.view()).and_then(|surface| Body::new(&surface, 0.0)).expect("it is convex")
}

/// The distance of the surfaces.
fn gjk(a: &Body, b: &Body, pose_a: &Pose, pose_b: &Pose) -> f64 {
    let frame = Frame::new(pose_a.rotation(), pose_a.translation(), pose_b.rotation(), pose_b.translation());
    let mut uncounted = Uncounted;
    let mut pair = Pair::new(a, b, frame, &mut uncounted);
    match pair.nearest() {
        Found::Apart(closest) => closest.squared.sqrt(),
        Found::Meeting => pair.room().max(0.0),
    }
}

#[test]
fn a_hundred_thousand_configurations_are_answered_alike() {
    let soups = [
        cut_box(1, [0.5; 3]),
        cut_box(4, [0.6, 0.5, 0.9]),
        cut_box(1, [1.0, 1e-3, 1e-9]),
        ellipsoid(1, [1.0; 3]),
        ellipsoid(12, [1.0, 0.7, 0.4]),
        prism(40, 0.4, 0.9, 1.0),
        prism(11, 0.8, 0.6, 0.0),
        prism(3, 0.9, 1e-7, 0.5),
    ];
    let bodies: Vec<Body> = soups.iter().map(body).collect();
    let (mut dice, mut all, mut hits, mut fallbacks) = (Dice(7), 0u64, 0u64, 0);
    for (soup_a, body_a) in soups.iter().zip(&bodies) {
        for (soup_b, body_b) in soups.iter().zip(&bodies) {
            let mut loaded = Loaded::two(VClip::default(), soup_a, soup_b);
            for round in 0..CONFIGURATIONS {
                let apart = 2.2 * round as f64 / CONFIGURATIONS as f64;
                let (pose_a, pose_b) = (dice.pose(0.3), dice.pose(apart));
                let expected = gjk(body_a, body_b, &pose_a, &pose_b);
                let tau = Scene { a: soup_a, b: soup_b, pose_a, pose_b }.tau();
                let found = loaded.distance(&pose_a, &pose_b).distance;
                assert!((found - expected).abs() <= tau, "{found} and {expected} at {pose_a:?} {pose_b:?}");
                let hit = loaded.collide(&pose_a, &pose_b) != Collision::Apart;
                assert!(hit == (expected == 0.0) || expected <= tau, "{hit} at {expected}, {pose_a:?} {pose_b:?}");
                (all, hits) = (all + 1, hits + u64::from(hit));
            }
            fallbacks += loaded.algorithm.work().fallbacks;
        }
    }
    assert!(all >= 100_000 && hits > all / 5 && hits < 4 * all / 5, "{hits} of {all} collide");
    assert!(fallbacks < all / 1000, "{fallbacks} of {all} were left to GJK");
}
