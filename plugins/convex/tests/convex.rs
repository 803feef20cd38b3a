//! GJK against all pairs of triangles, and which objects it is not for.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_convex::Convex;
use opencollbench_plugin::{Algorithm, Collision, Distance, Parameters, Placed, Pose, Refusal, Uncounted};
use support::convex::{cut_box, ellipsoid};
use support::{Dice, Scene, Soup, apply};

type Body = <Convex as Algorithm>::Object;

fn body(soup: &Soup) -> Body {
    Convex::default().load_mesh(soup.view()).expect("it is convex")
}

/// Asks about A and B in these poses; gives the distance.
fn check(a: (&Soup, &Body, &Pose), b: (&Soup, &Body, &Pose)) -> f64 {
    let (placed_a, placed_b) = (Placed { object: a.1, pose: a.2 }, Placed { object: b.1, pose: b.2 });
    let scene = Scene { a: a.0, b: b.0, pose_a: *a.2, pose_b: *b.2 };
    let (expected, tau) = (scene.truth().distance, scene.tau());
    let answer = Convex::default().distance(placed_a, placed_b, &mut Uncounted).expect("an answer");
    let off = (answer.distance - expected).abs();
    assert!(off <= tau, "{} instead of {expected}, {:.0} tau, at {:?} {:?}", answer.distance, off / tau, a.2, b.2);
    let hit = Convex::default().collide(placed_a, placed_b, &mut Uncounted).expect("an answer") != Collision::Apart;
    assert!(hit == (expected == 0.0) || expected <= tau, "{hit} at {expected}, {:?} {:?}", a.2, b.2);
    if let Some([p, q]) = answer.points {
        let gap = (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt();
        assert!((gap - answer.distance).abs() <= tau);
        for (point, (soup, _, pose)) in [(p, a), (q, b)] {
            let corners = |i: usize| soup.view().corners(i).map(|corner| apply(pose, corner));
            let off = |i: usize| ocb_triangles::distance(&[point; 3], &corners(i)).squared.sqrt();
            assert!((0..soup.triangles.len()).any(|i| off(i) <= tau), "{point:?} is on no triangle");
        }
    }
    expected
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
    let whole = cut_box(2, [1.0; 3]);
    let with = |change: &dyn Fn(&mut Soup)| {
        let mut soup = whole.clone();
        change(&mut soup);
        soup
    };
    let dented = with(&|soup| soup.positions.iter_mut().filter(|p| **p == [0.0, 0.0, 1.0]).for_each(|p| p[2] -= 1e-9));
    let open = with(&|soup| soup.triangles.truncate(soup.triangles.len() - 1));
    let doubled = with(&|soup| {
        soup.triangles.pop();
        soup.triangles.extend(soup.triangles.clone());
    });
    let needle = with(&|soup| soup.triangles.push([0, 0, 0]));
    let wall = with(&|soup| {
        // From both sides, with vertices of its own.
        soup.positions.extend([[0.5, 0.1, 0.0], [-0.5, 0.2, 0.0], [0.0, -0.5, 0.3]]);
        let first = soup.positions.len() as u32 - 3;
        soup.triangles.extend([[first, first + 1, first + 2], [first + 1, first, first + 2]]);
    });
    let flat = Soup { positions: whole.positions[..3].to_vec(), triangles: vec![[0, 1, 3], [1, 0, 3]] };
    let flat = Soup { positions: [&flat.positions[..], &[[-1.0, 1.0, 1.0]]].concat(), ..flat };
    for (soup, reason) in [
        (Soup::torus(8, 4), "in front of its triangle"),
        (dented, "in front of its triangle"),
        (open, "belongs to 1 triangles"),
        (doubled, "belongs to 4 triangles"),
        (needle, "belongs to"),
        (wall, "comes twice"),
        (flat, "comes twice"),
    ] {
        match Convex::default().load_mesh(soup.view()) {
            Err(Refusal::Error(sentence)) => assert!(sentence.contains(reason), "{sentence} is not {reason}"),
            other => panic!("{reason}: {other:?}"),
        }
    }
    // A tetrahedron without height.
    let flat = Soup {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [1, 3, 2], [0, 1, 3], [0, 3, 2]],
    };
    assert!(
        matches!(Convex::default().load_mesh(flat.view()), Err(Refusal::Error(sentence)) if sentence.contains("flat"))
    );
}

/// Coordinates in single precision dent what is round; then the error is the dent's.
#[test]
fn a_shallow_dent_may_be_taken_for_none() {
    let mut soup = cut_box(6, [0.5, 0.4, 0.3]);
    let (s, c) = 0.3f64.sin_cos();
    soup.positions.iter_mut().for_each(|p| {
        *p = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]].map(|x| f64::from(x as f32));
    });
    assert!(Convex::default().load_mesh(soup.view()).is_err(), "turned in single precision, its sides are not flat");
    let mut lax = Convex::default();
    lax.set("dent", 1e-6).expect("the parameter exists");
    let body = lax.load_mesh(soup.view()).expect("its dents are shallow");
    let (mut dice, mut worst) = (Dice(3), 0.0f64);
    for _ in 0..20 {
        let (pose_a, pose_b) = (dice.pose(0.0), dice.pose(1.6));
        let truth = Scene::of(&soup, pose_a, pose_b).truth().distance;
        let (a, b) = (Placed { object: &body, pose: &pose_a }, Placed { object: &body, pose: &pose_b });
        let answer = lax.distance(a, b, &mut Uncounted).expect("an answer").distance;
        assert!(answer > 0.0);
        worst = worst.max((answer - truth).abs());
    }
    assert!(worst <= 2e-6, "{worst}");
}
