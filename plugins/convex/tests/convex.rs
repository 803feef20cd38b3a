//! GJK against all pairs of triangles, and which objects it is not for.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_convex::Convex;
use opencollbench_plugin::{Algorithm, Placed, Pose, Uncounted};
use support::convex::{cut_box, ellipsoid};
use support::{Dice, Soup};

type Body = <Convex as Algorithm>::Object;

fn body(soup: &Soup) -> Body {
    Convex::default().load_mesh(soup.view()).expect("it is convex")
}

/// Asks about A and B in these poses; gives the distance.
fn check(a: (&Soup, &Body, &Pose), b: (&Soup, &Body, &Pose)) -> f64 {
    support::convex::check(&mut Convex::default(), a, b)
}

#[test]
fn convex_objects_are_answered_exactly() {
    let soups = [ellipsoid(5, [1.0, 0.7, 0.4]), cut_box(3, [0.6, 0.5, 0.9]), ellipsoid(1, [1.0; 3])];
    let bodies: Vec<Body> = soups.iter().map(body).collect();
    let (mut dice, mut hits, mut rounds) = (Dice(2), 0, 0);
    for i in 0..soups.len() {
        for j in 0..soups.len() {
            for round in 0..12 {
                let (pose_a, pose_b) = (dice.pose(0.3), dice.pose(0.5 + f64::from(round) * 0.15));
                let apart = check((&soups[i], &bodies[i], &pose_a), (&soups[j], &bodies[j], &pose_b));
                (hits, rounds) = (hits + usize::from(apart == 0.0), rounds + 1);
            }
        }
    }
    assert!(hits > rounds / 6 && hits < rounds * 5 / 6, "{hits} of {rounds} collide: this tests one side only");
}

/// Axes along axes, faces on faces, edges on edges: where everything is degenerate.
#[test]
fn boxes_side_by_side_and_almost_touching() {
    let soup = cut_box(2, [0.5; 3]);
    let body = body(&soup);
    for gap in [0.3, 1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-9, -1e-3, -0.3] {
        for direction in [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.3, 0.1]] {
            let mut pose = Pose::IDENTITY;
            (0..3).for_each(|i| pose.0[4 * i + 3] = direction[i] * (1.0 + gap));
            check((&soup, &body, &Pose::IDENTITY), (&soup, &body, &pose));
        }
    }
}

#[test]
fn one_inside_the_other_has_its_distance_from_within() {
    let (outer, inner) = (cut_box(2, [1.0, 0.8, 0.6]), ellipsoid(4, [0.2, 0.15, 0.1]));
    let (around, within) = (body(&outer), body(&inner));
    let mut dice = Dice(12);
    for _ in 0..10 {
        let (pose_a, pose_b) = (Pose::IDENTITY, dice.pose(0.3));
        let apart = check((&outer, &around, &pose_a), (&inner, &within, &pose_b));
        assert!(apart > 0.0);
        let (a, b) = (Placed { object: &around, pose: &pose_a }, Placed { object: &within, pose: &pose_b });
        assert_eq!(Convex::default().inside(a, b, &mut Uncounted), Ok(true));
        check((&inner, &within, &pose_b), (&outer, &around, &pose_a));
        let far = dice.pose(3.0);
        let b = Placed { object: &within, pose: &far };
        assert_eq!(Convex::default().inside(a, b, &mut Uncounted), Ok(false));
    }
}

#[test]
fn what_is_not_convex_is_refused_with_the_reason() {
    support::convex::refuses_what_is_not_convex::<Convex>();
}

/// Coordinates in single precision dent round shapes; then the error is the dent's.
#[test]
fn a_shallow_dent_may_be_taken_for_none() {
    support::convex::takes_a_shallow_dent_for_none::<Convex>();
}
