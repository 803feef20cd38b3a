//! What must hold between answers, whatever they are.

use ocb_core::configuration::{Configuration, Truth, Witness};
use ocb_core::oracle::{Pair, Shape, Side};
use ocb_core::pose::Pose;
use proptest::prelude::*;

use crate::brute_force::{closed_in, scaled, soup, sparse, taken_apart};
use crate::common::families::Triangle;
use crate::common::random::Random;

/// Apart, nearly or just touching, hardly and clearly through.
fn situations(a: &Shape, b: &Shape, random: &mut Random) -> Vec<Configuration> {
    let first = Configuration { pose_a: random.pose(0.2), pose_b: random.pose(0.6) };
    let apart = taken_apart(a, b, first);
    let gaps = [1e-2, 1e-6, 1e-11, 0.0, -1e-11, -1e-6, -1e-2];
    gaps.iter().map(|gap| closed_in(a, b, &apart, *gap)).chain([first, apart]).collect()
}

fn swapped(c: &Configuration) -> Configuration {
    Configuration { pose_a: c.pose_b, pose_b: c.pose_a }
}

/// What does not depend on the order of anything.
fn essence(t: &Truth) -> (bool, f64, f64) {
    (t.hit, t.distance_lo, t.distance_hi)
}

const OBJECTS: [&str; 4] = ["torus-knot", "castle", "lustre", "sponge"];

#[test]
fn powers_of_two_change_the_unit_and_not_one_bit() {
    let mut random = Random(11);
    for object in OBJECTS {
        let (a, b) = (sparse(object), sparse("sphere"));
        for c in situations(&a, &b, &mut random) {
            let pair = Pair::new(&a, &b);
            for exponent in [-200, -40, -3, 1, 20, 300] {
                let factor = 2f64.powi(exponent);
                let (x, y) = (scaled(&a, factor), scaled(&b, factor));
                let (other, mut d) = (Pair::new(&x, &y), c);
                d.pose_a.translation *= factor;
                d.pose_b.translation *= factor;
                for (t, s) in [(pair.truth(&c), other.truth(&d)), (pair.tightest_truth(&c), other.tightest_truth(&d))] {
                    let witness = Witness {
                        point_a: t.witness.point_a * factor,
                        point_b: t.witness.point_b * factor,
                        ..t.witness
                    };
                    let (lo, hi) = (t.distance_lo * factor, t.distance_hi * factor);
                    let expected = Truth { distance_lo: lo, distance_hi: hi, margin: t.margin * factor, witness, ..t };
                    assert_eq!(s, expected, "{object} times 2^{exponent}, {c:?}");
                }
                assert_eq!(pair.contacts(&c), other.contacts(&d), "{object} times 2^{exponent}, {c:?}");
            }
        }
    }
}

#[test]
fn who_is_a_and_in_which_order_triangles_come_changes_nothing() {
    let mut random = Random(12);
    for object in OBJECTS {
        let (a, b) = (sparse(object), sparse("torus-knot"));
        let triangles = soup(&a);
        // Another order of triangles, and of corners in each.
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        (1..order.len()).rev().for_each(|i| order.swap(i, random.below(i + 1)));
        let turned = |t: &Triangle, r: &mut Random| {
            let (shift, mirrored) = (r.below(3), r.coin());
            std::array::from_fn(|i| t[(if mirrored { 2 - i } else { i } + shift) % 3])
        };
        let shuffled: Vec<Triangle> = order.iter().map(|&i| turned(&triangles[i], &mut random)).collect();
        let shuffled = Shape::from_triangles(&shuffled);
        for c in situations(&a, &b, &mut random) {
            let (pair, back, mixed) = (Pair::new(&a, &b), Pair::new(&b, &a), Pair::new(&shuffled, &b));
            let t = pair.tightest_truth(&c);
            let size = pair.scene_size(&c);
            for other in [back.tightest_truth(&swapped(&c)), mixed.tightest_truth(&c)] {
                assert_eq!(essence(&t), essence(&other), "{object} {c:?}");
                assert!((t.margin - other.margin).abs() <= 1e-12 * size, "{object} {c:?}: {t:?} {other:?}");
            }
            let contacts = pair.contacts(&c);
            let mut reversed: Vec<[u32; 2]> = back.contacts(&swapped(&c)).iter().map(|&[i, j]| [j, i]).collect();
            reversed.sort_unstable();
            assert_eq!(contacts, reversed, "{object} {c:?}");
            let mut renamed: Vec<[u32; 2]> =
                mixed.contacts(&c).iter().map(|&[i, j]| [order[i as usize] as u32, j]).collect();
            renamed.sort_unstable();
            assert_eq!(contacts, renamed, "{object} {c:?}");
        }
    }
}

#[test]
fn a_part_is_no_nearer_and_the_whole_as_near_as_its_nearest_part() {
    let mut random = Random(13);
    for object in OBJECTS {
        let (whole, b) = (sparse(object), sparse("torus-knot"));
        let triangles = soup(&whole);
        for c in situations(&whole, &b, &mut random) {
            let all = Pair::new(&whole, &b).tightest_truth(&c);
            let cut = 1 + random.below(triangles.len() - 1);
            let parts = [&triangles[..cut], &triangles[cut..]].map(Shape::from_triangles);
            let [left, right] = parts.each_ref().map(|p| Pair::new(p, &b).tightest_truth(&c));
            for part in [&left, &right] {
                assert!(part.distance_lo >= all.distance_lo && part.distance_hi >= all.distance_hi, "{object} {c:?}");
                assert!(!part.hit || all.hit, "{object} {c:?}");
            }
            assert_eq!(all.hit, left.hit || right.hit, "{object} {c:?}");
            let nearest = (left.distance_lo.min(right.distance_lo), left.distance_hi.min(right.distance_hi));
            assert_eq!((all.distance_lo, all.distance_hi), nearest, "{object} {c:?}");
        }
    }
}

/// Triangles far smaller than the rounding of the boxes in single precision: only what is paid for rounding keeps the
/// boxes of two that meet from passing each other.
#[test]
fn dust_that_meets_dust_is_found() {
    let mut random = Random(16);
    for size in [1e-5, 1e-7, 1e-9, 1e-11] {
        let mut dust = || -> Vec<Triangle> {
            let mut grain = |at: nalgebra::Point3<f64>| [0; 3].map(|_| at + random.vector() * size);
            let mut places = Random(17);
            (0..300).map(|_| grain(places.point())).collect()
        };
        let (grains_a, grains_b) = (dust(), dust());
        let (a, b) = (Shape::from_triangles(&grains_a), Shape::from_triangles(&grains_b));
        let pair = Pair::new(&a, &b);
        let mut met = 0;
        for _ in 0..200 {
            let (i, j) = (random.below(300), random.below(300));
            let mut c = Configuration { pose_a: random.pose(0.5), pose_b: random.pose(0.5) };
            let middle = |pose: &Pose, [p, q, r]: Triangle| pose.apply(&((p + q.coords + r.coords) / 3.0));
            c.pose_b.translation += middle(&c.pose_a, grains_a[i]) - middle(&c.pose_b, grains_b[j]);
            let [single_a, single_b] = [grains_a[i], grains_b[j]].map(|t| Shape::from_triangles(&[t]));
            let single = Pair::new(&single_a, &single_b).tightest_truth(&c);
            let t = pair.tightest_truth(&c);
            assert!(t.distance_lo <= single.distance_lo && t.distance_hi <= single.distance_hi, "{size} {c:?}: {t:?}");
            if single.hit {
                met += 1;
                assert!(pair.hit(&c) && pair.truth(&c).hit && t.hit, "{size} {c:?}");
                assert!(pair.contacts(&c).contains(&[i as u32, j as u32]), "{size} {c:?}");
            }
        }
        assert!(met > 50, "{size}: {met} of 200 meet");
    }
}

#[test]
fn what_is_there_already_adds_nothing() {
    let mut random = Random(14);
    for object in OBJECTS {
        let (a, b) = (sparse(object), sparse("torus-knot"));
        let mut triangles = soup(&a);
        for i in 0..triangles.len() {
            let [p, q, r] = triangles[i];
            match i % 4 {
                0 => triangles.push([p, q, r]),
                1 => triangles.push([q, q, r]),
                2 => triangles.push([r, r, r]),
                _ => triangles.push([q, p, r]),
            }
        }
        let more = Shape::from_triangles(&triangles);
        for c in situations(&a, &b, &mut random) {
            let (t, s) = (Pair::new(&a, &b).tightest_truth(&c), Pair::new(&more, &b).tightest_truth(&c));
            assert_eq!(essence(&t), essence(&s), "{object} {c:?}");
        }
    }
}

#[test]
fn witnesses_stand_where_they_say() {
    let mut random = Random(15);
    for object in OBJECTS {
        let (a, b) = (sparse(object), sparse("torus-knot"));
        let pair = Pair::new(&a, &b);
        for c in situations(&a, &b, &mut random) {
            let (t, rounding) = (pair.truth(&c), 1e-14 * pair.scene_size(&c));
            let Witness { point_a, point_b, triangle_a, triangle_b } = t.witness;
            assert!(pair.off_triangle(&c, Side::A, triangle_a, &point_a) <= rounding, "{object} {c:?}: {t:?}");
            assert!(pair.off_triangle(&c, Side::B, triangle_b, &point_b) <= rounding, "{object} {c:?}: {t:?}");
            let between = (point_b - point_a).norm();
            let far = between - t.distance_hi;
            assert!(far.abs() <= rounding, "{object} {c:?}: {between:e} between the witnesses of {t:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Moving B by v changes the distance by at most |v|; in the direction away from A it grows by as much.
    #[test]
    fn the_distance_follows_the_motion(seed in any::<u64>(), length in 1e-9f64..1.0) {
        let random = &mut Random(seed);
        let shape = sparse("torus-knot");
        let pair = Pair::new(&shape, &shape);
        let c = taken_apart(&shape, &shape, Configuration { pose_a: random.pose(0.2), pose_b: random.pose(0.8) });
        let slack = 1e-14 * pair.scene_size(&c);
        let moved = |v: nalgebra::Vector3<f64>| {
            let pose_b = Pose { translation: c.pose_b.translation + v, ..c.pose_b };
            pair.truth(&Configuration { pose_b, ..c })
        };
        let t = pair.truth(&c);
        let s = moved(random.direction() * length);
        prop_assert!(s.distance_lo <= t.distance_hi + length + slack && s.distance_hi >= t.distance_lo - length - slack);
        let toward = (t.witness.point_a - t.witness.point_b).normalize();
        let near = moved(toward * length.min(0.9 * t.distance_lo));
        let expected = t.distance_lo - length.min(0.9 * t.distance_lo);
        prop_assert!(near.distance_hi <= t.distance_hi - t.distance_lo + expected + slack && near.distance_hi >= expected - slack);
    }
}
