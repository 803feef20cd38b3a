//! One object inside the other: the flag, and what it means for solid bodies.

mod common;

use common::families::Triangle;
use common::random::Random;
use common::{mesh, placed};
use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::{Class, Configuration, Containment, Placed};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::stock;
use ocb_core::validation::{Precision, Terms, judge};

/// An axis-aligned cube of twelve triangles around a centre.
fn cube(centre: [f64; 3], half: f64) -> Vec<Triangle> {
    const CORNERS: [[f64; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];
    const FACES: [[usize; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    let corner = |i: usize| Point3::from(Vector3::from(centre) + Vector3::from(CORNERS[i]) * half);
    FACES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|t| t.map(corner)).collect()
}

fn flag(a: &[Triangle], b: &[Triangle]) -> Option<Containment> {
    let (a, b) = (Shape::from_triangles(a), Shape::from_triangles(b));
    let pair = Pair::new(&a, &b);
    let truth = pair.truth(&placed(Pose::identity()));
    assert_eq!(truth.containment, pair.tightest_truth(&placed(Pose::identity())).containment);
    truth.containment
}

#[test]
fn cubes_in_cubes() {
    let big = cube([0.0; 3], 1.0);
    assert_eq!(flag(&big, &cube([0.0; 3], 0.5)), Some(Containment::BInA));
    assert_eq!(flag(&cube([0.0; 3], 0.5), &big), Some(Containment::AInB));
    assert_eq!(flag(&big, &cube([3.0, 0.0, 0.0], 0.5)), Some(Containment::Apart));
    // Touching or crossing: no question.
    assert_eq!(flag(&big, &cube([0.0; 3], 1.0)), None);
    assert_eq!(flag(&big, &cube([0.5, 0.0, 0.0], 0.75)), None);
    // Without a lid nothing is inside.
    assert_eq!(flag(&big[1..], &cube([0.0; 3], 0.5)), None);
    assert_eq!(flag(&big, &cube([0.0; 3], 0.5)[..11]), None);
}

#[test]
fn parts_and_cavities() {
    let big = cube([0.0; 3], 1.0);
    let join = |parts: [&[Triangle]; 2]| parts.concat();
    // One part outside, one inside.
    let two = join([&cube([5.0, 0.0, 0.0], 0.5), &cube([0.0; 3], 0.25)]);
    assert_eq!(flag(&big, &two), Some(Containment::BInA));
    // Each has a part in the other.
    let (a, b) = (join([&big, &cube([9.0, 0.0, 0.0], 0.5)]), join([&cube([0.0; 3], 0.5), &cube([9.0, 0.0, 0.0], 1.0)]));
    assert_eq!(flag(&a, &b), Some(Containment::Both));
    // In the cavity of a hollow cube it is outside; in its wall it would be inside.
    let hollow = join([&big, &cube([0.0; 3], 0.5)]);
    assert_eq!(flag(&hollow, &cube([0.0; 3], 0.25)), Some(Containment::Apart));
    assert_eq!(flag(&hollow, &cube([0.75, 0.0, 0.0], 0.125)), Some(Containment::BInA));
}

/// The first vertex that is asked lies exactly on the diagonals and planes of the other's faces, at all sizes.
#[test]
fn special_positions_and_sizes() {
    for exponent in [-500, -40, 0, 40, 480] {
        let size = 2f64.powi(exponent);
        let scaled = |t: Vec<Triangle>| -> Vec<Triangle> { t.into_iter().map(|t| t.map(|p| p * size)).collect() };
        let big = scaled(cube([0.0; 3], 1.0));
        assert_eq!(flag(&big, &scaled(cube([0.0; 3], 0.5))), Some(Containment::BInA), "{exponent}");
        assert_eq!(flag(&big, &scaled(cube([4.0, 4.0, 4.0], 1.0))), Some(Containment::Apart), "{exponent}");
        assert_eq!(flag(&big, &scaled(cube([0.0, 0.0, 2.5], 1.0))), Some(Containment::Apart), "{exponent}");
    }
    // Far from the origin only a few bits are left of the small one.
    let far = 2f64.powi(50);
    let big = cube([far, far, -far], 8.0);
    assert_eq!(flag(&big, &cube([far, far, -far], 1.0)), Some(Containment::BInA));
    assert_eq!(flag(&big, &cube([far + 16.0, far, -far], 1.0)), Some(Containment::Apart));
}

/// Against the winding number, summed over all triangles in f64.
#[test]
fn random_poses_agree_with_the_winding_number() {
    let knot = std::sync::Arc::new(stock::generate("torus-knot", 2000).expect("a stock object"));
    let small = |p: Point3<f64>| Point3::from(p.coords * (0.02 * knot.longest_side()));
    let grain: Vec<Triangle> = cube([0.1, 0.0, 0.0], 0.5).into_iter().map(|t| t.map(small)).collect();
    let (a, b) = (Shape::new(knot.clone()), Shape::from_triangles(&grain));
    assert!(a.is_closed() && b.is_closed());
    let pair = Pair::new(&a, &b);
    let mut random = Random(5);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..4000 {
        let (pose_a, mut pose_b) = (random.pose(1.0), random.pose(0.0));
        // Anywhere in A's box.
        let middle = nalgebra::center(&knot.bounds().min, &knot.bounds().max);
        let place = Vector3::from_fn(|k, _| middle[k] + random.signed() * 0.5 * knot.bounds().sides()[k]);
        pose_b.translation = pose_a.apply(&Point3::from(place)).coords;
        // No rotation any more: such poses have no hierarchy of their own.
        if random.below(8) == 0 {
            pose_b.linear *= Matrix3::from_diagonal_element(0.5);
        }
        let configuration = Configuration { pose_a, pose_b };
        let truth = pair.truth(&configuration);
        let Some(found) = truth.containment else {
            assert!(truth.hit);
            continue;
        };
        let expected = winding(&pair, &configuration).abs() > 0.5;
        assert_eq!(found == Containment::BInA, expected, "{configuration:?} {truth:?}");
        if expected { inside += 1 } else { outside += 1 }
    }
    assert!(inside > 50 && outside > 500, "{inside} inside, {outside} outside");
}

/// Of A's surface around the first vertex of B (van Oosterom and Strackee 1983).
fn winding(pair: &Pair, configuration: &Configuration) -> f64 {
    let point = configuration.pose_b.apply(&pair.b().positions()[0]);
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| configuration.pose_a.apply(&pair.a().positions()[v as usize]) - point);
        let (x, y, z) = (a.norm(), b.norm(), c.norm());
        2.0 * a.dot(&b.cross(&c)).atan2(x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y)
    };
    pair.a().triangles().iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

#[test]
fn an_open_object_encloses_nothing() {
    let bunny = Shape::new(mesh("bunny65k"));
    if !bunny.is_closed() {
        let configuration = placed(Pose { translation: Vector3::repeat(9.0), ..Pose::identity() });
        assert_eq!(Pair::new(&bunny, &bunny).truth(&configuration).containment, None);
    }
}

#[test]
fn solid_bodies_collide_when_one_is_inside_the_other() {
    let (a, b) = (Shape::from_triangles(&cube([0.0; 3], 1.0)), Shape::from_triangles(&cube([0.0; 3], 0.5)));
    let pair = Pair::new(&a, &b);
    let configuration = placed(Pose::identity());
    let placed =
        Placed { configuration, truth: pair.truth(&configuration), rounded: None, root_index: 0, wanted: None };
    assert_eq!((placed.truth.hit, placed.truth.class64), (false, Class::Clear));
    let solid = pair.asked(&configuration, &placed.truth, Semantics::Solid);
    assert_eq!((solid.hit, solid.class64, solid.class32), (true, Class::Colliding, Class::Colliding));
    assert_eq!((solid.distance_lo, solid.distance_hi, solid.margin), (0.0, 0.0, placed.truth.distance_lo / 2.0));

    let verdict = |semantics, query, answer: Answer| {
        judge(&pair, &placed, Terms { query, semantics, precision: Precision::Double }, &answer).verdict
    };
    let says = |semantics, hit, pair| verdict(semantics, Query::CollisionFirst, Answer::Collision { hit, pair });
    assert_eq!(says(Semantics::Surface, false, None), Verdict::Correct);
    assert_eq!(says(Semantics::Surface, true, None), Verdict::FalsePositive);
    assert_eq!(says(Semantics::Solid, true, None), Verdict::Correct);
    assert_eq!(says(Semantics::Solid, false, None), Verdict::FalseNegative);
    assert_eq!(says(Semantics::Solid, true, Some([0, 0])), Verdict::WrongWitness);
    let measures = |semantics, distance: f64, points: Option<[[f64; 3]; 2]>, triangles| {
        let points = points.map(|p| p.map(Point3::from));
        verdict(semantics, Query::Proximity, Answer::Distance { distance, points, triangles })
    };
    assert_eq!(measures(Semantics::Surface, 0.5, None, None), Verdict::Correct);
    assert_eq!(measures(Semantics::Solid, 0.5, None, None), Verdict::FalseNegative);
    assert_eq!(measures(Semantics::Solid, 0.0, None, None), Verdict::Correct);
    assert_eq!(measures(Semantics::Solid, 0.0, Some([[0.0; 3]; 2]), None), Verdict::Correct);
    assert_eq!(measures(Semantics::Solid, 0.0, Some([[0.0; 3], [0.0, 0.0, 0.5]]), None), Verdict::WrongWitness);
    assert_eq!(measures(Semantics::Solid, 0.0, None, Some([0, 0])), Verdict::WrongWitness);
}
