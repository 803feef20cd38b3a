//! What a walk costs that starts where the previous one ended.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_v_clip::VClip;
use opencollbench_plugin::{Algorithm, Distance, Placed, Pose, Uncounted};
use support::algorithm::with;
use support::convex::{ellipsoid, prism};
use support::{Dice, Loaded, Scene, TRANSLATION};

const COLD: &[(&str, f64)] = &[("coherence", 0.0)];

/// B tumbles past A, so far apart that they do not touch.
fn motion(steps: usize) -> Vec<Pose> {
    let pose = |step: usize| {
        let t = 0.001 * step as f64;
        let ((s, c), (u, v)) = ((3.0 * t).sin_cos(), t.sin_cos());
        let mut pose = Pose::IDENTITY;
        pose.0[..3].copy_from_slice(&[c, -s, 0.0]);
        pose.0[4..7].copy_from_slice(&[s * v, c * v, -u]);
        pose.0[8..11].copy_from_slice(&[s * u, c * u, v]);
        TRANSLATION.iter().zip([2.5 * v, 2.5 * u, 0.2]).for_each(|(&at, x)| pose.0[at] = x);
        pose
    };
    (0..steps).map(pose).collect()
}

/// Pairs of features looked at per query.
fn steps(n: usize, settings: &[(&str, f64)], poses: &[Pose]) -> f64 {
    let mut loaded = Loaded::with(with::<VClip>(settings), &ellipsoid(n, [1.0, 0.8, 0.7]));
    poses.iter().for_each(|pose| assert!(loaded.distance(&Pose::IDENTITY, pose).distance > 0.0));
    loaded.algorithm.work().steps as f64 / poses.len() as f64
}

#[test]
fn along_a_motion_the_steps_hardly_grow_with_the_object_but_without_coherence_they_do() {
    let poses = motion(1000);
    // 128, 2,048 and 32,768 triangles.
    let [warm, cold] = [&[][..], COLD].map(|settings| [4, 16, 64].map(|n| steps(n, settings, &poses)));
    assert!(warm.iter().all(|&steps| steps < 4.0), "{warm:?} steps per query");
    assert!(cold[1] > 2.0 * cold[0] && cold[2] > 2.0 * cold[1], "{cold:?} steps per query");
    assert!(cold[2] > 20.0 * warm[2], "{cold:?} and {warm:?} steps per query");
}

#[test]
fn in_another_order_the_same_queries_take_many_steps() {
    let mut poses = motion(1000);
    let in_order = steps(32, &[], &poses);
    let mut dice = Dice(3);
    for last in (1..poses.len()).rev() {
        poses.swap(last, dice.pick(0, last as i32 + 1) as usize);
    }
    let shuffled = steps(32, &[], &poses);
    assert!(shuffled > 8.0 * in_order, "{shuffled} steps per query in random order, {in_order} along the motion");
}

#[test]
fn distances_do_not_depend_on_where_a_walk_starts() {
    let soup = prism(16, 0.5, 0.7, 0.8);
    let [mut warm, mut cold] = [&[][..], COLD].map(|settings| Loaded::with(with::<VClip>(settings), &soup));
    let mut dice = Dice(6);
    for _ in 0..2000 {
        let (pose_a, pose_b) = (dice.pose(0.2), dice.pose(1.8));
        let [one, other] = [&mut warm, &mut cold].map(|loaded| loaded.distance(&pose_a, &pose_b).distance);
        assert!((one - other).abs() <= Scene::of(&soup, pose_a, pose_b).tau(), "{one} and {other}");
    }
}

/// Objects in turn, and with A and B exchanged: features belong to their object.
#[test]
fn features_are_remembered_for_their_objects() {
    let mut algorithm = VClip::default();
    let objects = [ellipsoid(16, [1.0, 0.8, 0.7]), prism(5, 0.5, 0.5, 1.0), ellipsoid(2, [0.5; 3])]
        .map(|soup| algorithm.load_mesh(soup.view()).expect("it is convex"));
    let far = motion(1)[0];
    let mut steps = |i: usize, j: usize| {
        let before = algorithm.work().steps;
        let [pose_a, pose_b] = if i < j { [Pose::IDENTITY, far] } else { [far, Pose::IDENTITY] };
        let (a, b) = (Placed { object: &objects[i], pose: &pose_a }, Placed { object: &objects[j], pose: &pose_b });
        algorithm.distance(a, b, &mut Uncounted).expect("an answer");
        algorithm.work().steps - before
    };
    let first = steps(0, 1);
    assert!(first > 3, "{first} steps from the first vertices");
    assert_eq!([steps(0, 1), steps(1, 0), steps(0, 1)], [1, 1, 1], "where it ended before");
    let other = steps(0, 2);
    assert!(other > 1, "another pair of objects");
    // As in a scene: the features of every pair are kept, in either order.
    assert_eq!([steps(1, 0), steps(2, 0), steps(0, 1), steps(0, 2)], [1, 1, 1, 1], "where each pair ended before");
    assert!(steps(1, 2) > 1, "a pair that was not asked about before");
}
