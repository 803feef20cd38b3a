//! How far the answers are from the truth, and how that shrinks with the cells.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_distance_field::DistanceField;
use opencollbench_plugin::{Algorithm, Collision, Distance, Placed, Pose, Refusal, Uncounted};
use support::{Dice, Loaded, Scene, Soup};

/// Of the README, in cells: what a value may be off close to the object.
const NEAR: f64 = 0.97;
/// Further away.
const FAR: f64 = 2.9;
/// How far the surface may be from the next point.
const REACH: f64 = 0.5;
const RESOLUTIONS: [usize; 3] = [8, 24, 72];

fn loaded(soup: &Soup, resolution: usize) -> Loaded<DistanceField> {
    Loaded::with(DistanceField::with_resolution(resolution), soup)
}

fn longest_side(soup: &Soup) -> f64 {
    let side = |i: usize| {
        let all = soup.positions.iter().map(|p| p[i]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(side).fold(0.0, f64::max)
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

/// A torus, and the same with a hole: with an inside and without.
fn soups() -> [(Soup, bool); 2] {
    let closed = Soup::torus(16, 8);
    let mut open = closed.clone();
    open.triangles.pop();
    [(closed, true), (open, false)]
}

#[test]
fn a_distance_is_within_its_bound_and_better_with_more_cells() {
    for (soup, closed) in soups() {
        let scenes = scenes(&soup, 4, 0.3, (0..30).map(|round| 2.0 + f64::from(round) * 0.06));
        let mut errors = Vec::new();
        for resolution in RESOLUTIONS {
            let mut field = loaded(&soup, resolution);
            assert_eq!(field.a.closed, closed);
            let cell = longest_side(&soup) / resolution as f64;
            let (mut sum, mut most) = (0.0, 0.0f64);
            for (pose_a, pose_b, truth) in &scenes {
                let error = field.distance(pose_a, pose_b).distance - truth;
                // What is taken to touch is answered by 0.
                let below = if closed { FAR } else { FAR + NEAR + REACH };
                assert!(
                    error >= -below * cell && error <= (FAR + REACH) * cell,
                    "{resolution}: {} cells",
                    error / cell
                );
                (sum, most) = (sum + error.abs(), most.max(error.abs()));
            }
            println!("closed {closed}, {resolution} cells: mean error {:.5}, largest {most:.5}", sum / 30.0);
            errors.push(sum);
        }
        assert!(errors[1] < 0.6 * errors[0] && errors[2] < 0.6 * errors[1], "{errors:?}");
    }
}

#[test]
fn a_wrong_collision_answer_is_a_close_one_and_rarer_with_more_cells() {
    for (soup, closed) in soups() {
        let scenes = scenes(&soup, 6, 0.1, (0..40).map(|round| 2.0 + f64::from(round) * 0.03));
        let mut wrong = Vec::new();
        for resolution in RESOLUTIONS {
            let mut field = loaded(&soup, resolution);
            let cell = longest_side(&soup) / resolution as f64;
            let (mut hits, mut alarms, mut misses) = (0, 0, 0);
            for &(ref pose_a, ref pose_b, truth) in &scenes {
                let answer = field.collide(pose_a, pose_b) != Collision::Apart;
                assert_eq!(answer, field.distance(pose_a, pose_b).distance == 0.0);
                assert!(closed || answer || truth > 0.0, "missed, without an inside, at {pose_a:?} {pose_b:?}");
                if answer {
                    let bound = if closed { NEAR } else { 2.0 * NEAR + REACH };
                    assert!(truth <= bound * cell, "{resolution}: a false alarm at {} cells", truth / cell);
                }
                hits += usize::from(answer);
                alarms += usize::from(answer && truth > 0.0);
                misses += usize::from(!answer && truth == 0.0);
            }
            println!("closed {closed}, {resolution} cells: {alarms} false alarms, {misses} misses of 40");
            assert!(hits > 3 && hits < 36, "{hits} of 40 collide: this tests one side only");
            wrong.push(alarms + misses);
        }
        assert!(wrong[0] >= wrong[1] && wrong[1] >= wrong[2] && wrong[0] > wrong[2], "{wrong:?}");
    }
}

#[test]
fn deep_is_found_far_is_clear_and_beyond_the_field_it_gives_up() {
    for (soup, _) in soups() {
        let mut field = loaded(&soup, 24);
        let mut pose = Pose::IDENTITY;
        // A quarter of the tube deep.
        pose.0[3] = 0.15;
        assert_ne!(field.collide(&Pose::IDENTITY, &pose), Collision::Apart);
        pose.0[3] = 50.0;
        assert_eq!(field.collide(&Pose::IDENTITY, &pose), Collision::Apart);
        let Loaded { mut algorithm, a: object, .. } = field;
        let (a, b) = (Placed { object: &object, pose: &Pose::IDENTITY }, Placed { object: &object, pose: &pose });
        assert_eq!(algorithm.distance(a, b, &mut Uncounted), Err(Refusal::GaveUp));
    }
}

/// As solid bodies they collide, and an inside is all that the field knows.
#[test]
fn a_body_inside_another_one_collides() {
    let large = Soup::torus(16, 8);
    let small = large.moved(0.05, 0.0);
    let mut algorithm = DistanceField::default();
    let [large, small] = [&large, &small].map(|soup| algorithm.load_mesh(soup.view()).expect("the mesh loads"));
    let mut pose = Pose::IDENTITY;
    for (x, expected) in [(1.0, true), (0.0, false), (3.0, false)] {
        pose.0[3] = x;
        let (a, b) = (Placed { object: &large, pose: &Pose::IDENTITY }, Placed { object: &small, pose: &pose });
        for (a, b) in [(a, b), (b, a)] {
            let answer = algorithm.collide(a, b, &mut Uncounted).expect("an answer");
            assert_eq!(answer != Collision::Apart, expected, "at {x}");
        }
    }
}
