//! rss-tree answers as every algorithm must, with every queue, and keeps to the errors that it is allowed.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_rss_tree::RssTree;
use support::algorithm::{Terms, with};
use support::{Dice, Loaded, Scene, Soup};

algorithm!(Terms::exact(|| [2.0, 16.0, 1e6].map(|size| with::<RssTree>(&[("queue_size", size)])).into()));

/// What a distance may be, with both errors set and with one of them.
#[test]
fn keeps_to_the_errors_allowed() {
    let soup = Soup::torus(24, 12);
    let (mut dice, mut inexact) = (Dice(41), 0);
    for (relative, absolute) in [(0.5, 100.0), (1.0, 0.05), (0.3, 0.1), (1.0, 0.0), (0.0, 100.0)] {
        let mut rss = Loaded::with(with::<RssTree>(&[("rel_err", relative), ("abs_err", absolute)]), &soup);
        for _ in 0..10 {
            let scene = Scene::of(&soup, dice.pose(0.0), dice.pose(3.5));
            let (near, truth, tau) = (rss.distance(&scene.pose_a, &scene.pose_b), scene.truth().distance, scene.tau());
            assert!(near.distance >= truth - tau);
            assert!(near.distance <= truth + (relative * truth).min(absolute) + tau, "{} {truth}", near.distance);
            inexact += usize::from(near.distance > truth + tau);
            scene.check_witness(&near, tau);
        }
    }
    assert!(inexact > 5, "only {inexact} of 30 answers make use of the errors allowed");
}
