//! Small meshes of every stock object against trying all pairs of triangles in integers.

use nalgebra::{Matrix3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

use crate::common::families::Triangle;
use crate::common::random::Random;
use crate::common::reference::{Grid, Squared};

/// About 120 triangles spread over a stock object.
pub fn sparse(object: &str) -> Shape {
    let mesh = ocb_core::stock::generate(object, 1200).expect("a stock object");
    let corners = mesh.triangles().iter().step_by(10).map(|t| t.map(|v| mesh.positions()[v as usize]));
    Shape::from_triangles(&corners.collect::<Vec<_>>())
}

/// The corners of all triangles.
pub fn soup(shape: &Shape) -> Vec<Triangle> {
    shape.triangles().iter().map(|t| t.map(|v| shape.positions()[v as usize])).collect()
}

/// The shape in another unit of length.
pub fn scaled(shape: &Shape, factor: f64) -> Shape {
    Shape::from_triangles(&soup(shape).iter().map(|t| t.map(|p| p * factor)).collect::<Vec<_>>())
}

/// Boxes around the mapped triangles, in f64.
fn boxes(shape: &Shape, pose: &Pose) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let corners = |t: &[u32; 3]| t.map(|v| pose.apply(&shape.positions()[v as usize]).coords);
    let around = |[p, q, r]: [Vector3<f64>; 3]| (p.inf(&q).inf(&r), p.sup(&q).sup(&r));
    shape.triangles().iter().map(|t| around(corners(t))).collect()
}

/// All meeting pairs, and the smallest squared distance.
pub fn all_pairs(a: &Shape, b: &Shape, c: &Configuration) -> (Vec<[u32; 2]>, Squared) {
    let grid = Grid::new([(&c.pose_a, a.positions()), (&c.pose_b, b.positions())]);
    let (boxes_a, boxes_b) = (boxes(a, &c.pose_a), boxes(b, &c.pose_b));
    let size = Pair::new(a, b).scene_size(c);
    let mut pairs = Vec::new();
    for (i, (lo_a, hi_a)) in boxes_a.iter().enumerate() {
        for (j, (lo_b, hi_b)) in boxes_b.iter().enumerate() {
            let gap = (lo_b - hi_a).sup(&(lo_a - hi_b)).max().max(0.0);
            // Boxes surely this far apart, with a thousand times more than the rounding.
            pairs.push((gap - 1e-12 * size, [i as u32, j as u32]));
        }
    }
    pairs.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut contacts = Vec::new();
    let mut best: Option<Squared> = None;
    for (gap, pair) in pairs {
        if gap > 0.0 && best.as_ref().is_some_and(|b| b.square_against(gap).is_gt()) {
            break;
        }
        let corners = |s: &Shape, t: u32| s.triangles()[t as usize].map(|v| v as usize);
        let d = grid.squared_distance(corners(a, pair[0]), corners(b, pair[1]));
        if d.is_zero() {
            contacts.push(pair);
        }
        if best.as_ref().is_none_or(|b| d.less_than(b)) {
            best = Some(d);
        }
    }
    contacts.sort_unstable();
    (contacts, best.expect("there are triangles"))
}

/// Everything the oracle says about two meshes; true when they meet.
pub fn check(a: &Shape, b: &Shape, c: &Configuration, what: &str) -> bool {
    let pair = Pair::new(a, b);
    let (contacts, distance) = all_pairs(a, b, c);
    assert_eq!(pair.contacts(c), contacts, "{what} {c:?}");
    let listed: Vec<[u32; 2]> = pair.contact_margins(c).iter().map(|c| c.pair).collect();
    assert_eq!(listed, contacts, "{what} {c:?}");
    assert_eq!(pair.hit(c), !contacts.is_empty(), "{what} {c:?}");
    for t in [pair.truth(c), pair.tightest_truth(c)] {
        assert_eq!(t.hit, !contacts.is_empty(), "{what} {c:?}");
        let interval = (t.distance_lo, t.distance_hi);
        assert!(distance.root_is_in(interval), "{what} {c:?}: {t:?}");
        assert_eq!(interval == (0.0, 0.0), t.hit, "{what} {c:?}: {t:?}");
        let witness = [t.witness.triangle_a, t.witness.triangle_b];
        assert!(!t.hit || contacts.contains(&witness), "{what} {c:?}: {t:?}");
        let (lo, hi) = pair.triangle_distance(c, witness);
        assert!(lo <= t.distance_hi && t.distance_lo <= hi, "{what} {c:?}: {t:?}, witnesses at [{lo}, {hi}]");
    }
    let t = pair.tightest_truth(c);
    assert!(t.distance_hi <= t.distance_lo.next_up(), "{what} {c:?}: {t:?}");
    t.hit
}

/// From a configuration apart: B moved along the shortest way until `gap` is left, up to rounding.
pub fn closed_in(a: &Shape, b: &Shape, apart: &Configuration, gap: f64) -> Configuration {
    let t = Pair::new(a, b).truth(apart);
    assert!(!t.hit, "{t:?}");
    let way = t.witness.point_a - t.witness.point_b;
    let mut c = *apart;
    c.pose_b.translation += way * ((t.distance_hi - gap) / t.distance_hi);
    c
}

/// B further and further from A, until they are apart.
pub fn taken_apart(a: &Shape, b: &Shape, mut c: Configuration) -> Configuration {
    for _ in 0..100 {
        if !Pair::new(a, b).hit(&c) {
            return c;
        }
        c.pose_b.translation *= 1.25;
    }
    panic!("they meet at any distance: {c:?}");
}

#[test]
fn the_hierarchy_loses_nothing() {
    let mut random = Random(1);
    let mut seen = [0, 0];
    for object in ocb_core::stock::list() {
        let (shape, object) = (sparse(object.name), object.name);
        // Onto itself: coplanar, common corners, common edges, the same triangles.
        let pose = random.pose(1.0);
        assert!(check(&shape, &shape, &Configuration { pose_a: pose, pose_b: pose }, object));
        for _ in 0..3 {
            let c = Configuration { pose_a: random.pose(0.2), pose_b: random.pose(0.6) };
            seen[usize::from(check(&shape, &shape, &c, object))] += 1;
            let apart = taken_apart(&shape, &shape, c);
            // Touching up to rounding, hardly apart, hardly and clearly through.
            for gap in [0.0, 1e-16, 1e-12, 1e-8, 1e-5, -1e-16, -1e-12, -1e-8, -1e-3] {
                let c = closed_in(&shape, &shape, &apart, gap);
                seen[usize::from(check(&shape, &shape, &c, object))] += 1;
            }
        }
    }
    assert!(seen.iter().all(|n| *n > 50), "{seen:?} apart and together");
}

#[test]
fn any_affine_map_is_taken_at_its_word() {
    let mut random = Random(2);
    for object in ["sphere", "torus-knot", "castle"] {
        let shape = sparse(object);
        // Shear, scale and mirror; from rounding to gross, either side of where hierarchies are built anew.
        for amount in [1e-15, 1e-10, 1e-7, 9e-7, 1.1e-6, 1e-5, 1e-2, 1.0, 3.0] {
            let mut c = Configuration { pose_a: random.pose(0.3), pose_b: random.pose(1.0) };
            c.pose_a.linear += Matrix3::from_fn(|_, _| amount * random.signed());
            c.pose_b.linear += Matrix3::from_fn(|_, _| amount * random.signed());
            check(&shape, &shape, &c, object);
            let apart = taken_apart(&shape, &shape, c);
            for gap in [0.0, 1e-9, -1e-9, -1e-3] {
                check(&shape, &shape, &closed_in(&shape, &shape, &apart, gap), object);
            }
        }
    }
    // One that flattens everything.
    let shape = sparse("sphere");
    let mut flat = Pose::identity();
    flat.linear[(2, 2)] = 0.0;
    for pose_b in [Pose::identity(), random.pose(0.5), flat] {
        check(&shape, &shape, &Configuration { pose_a: flat, pose_b }, "flat sphere");
    }
}

#[test]
fn objects_of_different_size_and_far_away() {
    let mut random = Random(4);
    let large = sparse("torus-knot");
    for exponent in [-30, -10, 10] {
        let small = scaled(&sparse("castle"), 2f64.powi(exponent));
        for far in [0.0, 1e3, 1e7] {
            let mut c = Configuration { pose_a: random.pose(0.0), pose_b: random.pose(0.0) };
            let away = random.vector() * far;
            c.pose_a.translation += away;
            // A corner of one where a corner of the other is.
            let corner = c.pose_a.apply(&large.positions()[random.below(300)]);
            let own = c.pose_b.apply(&small.positions()[random.below(300)]);
            c.pose_b.translation += corner - own;
            check(&large, &small, &c, "large and small");
            let back = Configuration { pose_a: c.pose_b, pose_b: c.pose_a };
            check(&small, &large, &back, "small and large");
            c.pose_b.translation += random.vector() * (1.0 + 2f64.powi(exponent));
            check(&large, &small, &c, "large and small");
        }
    }
}
