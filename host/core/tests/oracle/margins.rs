//! The margin is a promise: while every vertex moves by less, the crossing holds. Here they move by 0.99 of it.

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::{Class, Configuration};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;

use crate::brute_force::{soup, sparse};
use crate::common::families::{Case, Triangle};
use crate::common::placed;
use crate::common::random::Random;
use crate::meshes::cube;

/// Random directions, in all.
const DIRECTIONS: usize = 10_000;

/// Do two triangles of the world meet?
fn meets(a: Triangle, b: Triangle) -> bool {
    let (a, b) = (Shape::from_triangles(&[a]), Shape::from_triangles(&[b]));
    Pair::new(&a, &b).hit(&placed(Pose::identity()))
}

/// A crossing in the world, with its margin.
struct Crossing {
    a: Triangle,
    b: Triangle,
    margin: f64,
}

/// So many crossings whose margin is far more than the rounding of the vertices; one pair in fifty, at least, is one.
fn crossings(from: u64, count: usize) -> Vec<Crossing> {
    let found: Vec<Crossing> = (from..from + 50 * count as u64)
        .map(Case::draw)
        .filter_map(|case| {
            let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
            let (pair, c) = (Pair::new(&a, &b), &case.configuration);
            let margin = pair.truth(c).margin;
            let world = |pose: &Pose, t: Triangle| t.map(|p| pose.apply(&p));
            let [a, b] = [world(&c.pose_a, case.a), world(&c.pose_b, case.b)];
            (margin > 1e-12 * pair.scene_size(c)).then_some(Crossing { a, b, margin })
        })
        .take(count)
        .collect();
    assert_eq!(found.len(), count, "hardly any pair crosses");
    found
}

#[test]
fn it_survives_moves_in_all_directions() {
    let mut random = Random(3);
    for Crossing { a, b, margin } in crossings(0x3a_0000, DIRECTIONS / 20) {
        for _ in 0..20 {
            let mut moved = |p: Point3<f64>| p + random.direction() * (0.99 * margin);
            assert!(meets(a.map(&mut moved), b.map(&mut moved)), "{a:?} {b:?} {margin:e}");
        }
    }
}

/// The directions along which tetrahedra of the corners are thin.
fn thin_directions(a: &Triangle, b: &Triangle) -> Vec<Vector3<f64>> {
    let edges = |t: &Triangle| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let (of_a, of_b) = (edges(a), edges(b));
    let between = of_a.iter().flat_map(|u| of_b.iter().map(move |v| u.cross(v)));
    let normals = [of_a[0].cross(&of_a[1]), of_b[0].cross(&of_b[1])];
    between.chain(normals).filter_map(|n| n.try_normalize(0.0)).collect()
}

#[test]
fn it_survives_the_worst_moves() {
    for Crossing { a, b, margin } in crossings(0x3b_0000, 400) {
        for direction in thin_directions(&a, &b) {
            // Each corner one way or the other: all patterns.
            for pattern in 0..64u32 {
                let to = |corner: u32| {
                    let sign = if pattern & (1 << corner) == 0 { 0.99 } else { -0.99 };
                    direction * (sign * margin)
                };
                let moved_a = std::array::from_fn(|i| a[i] + to(i as u32));
                let moved_b = std::array::from_fn(|i| b[i] + to(3 + i as u32));
                assert!(meets(moved_a, moved_b), "{a:?} {b:?} {margin:e} {direction} {pattern:b}");
            }
        }
    }
}

#[test]
fn it_is_not_far_below_the_truth() {
    // Half the smallest of five widths; for a pair of triangles that is found by hand.
    let floor = [[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 3.0, 0.0]].map(Point3::from);
    for depth in [1e-12, 1e-9, 1e-6, 1e-3, 0.25] {
        let spike = [[0.0, 0.0, -depth], [0.25, 0.0, 8.0], [-0.25, 0.0, 8.0]].map(Point3::from);
        let (a, b) = (Shape::from_triangles(&[floor]), Shape::from_triangles(&[spike]));
        let t = Pair::new(&a, &b).truth(&placed(Pose::identity()));
        // The tip may rise by half of its depth while the floor sinks by as much.
        assert!(t.margin <= depth / 2.0 && t.margin >= 0.999 * depth / 2.0, "{depth}: {t:?}");
        let grazing = if depth > 1e-4 { Class::Colliding } else { t.class32 };
        assert_eq!((t.class64, t.class32), (Class::Colliding, grazing));
    }
}

#[test]
fn it_survives_on_meshes() {
    let mut random = Random(7);
    for object in ["torus-knot", "castle", "sponge"] {
        let shape = sparse(object);
        let (pair, triangles) = (Pair::new(&shape, &shape), soup(&shape));
        let drawn = (0..400).map(|_| Configuration { pose_a: random.pose(0.1), pose_b: random.pose(0.4) });
        let crossing: Vec<_> = drawn.map(|c| (c, pair.truth(&c))).filter(|(_, t)| t.margin >= 1e-9).take(20).collect();
        assert_eq!(crossing.len(), 20, "{object}: hardly any pose crosses");
        for (c, t) in crossing {
            let best = pair.contact_margins(&c).iter().map(|c| c.margin).fold(0.0, f64::max);
            assert_eq!(best, t.margin, "these meshes are open, so pairs of triangles give the margin");
            for _ in 0..10 {
                let mut moved = |pose: &Pose| -> Vec<Triangle> {
                    let shaken = |p: Point3<f64>, r: &mut Random| pose.apply(&p) + r.direction() * (0.99 * t.margin);
                    triangles.iter().map(|t| t.map(|p| shaken(p, &mut random))).collect()
                };
                let (a, b) = (Shape::from_triangles(&moved(&c.pose_a)), Shape::from_triangles(&moved(&c.pose_b)));
                assert!(Pair::new(&a, &b).hit(&placed(Pose::identity())), "{object} {c:?}");
            }
        }
    }
}

/// A mesh with each vertex moved; triangles stay connected.
fn shaken(shape: &Shape, mut to: impl FnMut(usize) -> Vector3<f64>) -> Shape {
    let positions: Vec<Point3<f64>> = shape.positions().iter().enumerate().map(|(i, p)| p + to(i)).collect();
    Shape::from_triangles(&shape.triangles().iter().map(|t| t.map(|v| positions[v as usize])).collect::<Vec<_>>())
}

#[test]
fn that_of_closed_meshes_survives_as_well() {
    // Every crossing runs through an edge between coplanar triangles: only inside and outside give a margin.
    let mut random = Random(8);
    let (large, small) = (cube(10.0, 0.0), cube(5.0, 14.0));
    let still = placed(Pose::identity());
    for (a, b) in [(&large, &small), (&small, &large)] {
        let margin = Pair::new(a, b).truth(&still).margin;
        assert!(margin > 0.4);
        for round in 0..1_000 {
            // First all corners of one against all of the other, along the axes and diagonals; then each as it likes.
            let common = Vector3::from_fn(|i, _| [-1.0, 0.0, 1.0][round / 3usize.pow(i as u32) % 3]);
            let mut way = |sign: f64| {
                let v =
                    if round > 0 && round < 27 && common != Vector3::zeros() { common * sign } else { random.vector() };
                v.normalize() * (0.99 * margin)
            };
            let a = shaken(a, |_| way(1.0));
            let b = shaken(b, |_| way(-1.0));
            assert!(Pair::new(&a, &b).hit(&still), "{round}");
        }
    }
    // Apart, or one inside the other: no margin.
    for (half, centre) in [(2.0, 0.0), (5.0, 16.0), (0.5, 10.25)] {
        let other = cube(half, centre);
        let t = Pair::new(&large, &other).truth(&still);
        assert_eq!(t.margin > 0.0, centre == 10.25, "{t:?}");
        assert!(t.margin <= 0.125, "the corner stands 0.25 deep: {t:?}");
    }
}
