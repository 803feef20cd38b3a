//! The oracle against pairs whose exact answers are known.

use crate::common::families::Triangle;
use crate::common::{number, placed, shared, triangles};
use nalgebra::{Matrix3, Vector3};
use ocb_core::configuration::{Class, Configuration, Truth};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

struct Case {
    name: String,
    a: Vec<Triangle>,
    b: Vec<Triangle>,
    hit: bool,
    distance: f64,
    margin: f64,
    size: f64,
}

fn cases() -> Vec<Case> {
    let text = String::from_utf8(shared("stability/pairs.txt")).expect("text");
    let parse = |line: &str| {
        let (left, right) = line.split_once('|').expect("the truth after a bar");
        let words: Vec<&str> = left.split_whitespace().collect();
        let count: usize = words[2].parse().expect("a count");
        let numbers: Vec<f64> = words[4..].iter().map(|w| number(w)).collect();
        let truth: Vec<f64> = right.split_whitespace().map(number).collect();
        Case {
            name: format!("{} ({})", words[0], words[1]),
            a: triangles(&numbers[..9 * count]),
            b: triangles(&numbers[9 * count..]),
            hit: truth[0] == 1.0,
            distance: truth[1],
            margin: truth[2],
            size: truth[3],
        }
    };
    text.lines().map(parse).collect()
}

fn truth(a: &[Triangle], b: &[Triangle]) -> Truth {
    let (a, b) = (Shape::from_triangles(a), Shape::from_triangles(b));
    Pair::new(&a, &b).tightest_truth(&placed(Pose::identity()))
}

/// Within one unit in the last place.
fn agrees(distance: f64, expected: f64) -> bool {
    distance == expected || distance == expected.next_up() || distance == expected.next_down()
}

#[test]
fn every_pair_is_answered_exactly() {
    let cases = cases();
    assert_eq!(cases.len(), 1092);
    for case in cases {
        let t = truth(&case.a, &case.b);
        assert_eq!(t.hit, case.hit, "{}", case.name);
        for d in [t.distance_lo, t.distance_hi] {
            assert!(agrees(d, case.distance), "{}: {d:e} instead of {:e}", case.name, case.distance);
        }
        // The listed margins were computed in f64 by the same closed form.
        let error = (t.margin - case.margin).abs();
        assert!(error <= 1e-9 * case.size, "{}: margin {:e}, listed {:e}", case.name, t.margin, case.margin);
    }
}

#[test]
fn the_usual_interval_holds_the_exact_distance() {
    for case in cases() {
        let (a, b) = (Shape::from_triangles(&case.a), Shape::from_triangles(&case.b));
        let pair = Pair::new(&a, &b);
        let still = placed(Pose::identity());
        let t = pair.truth(&still);
        assert_eq!(t.hit, case.hit, "{}", case.name);
        assert_eq!(pair.hit(&still), case.hit, "{}", case.name);
        assert_eq!(!pair.contacts(&still).is_empty(), case.hit, "{}", case.name);
        // The listed distance is itself rounded.
        let (lo, hi) = (t.distance_lo.next_down(), t.distance_hi.next_up());
        assert!(lo <= case.distance && case.distance <= hi, "{}: {t:?} without {:e}", case.name, case.distance);
        let width = t.distance_hi - t.distance_lo;
        assert!(width <= pair.tau(&still, ocb_core::oracle::U64) * 40.0, "{}: width {width:e}", case.name);
    }
}

#[test]
fn order_of_vertices_triangles_and_operands_changes_nothing() {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    for case in cases() {
        let turned = |t: &[Triangle], order: [usize; 3]| -> Vec<Triangle> {
            t.iter().rev().map(|t| order.map(|k| t[k])).collect()
        };
        for order_a in ORDERS {
            for order_b in ORDERS {
                let (a, b) = (turned(&case.a, order_a), turned(&case.b, order_b));
                for t in [truth(&a, &b), truth(&b, &a)] {
                    assert_eq!(t.hit, case.hit, "{} {order_a:?} {order_b:?}", case.name);
                    assert!(agrees(t.distance_lo, case.distance), "{}: {:e}", case.name, t.distance_lo);
                    assert!((t.margin - case.margin).abs() <= 1e-9 * case.size, "{}: {:e}", case.name, t.margin);
                }
            }
        }
    }
}

#[test]
fn scaling_by_powers_of_two_scales_the_answer_bit_for_bit() {
    for case in cases() {
        for scale in [2f64.powi(-40), 2f64.powi(-15), 2.0, 2f64.powi(20), 2f64.powi(40)] {
            let scaled = |t: &[Triangle]| -> Vec<Triangle> { t.iter().map(|t| t.map(|p| p * scale)).collect() };
            let (t, s) = (truth(&case.a, &case.b), truth(&scaled(&case.a), &scaled(&case.b)));
            let expected = Truth {
                distance_lo: t.distance_lo * scale,
                distance_hi: t.distance_hi * scale,
                margin: t.margin * scale,
                witness: ocb_core::configuration::Witness {
                    point_a: t.witness.point_a * scale,
                    point_b: t.witness.point_b * scale,
                    ..t.witness
                },
                ..t
            };
            assert_eq!(s, expected, "{} times {scale:e}", case.name);
        }
    }
}

#[test]
fn transformed_pairs_are_answered_exactly() {
    let text = String::from_utf8(shared("stability/transformed_pairs.txt")).expect("text");
    let mut count = 0;
    for line in text.lines() {
        let n: Vec<f64> = line.split_whitespace().map(number).collect();
        let (a, b) = (Shape::from_triangles(&triangles(&n[..9])), Shape::from_triangles(&triangles(&n[9..18])));
        let pose =
            Pose { linear: Matrix3::from_row_slice(&n[18..27]), translation: Vector3::from_row_slice(&n[27..30]) };
        let pair = Pair::new(&a, &b);
        let t = pair.tightest_truth(&placed(pose));
        assert_eq!(t.hit, n[30] == 1.0, "line {count}");
        assert!(agrees(t.distance_lo, n[31]), "line {count}: {:e} instead of {:e}", t.distance_lo, n[31]);
        // A stands where B stood, seen from the other side: the same scene.
        let swapped = Configuration { pose_a: pose, pose_b: Pose::identity() };
        let s = Pair::new(&b, &a).tightest_truth(&swapped);
        assert_eq!((s.hit, s.distance_lo, s.distance_hi), (t.hit, t.distance_lo, t.distance_hi), "line {count}");
        count += 1;
    }
    assert_eq!(count, 600);
}

#[test]
fn grazing_pairs_are_not_scored() {
    for case in cases().iter().filter(|c| c.hit && c.margin == 0.0) {
        let t = truth(&case.a, &case.b);
        assert_eq!((t.class64, t.class32), (Class::Grazing, Class::Grazing), "{}", case.name);
    }
}
