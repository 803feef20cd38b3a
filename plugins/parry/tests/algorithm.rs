//! parry answers as an algorithm must that is not exact, timed and counted; on a mesh made here and on a few known
//! configurations, since it needs a second per distance.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_parry::Double as Parry;
use opencollbench_plugin::{Collision, Pose};
use support::algorithm::Terms;
use support::{Loaded, Scene, known_set};

/// parry compares triangles by iteration and stops near its own epsilon.
const BLUR: f64 = 1e-7;

algorithm!(Terms { variants: || vec![Parry], blur: BLUR, common_points: false, stride: 25 }; algorithm: on_a_torus);

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

#[test]
fn distance_on_a_known_set() {
    let known = known_set("bunny65k", "W2");
    let mut parry = Loaded::<Parry>::new(&known.soup);
    let expected = known.distances.expect("distances");
    for i in [0, 500] {
        let answer = parry.distance(&Pose::IDENTITY, &known.poses[i]);
        assert!((answer.distance - expected[i]).abs() <= BLUR, "{} instead of {}", answer.distance, expected[i]);
        Scene::of(&known.soup, Pose::IDENTITY, known.poses[i]).check_witness(&answer, BLUR);
    }
}
