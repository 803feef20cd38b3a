//! V-Clip against all pairs of triangles, and which objects it is not for.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_v_clip::VClip;
use opencollbench_plugin::{Algorithm, Distance, Placed, Pose, Uncounted};
use support::algorithm::with;
use support::convex::{check, cut_box, ellipsoid, prism};
use support::{Dice, Scene, Soup, TRANSLATION};

type Object = <VClip as Algorithm>::Object;

/// B's place and axes, when these are A's axes in another order or turned about one of them.
const TURNS: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]],
    [[0.8, -0.6, 0.0], [0.48, 0.64, -0.6], [0.36, 0.48, 0.8]],
];

fn load(algorithm: &mut VClip, soup: &Soup) -> Object {
    algorithm.load_mesh(soup.view()).expect("it is convex")
}

fn pose(turn: [[f64; 3]; 3], to: [f64; 3]) -> Pose {
    let mut pose = Pose::IDENTITY;
    for row in 0..3 {
        pose.0[4 * row..4 * row + 3].copy_from_slice(&turn[row]);
        pose.0[TRANSLATION[row]] = to[row];
    }
    pose
}

#[test]
fn every_pair_of_shapes_is_answered_exactly() {
    let soups = [
        ellipsoid(5, [1.0, 0.7, 0.4]),
        cut_box(3, [0.6, 0.5, 0.9]),
        ellipsoid(1, [1.0; 3]),
        prism(24, 0.5, 0.7, 1.0),
        prism(7, 0.8, 0.6, 0.0),
        prism(5, 0.9, 0.2, 0.3),
        cut_box(1, [1.0, 1e-3, 1e-6]),
    ];
    for settings in [&[][..], &[("coherence", 0.0)]] {
        let (mut algorithm, mut dice) = (with::<VClip>(settings), Dice(2));
        let objects: Vec<Object> = soups.iter().map(|soup| load(&mut algorithm, soup)).collect();
        let (mut hits, mut rounds) = (0, 0);
        for i in 0..soups.len() {
            for j in 0..soups.len() {
                for round in 0..12 {
                    let (pose_a, pose_b) = (dice.pose(0.3), dice.pose(f64::from(round) * 0.18));
                    let (a, b) = ((&soups[i], &objects[i], &pose_a), (&soups[j], &objects[j], &pose_b));
                    hits += usize::from(check(&mut algorithm, a, b) == 0.0);
                    rounds += 1;
                }
            }
        }
        assert!(hits > rounds / 6 && hits < rounds * 5 / 6, "{hits} of {rounds} collide: this tests one side only");
        assert_eq!(algorithm.work().fallbacks, 0, "nothing here is doubtful");
    }
}

/// Faces on faces, edges along edges and across, vertices exactly over vertices, edges and faces.
#[test]
fn boxes_in_line_are_answered_exactly() {
    let soups = [cut_box(2, [0.5; 3]), cut_box(1, [0.25, 0.5, 1.0])];
    let mut algorithm = VClip::default();
    let objects = soups.each_ref().map(|soup| load(&mut algorithm, soup));
    for turn in TURNS {
        for gap in [0.3, 1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 0.0, -1e-14, -1e-9, -1e-3, -0.3, -0.75] {
            for direction in [[1.0, 0.0, 0.0], [0.75, 0.25, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.3, 0.1]] {
                let pose_b = pose(turn, direction.map(|x| x * (1.0 + gap)));
                for (i, j) in [(0, 0), (0, 1), (1, 0)] {
                    let (a, b) = ((&soups[i], &objects[i]), (&soups[j], &objects[j]));
                    check(&mut algorithm, (a.0, a.1, &Pose::IDENTITY), (b.0, b.1, &pose_b));
                    check(&mut algorithm, (a.0, a.1, &pose_b), (b.0, b.1, &Pose::IDENTITY));
                }
            }
        }
    }
}

/// From the nearest points on, B comes closer until it is so many tolerances from A, or in A.
#[test]
fn near_contact_and_behind_it_nothing_is_missed() {
    let soups = [ellipsoid(3, [1.0, 0.7, 0.4]), cut_box(2, [0.6, 0.5, 0.9]), prism(9, 0.5, 0.7, 1.0)];
    let (mut algorithm, mut dice, mut hits) = (VClip::default(), Dice(4), 0);
    let objects: Vec<Object> = soups.iter().map(|soup| load(&mut algorithm, soup)).collect();
    for i in 0..soups.len() {
        for j in 0..soups.len() {
            for _ in 0..6 {
                let (pose_a, far) = (dice.pose(0.3), dice.pose(3.0));
                let (a, b) =
                    (Placed { object: &objects[i], pose: &pose_a }, Placed { object: &objects[j], pose: &far });
                let near = algorithm.distance(a, b, &mut Uncounted).expect("an answer");
                let [p, q] = near.points.expect("they are apart");
                let tau = Scene { a: &soups[i], b: &soups[j], pose_a, pose_b: far }.tau();
                for gap in [1e9, 1e4, 300.0, 30.0, 2.0, 0.5, -0.5, -2.0, -30.0, -1e4, -1e9, -1e14] {
                    let mut pose_b = far;
                    let share = 1.0 - gap * tau / near.distance;
                    TRANSLATION.iter().enumerate().for_each(|(k, &at)| pose_b.0[at] += share * (p[k] - q[k]));
                    let (a, b) = ((&soups[i], &objects[i], &pose_a), (&soups[j], &objects[j], &pose_b));
                    hits += usize::from(check(&mut algorithm, a, b) == 0.0);
                }
            }
        }
    }
    assert!(hits > 9 * 6 * 4, "{hits} collide: no contact was reached");
    assert!(algorithm.work().fallbacks > 0, "contact is doubtful");
}

#[test]
fn one_inside_the_other_has_its_distance_from_within() {
    let (outer, inner) = (cut_box(2, [1.0, 0.8, 0.6]), ellipsoid(4, [0.2, 0.15, 0.1]));
    let mut algorithm = VClip::default();
    let (around, within) = (load(&mut algorithm, &outer), load(&mut algorithm, &inner));
    let mut dice = Dice(12);
    for _ in 0..10 {
        let (pose_a, pose_b) = (Pose::IDENTITY, dice.pose(0.3));
        let apart = check(&mut algorithm, (&outer, &around, &pose_a), (&inner, &within, &pose_b));
        assert!(apart > 0.0);
        let (a, b) = (Placed { object: &around, pose: &pose_a }, Placed { object: &within, pose: &pose_b });
        assert_eq!(algorithm.inside(a, b, &mut Uncounted), Ok(true));
        check(&mut algorithm, (&inner, &within, &pose_b), (&outer, &around, &pose_a));
        let far = dice.pose(3.0);
        let b = Placed { object: &within, pose: &far };
        assert_eq!(algorithm.inside(a, b, &mut Uncounted), Ok(false));
    }
}

/// The walk needs rotations; other matrices are answered as given.
#[test]
fn poses_that_are_not_quite_rotations_are_left_to_gjk() {
    let soup = cut_box(2, [0.6, 0.5, 0.9]);
    let (mut algorithm, mut dice) = (VClip::default(), Dice(14));
    let object = load(&mut algorithm, &soup);
    for round in 0..40 {
        let [pose_a, mut pose_b] = [dice.pose(0.1), dice.pose(1.5)];
        for entry in [0, 1, 2, 4, 5, 6, 8, 9, 10] {
            pose_b.0[entry] += [1e-12, 1e-10, 1e-7, 1e-2][round % 4] * (dice.roll() - 0.5);
        }
        check(&mut algorithm, (&soup, &object, &pose_a), (&soup, &object, &pose_b));
    }
    // Two queries with every other pose.
    assert_eq!(algorithm.work().fallbacks, 40);
}

#[test]
fn what_is_not_convex_is_refused_with_the_reason() {
    support::convex::refuses_what_is_not_convex::<VClip>();
}

#[test]
fn a_shallow_dent_may_be_taken_for_none() {
    support::convex::takes_a_shallow_dent_for_none::<VClip>();
}
