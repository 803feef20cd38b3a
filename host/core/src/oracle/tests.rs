//! The filters against exact arithmetic.

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use families::Case;

use super::closest::closest;
use super::exact::ExactPair;
use super::filter;
use super::margin::crossing;
use super::triangle::Triangle;
use crate::pose::Pose;

#[allow(dead_code, reason = "the tests outside need more")]
#[path = "../../tests/common/families.rs"]
mod families;
#[allow(dead_code, reason = "the tests outside need more")]
#[path = "../../tests/common/random.rs"]
mod random;

type Corners = [Point3<f64>; 3];

/// Everything f64 says about a pair must be confirmed; true when the filter decided.
fn check(pose_a: &Pose, a: &Corners, pose_b: &Pose, b: &Corners) -> bool {
    let exact = ExactPair::new(pose_a, a, pose_b, b);
    let hit = exact.hit();
    let (lo, hi) = exact.distance();
    assert_eq!(hit, hi == 0.0);
    let mut decided = true;
    for scale in [1.0, 0.25] {
        let (ta, tb) = (Triangle::mapped(pose_a, a, scale), Triangle::mapped(pose_b, b, scale));
        match filter::hit(&ta, &tb) {
            Some(said) => assert_eq!(said, hit, "{a:?} {b:?}"),
            None => decided = false,
        }
        let near = closest(&ta, &tb);
        assert!(near.lo <= hi * scale && lo * scale <= near.hi, "{near:?} {lo} {hi} {a:?} {b:?}");
        assert!(crossing(&ta, &tb).is_none() || hit, "a crossing of {a:?} {b:?}");
    }
    decided
}

/// `OCB_PAIRS` of them; `make soak` asks for ten million.
#[test]
fn the_filters_never_contradict_exact_arithmetic_on_troublesome_pairs() {
    let count: u64 = std::env::var("OCB_PAIRS").map_or(200_000, |n| n.parse().expect("OCB_PAIRS is a number"));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let decided: u64 = std::thread::scope(|scope| {
        let parts: Vec<_> = (0..threads)
            .map(|first| {
                let numbers = (first..count).step_by(threads as usize);
                let decided = move |number: &u64| {
                    let Case { a, b, configuration: c, .. } = Case::draw(*number);
                    check(&c.pose_a, &a, &c.pose_b, &b)
                };
                scope.spawn(move || numbers.filter(decided).count() as u64)
            })
            .collect();
        parts.into_iter().map(|part| part.join().expect("a pair failed, see above")).sum()
    });
    println!("{count} pairs, {decided} of them decided without integers: 0 contradictions");
    // A filter that never decides contradicts nothing.
    assert!(decided > count / 2, "only {decided} of {count} decided");
}

/// Numbers of all the kinds that make trouble.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-3i32..=3).prop_map(f64::from),
        2 => -1.0f64..1.0,
        1 => (-3i32..=3, -40i32..-10).prop_map(|(x, e)| f64::from(x) + 2f64.powi(e)),
        1 => (-2i32..=2).prop_map(|x| f64::from(x) * 1e6 + 0.1),
    ]
}

fn corners() -> impl Strategy<Value = Corners> {
    prop::array::uniform9(coordinate()).prop_map(|c| [0, 3, 6].map(|i| Point3::new(c[i], c[i + 1], c[i + 2])))
}

fn pose() -> impl Strategy<Value = Pose> {
    let rotation = prop::array::uniform3(-3.2f64..3.2)
        .prop_map(|[x, y, z]| *UnitQuaternion::from_euler_angles(x, y, z).to_rotation_matrix().matrix());
    let linear = prop_oneof![Just(Matrix3::identity()), rotation];
    (linear, prop::array::uniform3(coordinate())).prop_map(|(linear, t)| Pose { linear, translation: Vector3::from(t) })
}

/// Triangles of the same plane, mapped: touching in exact arithmetic before the rounding, anything after.
fn coplanar() -> impl Strategy<Value = (Corners, Corners)> {
    prop::array::uniform6((-4i32..=4, -4i32..=4)).prop_map(|p| {
        let point = |(x, y): (i32, i32)| Point3::new(f64::from(x), f64::from(y), f64::from(x + 2 * y) / 3.0);
        (std::array::from_fn(|i| point(p[i])), std::array::from_fn(|i| point(p[i + 3])))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_filters_never_contradict_exact_arithmetic(a in corners(), b in corners(), m in pose(), n in pose()) {
        check(&Pose::identity(), &a, &Pose::identity(), &b);
        check(&m, &a, &n, &b);
        // Two triangles of one object in one place: shared corners and edges.
        check(&m, &a, &m, &[a[0], b[1], b[2]]);
        check(&m, &a, &m, &[a[1], a[0], b[2]]);
    }

    #[test]
    fn nor_for_coplanar_triangles((a, b) in coplanar(), m in pose()) {
        check(&m, &a, &m, &b);
        check(&Pose::identity(), &a, &m, &b);
    }

    #[test]
    fn exact_answers_do_not_depend_on_the_side(a in corners(), b in corners(), m in pose(), n in pose()) {
        let (ab, ba) = (ExactPair::new(&m, &a, &n, &b), ExactPair::new(&n, &b, &m, &a));
        prop_assert_eq!(ab.hit(), ba.hit());
        prop_assert_eq!(ab.distance(), ba.distance());
    }
}

#[test]
fn distances_without_a_root_are_exact() {
    let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
    for height in [0.75, 3.0, 1e-300, 5e-324, 2f64.powi(600)] {
        let b = a.map(|p| p + Vector3::new(0.0, 0.0, height));
        let exact = ExactPair::new(&Pose::identity(), &a, &Pose::identity(), &b);
        let (lo, hi) = exact.distance();
        assert!(lo <= height && height <= hi && (lo == hi || height < 1e-290), "{height:e}: [{lo:e}, {hi:e}]");
    }
    // The diagonal of a unit square.
    let b = a.map(|p| p + Vector3::new(2.0, 1.0, 0.0));
    let (lo, hi) = ExactPair::new(&Pose::identity(), &a, &Pose::identity(), &b).distance();
    assert_eq!((lo, hi), (std::f64::consts::SQRT_2.next_down(), std::f64::consts::SQRT_2)); // the constant is rounded up
}
