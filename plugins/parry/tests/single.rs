//! parry in single precision answers as an algorithm must, up to what single precision can.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_parry::Single as Parry;
use opencollbench_plugin::{Algorithm, Capability, Collision, Counts};
use support::{Dice, Loaded, Scene, Soup};

/// GJK stops near the square root of its epsilon.
const BLUR: f64 = 3e-4;

#[test]
fn on_a_torus() {
    assert_eq!(Parry::ABOUT.capabilities, [Capability::SinglePrecision]);
    let soup = Soup::torus(16, 8);
    let (mut parry, mut dice, mut hits, mut worst) = (Loaded::<Parry>::new(&soup), Dice(3), 0, 0.0f64);
    for round in 0..40 {
        let (pose_a, pose_b) = (dice.pose(0.5), dice.pose(f64::from(round) / 8.0));
        let scene = Scene::of(&soup, pose_a, pose_b);
        let truth = scene.truth();
        let (mut counts, answer) = (Counts::default(), parry.collide(&pose_a, &pose_b));
        assert_eq!(parry.collide_counting(&pose_a, &pose_b, &mut counts), answer, "the written-out copy");
        assert!((answer != Collision::Apart) == (truth.distance == 0.0) || truth.distance <= BLUR);
        hits += usize::from(answer != Collision::Apart);
        // Contacts that are told apart by less than the precision may be missing or too many.
        let contacts = parry.contacts(&pose_a, &pose_b);
        let differing = contacts.iter().filter(|pair| truth.contacts.binary_search(pair).is_err()).count();
        assert!(contacts.len().abs_diff(truth.contacts.len()) + differing <= 1 + contacts.len() / 50);

        let near = parry.distance(&pose_a, &pose_b);
        assert_eq!(parry.distance_counting(&pose_a, &pose_b, &mut counts).distance, near.distance);
        worst = worst.max((near.distance - truth.distance).abs());
        if near.points.is_some() {
            scene.check_witness(&near, BLUR);
        }
    }
    println!("worst distance: off by {worst:.1e}");
    assert!(worst <= BLUR && worst > 1e-9, "{worst:e}: this is not single precision as the README has it");
    assert!(hits > 4 && hits < 36, "{hits} of 40 collide: this tests one side only");
}
