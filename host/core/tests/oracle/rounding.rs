//! Mapped vertices of which every rounding goes the same way and nearly as far as it can, so that the error that the
//! oracle allows for them is really made: an interval built on half of it would miss the distance.

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

use crate::common::families::Case;
use crate::common::random::Random;
use crate::pairs::{check, exact};

/// Half the last digit of numbers just above 1: an addend below it disappears.
const HALF: f64 = f64::EPSILON / 2.0;

/// Nearly all of it.
fn nearly(r: &mut Random) -> f64 {
    1.0 - 0.05 * r.unit()
}

/// A point of B whose mapped coordinates just above 1 (or just below -1) are each short of nearly four halves: one is lost
/// in the product with x, and one with each of the three addends.
struct Lossy {
    point: Point3<f64>,
    pose: Pose,
    /// What arithmetic in f64 makes of it.
    rounded: Vector3<f64>,
    /// The side of the coordinates on which the exact ones are.
    side: Vector3<f64>,
}

impl Lossy {
    fn draw(r: &mut Random) -> Self {
        let last = f64::EPSILON;
        // (1 + k last) (1 + m last) is k m last^2 more than the sum of its first terms; half a digit is k m = 2^51.
        let k = ((1.0 + r.unit()) * 2f64.powi(25)).floor();
        let m = Vector3::from_fn(|_, _| (nearly(r) * 2f64.powi(51) / k).floor());
        let side = Vector3::from_fn(|_, _| if r.coin() { 1.0 } else { -1.0 });
        let linear = Matrix3::from_fn(|i, j| side[i] * if j == 0 { 1.0 + m[i] * last } else { nearly(r) });
        let translation = side.map(|s| s * nearly(r) * HALF);
        let point = Point3::new(1.0 + k * last, HALF, HALF);
        let rounded = Vector3::from_fn(|i, _| side[i] * (1.0 + (k + m[i]) * last));
        Self { point, pose: Pose { linear, translation }, rounded, side }
    }
}

/// A: a face across the direction of the errors, or a point, `gap` from where f64 sees the lossy point. B: that point, and
/// its other two corners about `length` further in the direction of the errors.
fn draw(r: &mut Random, gap: f64, length: f64) -> Case {
    let Lossy { point, pose, rounded, side } = Lossy::draw(r);
    let middle = Point3::from(rounded + side * gap);
    let size = if r.coin() { 0.0 } else { 10f64.powi(-r.integer(0, 6)) };
    let (u, v) = (Vector3::new(side.x, -side.y, 0.0) * size, Vector3::new(0.0, side.y, -side.z) * size);
    let further = |y: f64, z: f64| point + Vector3::new(length, y * length, z * length);
    let mut case = Case {
        family: ["every rounding the same way", "B mapped"],
        a: [middle + u, middle + v, middle - u - v],
        b: [point, further(0.125, 0.0), further(0.0, 0.125)],
        configuration: Configuration { pose_a: Pose::identity(), pose_b: pose },
    };
    case.scale(2f64.powi(r.integer(-40, 40)));
    if r.coin() { case.swapped() } else { case }
}

#[test]
fn errors_as_large_as_allowed_for_change_no_answer() {
    // Which way the exact distance lies from the middle of the interval, by more than half of the way to its end.
    let mut far_off = [0, 0];
    for number in 0..3_000 {
        let r = &mut Random::of(0x0a_55, number);
        let away = if r.coin() { 1.0 } else { -1.0 };
        let gap = away * 10f64.powf(-3.0 - 9.0 * r.unit());
        let case = draw(r, gap, 0.0);
        assert!(!check(&case), "{case:?}");
        let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
        let t = Pair::new(&a, &b).truth(&case.configuration);
        let quarter = (t.distance_hi - t.distance_lo) / 4.0;
        let inner = (t.distance_lo + quarter, t.distance_hi - quarter);
        far_off[usize::from(away > 0.0)] +=
            u32::from(!t.exact_used && !exact(&case.a, &case.b, &case.configuration).root_is_in(inner));
    }
    // So no test with a bound of half the error would pass.
    assert!(far_off.iter().all(|n| *n > 100), "{far_off:?} of 3000");
}

#[test]
fn nor_where_they_decide_whether_the_triangles_meet() {
    let mut seen = [0, 0];
    for number in 0..3_000 {
        let r = &mut Random::of(0x0a_56, number);
        // The exact point is nearly two last digits further than the rounded one.
        let (gap, length) = (f64::from(r.integer(-1, 4)) * f64::EPSILON, if r.coin() { 0.5 } else { -0.5 });
        seen[usize::from(check(&draw(r, gap, length)))] += 1;
    }
    assert!(seen.iter().all(|n| *n > 300), "{seen:?} apart and together");
}
