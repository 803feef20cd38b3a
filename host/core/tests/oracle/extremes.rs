//! Numbers at the ends of the range.

use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

use crate::brute_force::{all_pairs, scaled, soup, sparse};
use crate::common::families::Case;
use crate::common::placed;
use crate::common::random::Random;
use crate::pairs::exact;

/// What must hold where results may be subnormal or infinite.
fn check(case: &Case) -> bool {
    let exact = exact(&case.a, &case.b, &case.configuration);
    let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
    let (pair, c, hit) = (Pair::new(&a, &b), &case.configuration, exact.is_zero());
    assert_eq!(pair.hit(c), hit, "{case:?}");
    for t in [pair.truth(c), pair.tightest_truth(c)] {
        assert_eq!(t.hit, hit, "{case:?}");
        assert!(exact.root_is_in((t.distance_lo, t.distance_hi)), "{case:?}: {t:?}");
        assert_eq!(t.distance_hi == 0.0, hit, "{case:?}: {t:?}");
        assert!(t.margin >= 0.0 && t.margin.is_finite() && (hit || t.margin == 0.0), "{case:?}: {t:?}");
    }
    hit
}

/// The largest number in the case is about two to this power.
fn size(case: &Case) -> i32 {
    let shifts = [&case.configuration.pose_a, &case.configuration.pose_b].map(|p| p.translation.amax());
    let corners = case.a.iter().chain(&case.b).map(|p| p.coords.amax()).fold(0.0, f64::max);
    corners.max(shifts[0]).max(shifts[1]).log2().ceil() as i32
}

#[test]
fn huge_tiny_and_subnormal_coordinates() {
    let mut random = Random(5);
    let mut seen = [0, 0];
    for exponent in [-1074, -1065, -1040, -1022, -1000, -700, -510, -340, 340, 505, 700, 1000, 1019] {
        for number in 0..150 {
            let mut case = Case::draw(0xe0_0000 + number);
            case.scale(2f64.powi(-size(&case)));
            // In two steps: the factor itself may be out of range.
            case.scale(2f64.powi(exponent / 2));
            case.scale(2f64.powi(exponent - exponent / 2));
            seen[usize::from(check(&case))] += 1;
        }
        // Of very different size.
        for _ in 0..20 {
            let mut case = Case::draw(0xe1_0000 + u64::from(random.below(1000) as u32));
            case.scale(2f64.powi(-size(&case)));
            let factor = 2f64.powi(exponent / 2);
            case.b = case.b.map(|p| p * factor * factor);
            check(&case);
        }
    }
    assert!(seen.iter().all(|n| *n > 300), "{seen:?} apart and together");
}

#[test]
fn meshes_beyond_what_doubles_can_square() {
    let mut random = Random(6);
    let shape = Shape::from_triangles(&soup(&sparse("torus-knot"))[..24]);
    for factor in [1e300, 1e160, 1e-160, 1e-290, 1e-310] {
        let object = scaled(&shape, factor);
        let pair = Pair::new(&object, &object);
        for reach in [0.3, 0.9, 3.0] {
            let mut pose = random.pose(reach);
            pose.translation *= factor;
            let c = placed(pose);
            let (contacts, distance) = all_pairs(&object, &object, &c);
            assert_eq!(pair.contacts(&c), contacts, "{factor:e}");
            for t in [pair.truth(&c), pair.tightest_truth(&c)] {
                assert_eq!(t.hit, !contacts.is_empty(), "{factor:e}");
                assert!(distance.root_is_in((t.distance_lo, t.distance_hi)), "{factor:e}: {t:?}");
            }
        }
    }
}

#[test]
fn the_largest_numbers_there_are() {
    let corner = |x: f64| [[x, 0.0, 0.0], [x, x, 0.0], [x, 0.0, f64::MAX]].map(nalgebra::Point3::from);
    let (left, right) = (Shape::from_triangles(&[corner(-f64::MAX)]), Shape::from_triangles(&[corner(f64::MAX)]));
    let t = Pair::new(&left, &right).tightest_truth(&placed(Pose::identity()));
    // Twice the largest number is none.
    assert_eq!((t.hit, t.distance_hi), (false, f64::INFINITY));
    assert!(t.distance_lo >= f64::MAX, "{t:?}");
    // A pose that brings both back to one place.
    let mut pose_b = Pose::identity();
    pose_b.linear[(0, 0)] = -1.0;
    pose_b.linear[(1, 1)] = -1.0;
    let c = Configuration { pose_a: Pose::identity(), pose_b };
    assert!(Pair::new(&left, &right).hit(&c) && Pair::new(&left, &right).tightest_truth(&c).hit);
}
