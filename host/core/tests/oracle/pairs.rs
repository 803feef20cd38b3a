//! Single pairs of triangles of all troublesome kinds against integers.

use std::collections::BTreeMap;

use ocb_core::configuration::{Class, Configuration};
use ocb_core::oracle::{Pair, Shape, U32, U64};

use crate::common::families::{Case, Triangle};
use crate::common::reference::{Grid, Squared};

/// How many; a tenth of a millisecond each.
const PAIRS: u64 = 20_000;

pub fn exact(a: &Triangle, b: &Triangle, c: &Configuration) -> Squared {
    Grid::new([(&c.pose_a, a), (&c.pose_b, b)]).squared_distance([0, 1, 2], [0, 1, 2])
}

/// Everything that is said about a pair.
pub fn check(case: &Case) -> bool {
    let exact = exact(&case.a, &case.b, &case.configuration);
    let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
    let (pair, c) = (Pair::new(&a, &b), &case.configuration);
    let hit = exact.is_zero();
    assert_eq!(pair.hit(c), hit, "{case:?}");
    assert_eq!(pair.contacts(c), if hit { vec![[0, 0]] } else { vec![] }, "{case:?}");
    let (usual, tightest) = (pair.truth(c), pair.tightest_truth(c));
    let of_triangles = pair.triangle_distance(c, [0, 0]);
    for (lo, hi) in [(usual.distance_lo, usual.distance_hi), (tightest.distance_lo, tightest.distance_hi), of_triangles]
    {
        assert!(exact.root_is_in((lo, hi)), "{case:?}: not in [{lo:e}, {hi:e}]");
        assert_eq!((lo, hi) == (0.0, 0.0), hit, "{case:?}: [{lo:e}, {hi:e}]");
    }
    let neighbours = tightest.distance_hi <= tightest.distance_lo.next_up();
    assert!(neighbours, "{case:?}: [{:e}, {:e}]", tightest.distance_lo, tightest.distance_hi);
    let largest = |t: &Triangle| t.iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
    let shift = c.pose_a.translation.amax().max(c.pose_b.translation.amax());
    let size = largest(&case.a) + largest(&case.b) + shift;
    for t in [&usual, &tightest] {
        assert_eq!(t.hit, hit, "{case:?}");
        assert!(t.margin >= 0.0 && (hit || t.margin == 0.0), "{case:?}: {t:?}");
        for (class, unit_roundoff) in [(t.class64, U64), (t.class32, U32)] {
            let tau = 32.0 * unit_roundoff * size;
            assert_eq!(pair.tau(c, unit_roundoff), tau);
            let clear = !hit && exact.square_against(tau).is_lt();
            match class {
                Class::Clear => assert!(clear, "{case:?}: {t:?}"),
                Class::Colliding => assert!(hit && t.margin > tau, "{case:?}: {t:?}"),
                // An interval that reaches down to tau may hide a distance just above.
                Class::Grazing => assert!(!clear || t.distance_lo <= tau, "{case:?}: {t:?}"),
            }
        }
    }
    // f64 bounds from below the margin that integers give.
    assert!(usual.margin <= tightest.margin, "{case:?}: {:e} > {:e}", usual.margin, tightest.margin);
    let [listed] = pair.contact_margins(c)[..] else {
        assert!(!hit, "{case:?}");
        return hit;
    };
    assert!(hit && listed.margin <= usual.margin, "{case:?}");
    hit
}

#[test]
fn every_kind_of_pair_is_answered_as_integers_say() {
    let mut seen: BTreeMap<[&str; 2], [u32; 2]> = BTreeMap::new();
    for number in 0..PAIRS {
        let case = Case::draw(number);
        let hit = check(&case);
        seen.entry(case.family).or_default()[usize::from(hit)] += 1;
    }
    // The kinds are worth their name only when both answers occur.
    assert_eq!(seen.len(), 77);
    for (family, [apart, together]) in &seen {
        let one_sided = match family {
            [
                "common vertex" | "common edge",
                "still" | "moved together" | "mapped together" | "quarter turns and mirrors",
            ] => *apart == 0,
            _ => false,
        };
        assert!(one_sided || (*apart > 0 && *together > 0), "{family:?}: {apart} apart, {together} together");
    }
}

#[test]
fn swapping_the_objects_changes_nothing() {
    for number in PAIRS..PAIRS + 10_000 {
        let case = Case::draw(number);
        let other = case.clone().swapped();
        let [t, s] = [&case, &other].map(|case| {
            let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
            Pair::new(&a, &b).tightest_truth(&case.configuration)
        });
        assert_eq!((t.hit, t.distance_lo, t.distance_hi), (s.hit, s.distance_lo, s.distance_hi), "{case:?}");
        assert_eq!((t.margin, t.class64, t.class32), (s.margin, s.class64, s.class32), "{case:?}");
    }
}

#[test]
fn the_reference_knows_the_listed_answers() {
    // Known by hand: a corner over a face, two edges, two corners, coplanar, through, and touching in each way.
    let floor = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let cases = [
        ([[1.0, 1.0, 2.0], [1.0, 1.0, 5.0], [2.0, 1.0, 5.0]], (4, 1)),
        ([[2.0, -2.0, 1.0], [2.0, 1.0, 4.0], [2.0, -1.0, 9.0]], (9, 2)),
        ([[-3.0, -4.0, 0.0], [-5.0, -4.0, 0.0], [-3.0, -8.0, 0.0]], (25, 1)),
        ([[3.0, 3.0, 0.0], [5.0, 3.0, 0.0], [3.0, 5.0, 0.0]], (2, 1)),
        ([[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [2.0, 5.0, 0.0]], (0, 1)),
        ([[1.0, 1.0, 0.0], [1.0, 1.0, -1.0], [2.0, 5.0, -3.0]], (0, 1)),
        ([[2.0, 2.0, 0.0], [5.0, 2.0, 1.0], [5.0, 5.0, -3.0]], (0, 1)),
        ([[1.0, 1.0, 0.0], [1.0, 2.0, 0.0], [2.0, 1.0, 0.0]], (0, 1)),
        ([[1.0, 1.0, 3.0], [1.0, 1.0, 3.0], [1.0, 1.0, 3.0]], (9, 1)),
    ];
    let still = crate::common::placed(ocb_core::pose::Pose::identity());
    for (b, (numerator, denominator)) in cases {
        let d = exact(&floor.map(Into::into), &b.map(Into::into), &still);
        assert!(d.is(&numerator.into(), &denominator.into()), "{b:?}: {d:?}");
    }
}

#[test]
fn a_root_that_is_nearly_a_number_is_none() {
    // The distance is the root of 1 + 4^e, which differs from 1 far behind the digits of a double.
    let floor = [[0.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]].map(Into::into);
    let still = crate::common::placed(ocb_core::pose::Pose::identity());
    for e in [-30, -60, -100, -400] {
        let beside = [[1.0, 0.0, 2f64.powi(e)], [2.0, 0.0, 1.0], [2.0, 1.0, 1.0]].map(Into::into);
        let (a, b) = (Shape::from_triangles(&[floor]), Shape::from_triangles(&[beside]));
        let t = Pair::new(&a, &b).tightest_truth(&still);
        assert_eq!((t.distance_lo, t.distance_hi), (1.0, 1f64.next_up()), "{e}");
        assert!(exact(&floor, &beside, &still).root_is_in((t.distance_lo, t.distance_hi)));
    }
}
