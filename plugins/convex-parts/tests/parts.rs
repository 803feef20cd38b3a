//! The parts hold the surface, and how far they stick out says how wrong the answers are.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_convex_parts::ConvexParts;
use ocb_fields::{Lattice, Nearest, cover, inside};
use opencollbench_plugin::{Algorithm, Collision, Placed, Pose, Uncounted};
use parry3d_f64::transformation::try_convex_hull;
use support::{Dice, Loaded, Scene, Soup};

/// GJK's own tolerance, and that of parry's hulls.
const TOLERANCE: f64 = 1e-6;
/// Distance between points of a hull at which it is measured how far it sticks out.
const REACH: f64 = 0.03;

fn loaded(soup: &Soup, depth: u32) -> Loaded<ConvexParts> {
    Loaded::with(ConvexParts::with_depth(depth), soup)
}

fn within(hulls: &mut Loaded<ConvexParts>, pose_a: &Pose, pose_b: &Pose, reach: f64) -> bool {
    let (a, b) = (Placed { object: &hulls.a, pose: pose_a }, Placed { object: &hulls.a, pose: pose_b });
    hulls.algorithm.within(a, b, reach, &mut Uncounted)
}

/// Poses of an object and itself, so far apart, and the true distances.
fn scenes(soup: &Soup, seed: u64, turned: f64, apart: impl IntoIterator<Item = f64>) -> Vec<(Pose, Pose, f64)> {
    let mut dice = Dice(seed);
    let mut scene = |apart: f64| {
        let (pose_a, pose_b) = (dice.pose(turned), dice.pose(apart));
        (pose_a, pose_b, Scene::of(soup, pose_a, pose_b).truth().distance)
    };
    apart.into_iter().map(&mut scene).collect()
}

/// How far the hulls reach over the surface.
fn sticks_out(soup: &Soup, object: &<ConvexParts as Algorithm>::Object) -> f64 {
    let (nearest, mut near) = (Nearest::new(&soup.view()), 0);
    let hulls = object.iter().map(|part| {
        let (points, triangles) = try_convex_hull(&part.points).expect("parts of a torus have a volume");
        Soup { positions: points.iter().map(|p| p.to_array()).collect(), triangles }
    });
    let points = hulls.flat_map(|hull| cover(&hull.view(), REACH));
    // What of a hull lies inside the object does no harm; the first node of a lattice can be asked for alone.
    let is_outside = |p: &[f64; 3]| !inside(&soup.view(), &Lattice { origin: *p, spacing: 1e-9, nodes: [2; 3] })[0];
    points.filter(is_outside).map(|p| nearest.distance(p, 0.0, &mut near)).fold(0.0, f64::max) + REACH
}

#[test]
fn distances_err_downwards_by_no_more_than_hulls_stick_out_and_less_with_more_parts() {
    let soup = Soup::torus(16, 8);
    let scenes = scenes(&soup, 4, 0.3, (0..40).map(|round| 1.5 + f64::from(round) * 0.04));
    let mut errors = Vec::new();
    for depth in [2, 4, 6] {
        let mut hulls = loaded(&soup, depth);
        let parts = hulls.a.len();
        assert!(parts <= 1 << depth && 2 * parts > 1 << depth, "{parts} parts");
        let out = sticks_out(&soup, &hulls.a);
        let mut sum = 0.0;
        for (pose_a, pose_b, truth) in &scenes {
            let answer = hulls.distance(pose_a, pose_b).distance;
            assert!(answer <= truth + TOLERANCE, "{parts} parts: {answer} is more than {truth}");
            assert!(answer >= truth - 2.0 * out - TOLERANCE, "{parts} parts: {answer} for {truth} with {out}");
            for (reach, near) in [(0.9 * answer, answer == 0.0), (1.1 * answer + 1e-3, true)] {
                assert_eq!(within(&mut hulls, pose_a, pose_b, reach), near, "{parts} parts: {answer} within {reach}");
            }
            assert!(*truth > 0.0 || hulls.collide(pose_a, pose_b) != Collision::Apart, "missed with {parts} parts");
            sum += truth - answer;
        }
        println!("{parts} parts stick out by {out:.3}: mean error {:.4}", sum / 40.0);
        errors.push((out, sum));
    }
    for pair in errors.windows(2) {
        assert!(pair[1].0 < pair[0].0 && pair[1].1 < 0.8 * pair[0].1, "{errors:?}");
    }
}

/// A ring has hulls that close a part of its hole.
#[test]
fn what_lies_in_a_dent_is_a_false_alarm_until_there_are_enough_parts() {
    let (ring, small) = (Soup::torus(16, 8), Soup::torus(16, 8).moved(0.1, 0.0));
    let alarms = [2, 4, 6].map(|depth| {
        let mut hulls = Loaded::two(ConvexParts::with_depth(depth), &ring, &small);
        let mut alarms = 0;
        for step in 0..24 {
            let (mut pose, (sin, cos)) = (Pose::IDENTITY, (f64::from(step) * std::f64::consts::TAU / 24.0).sin_cos());
            (pose.0[3], pose.0[7]) = (0.42 * cos, 0.42 * sin);
            let scene = Scene { a: &ring, b: &small, pose_a: Pose::IDENTITY, pose_b: pose };
            assert!(scene.truth().distance > 0.01);
            alarms += usize::from(hulls.collide(&Pose::IDENTITY, &pose) != Collision::Apart);
        }
        alarms
    });
    println!("{alarms:?} false alarms of 24");
    assert!(alarms[0] > alarms[1] && alarms[1] >= alarms[2], "{alarms:?}");
}

#[test]
fn soups_have_parts_too_and_what_is_far_is_clear() {
    let mut open = Soup::torus(16, 8);
    open.triangles.truncate(130);
    for soup in [Soup::scraps(), open] {
        let (mut hulls, mut hits) = (loaded(&soup, 4), 0);
        for (pose_a, pose_b, truth) in scenes(&soup, 3, 0.1, (0..40).map(|round| f64::from(round) / 20.0)) {
            hits += usize::from(truth == 0.0);
            let answer = hulls.distance(&pose_a, &pose_b).distance;
            assert!(answer <= truth + TOLERANCE, "{answer} is more than {truth}");
        }
        assert!(hits > 2 && hits < 38, "{hits} of 40 collide: this tests one side only");
        let mut far = Pose::IDENTITY;
        far.0[11] = 10.0;
        assert_eq!(hulls.collide(&Pose::IDENTITY, &far), Collision::Apart);
    }
}
