//! `distance` on pairs that are built around their answer: A on one side of a slab, B on the other, both touching it.

use ocb_triangles::vector::{Vector, add, add_scaled, cross, dot, sub};
use ocb_triangles::{Triangle, distance, distance_below, meet, segments};
use proptest::prelude::*;

/// Unit roundoff times the size of the pair's coordinates, times this many, is what a distance may be off. The project
/// judges plugins with 32.
const ROUNDINGS: f64 = 8.0;

fn unit(v: Vector) -> Vector {
    v.map(|x| x / dot(v, v).sqrt())
}

/// Any triangle whose lowest feature in direction z is what `touching` says (1: a corner, 2: an edge, 3: the face), with
/// the origin inside that feature. `thin` makes slivers.
fn resting(touching: usize, shape: [f64; 6], thin: f64) -> Triangle {
    let [x, y, u, v, w, h] = shape;
    let foot = match touching {
        1 => return [[0.0; 3], [x, y * thin, 0.1 + h], [u, v * thin, 0.1 + w.abs()]],
        2 => return [[-0.1 - h, 0.0, 0.0], [0.1 + w.abs(), 0.0, 0.0], [x, y * thin, (0.1 + h) * thin]],
        _ => [[-0.1 - h, -thin * (0.1 + w.abs()), 0.0], [0.1 + x.abs(), -thin * 0.2, 0.0], [u * 0.1, thin, 0.0]],
    };
    // Shift so that the centroid rests over the origin.
    let centre = add(add(foot[0], foot[1]), foot[2]).map(|x| x / 3.0);
    foot.map(|p| sub(p, centre))
}

fn place(t: Triangle, [x, y, z]: [Vector; 3], origin: Vector) -> Triangle {
    t.map(|p| add_scaled(add_scaled(add_scaled(origin, p[0], x), p[1], y), p[2], z))
}

/// Three orthonormal directions, also where the two given ones are almost the same: then one step is not orthogonal enough.
fn axes(seed: Vector, other: Vector) -> [Vector; 3] {
    let z = unit(seed);
    let x = unit(cross(z, add(other, [0.011, 0.027, 0.039])));
    let x = unit(add_scaled(x, -dot(x, z), z));
    [x, cross(z, x), z]
}

fn size(t: &[Triangle]) -> f64 {
    t.iter().flatten().flatten().fold(0.0, |m, x| f64::max(m, x.abs()))
}

fn number() -> impl Strategy<Value = f64> {
    -1.0..1.0
}

fn direction() -> impl Strategy<Value = Vector> {
    (number(), number(), 0.1..1.0).prop_map(|(x, y, z)| [x, y, z])
}

fn positive(shape: [f64; 6]) -> [f64; 6] {
    [shape[0], shape[1], shape[2], shape[3], shape[4], shape[5].abs()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn finds_the_width_of_the_slab(
        features in [1usize..=3, 1usize..=3],
        shapes in [[number(), number(), number(), number(), number(), number()],
                   [number(), number(), number(), number(), number(), number()]],
        thin in prop_oneof![Just(1.0), Just(1e-3), Just(1e-7)],
        width in prop_oneof![Just(0.3), Just(1e-4), Just(1e-8), Just(1e-12)],
        (up, side, spin) in (direction(), direction(), number()),
        place_at in [number(), number(), number()],
    ) {
        let [x, y, z] = axes(up, side);
        let (sin, cos) = (spin * 3.0).sin_cos();
        let spun = add_scaled(x.map(|v| v * cos), sin, y);
        let a = place(resting(features[0], positive(shapes[0]), thin), [x, y, z.map(|v| -v)], place_at);
        let b = place(resting(features[1], positive(shapes[1]), thin), [spun, cross(z, spun), z],
                      add_scaled(place_at, width, z));
        let found = distance(&a, &b);
        let tau = ROUNDINGS * f64::EPSILON / 2.0 * size(&[a, b]);
        prop_assert!((found.squared.sqrt() - width).abs() <= tau, "{} instead of {width}", found.squared.sqrt());
        let gap = sub(found.a, found.b);
        prop_assert_eq!(dot(gap, gap), found.squared);
        prop_assert!(distance_below(&a, &b, found.squared).is_none());
        prop_assert!(!meet(&a, &b) || width <= tau);
    }

    #[test]
    fn triangles_around_a_common_point_meet_there(
        corners in [[number(), number(), number(), number(), number(), number()],
                    [number(), number(), number(), number(), number(), number()]],
        weights in [[0.1..1.0, 0.1..1.0, 0.1..1.0], [0.1..1.0, 0.1..1.0, 0.1..1.0f64]],
        common in [number(), number(), number()],
    ) {
        // Two corners anywhere, and the third so that the weighted mean of the three is the common point.
        let around = |c: [f64; 6], w: Vector| {
            let (p, q) = ([c[0], c[1], c[2]], [c[3], c[4], c[5]]);
            let sum = w[0] + w[1] + w[2];
            let rest = add_scaled(add_scaled(common.map(|x| x * sum), -w[0], p), -w[1], q);
            [p, q, rest.map(|x| x / w[2])]
        };
        let (a, b) = (around(corners[0], weights[0]), around(corners[1], weights[1]));
        prop_assert!(meet(&a, &b));
        let found = distance(&a, &b);
        prop_assert_eq!(found.squared, 0.0);
        prop_assert_eq!(found.a, found.b);
        // The point is a common one: it is at no distance from either.
        let tau = 32.0 * f64::EPSILON * size(&[a, b]);
        for t in [a, b] {
            prop_assert!(distance(&[found.a; 3], &t).squared.sqrt() <= tau);
        }
    }

    #[test]
    fn segments_are_triangles_without_area(c in proptest::array::uniform12(number()), point in any::<bool>()) {
        let corner = |i: usize| [c[i], c[i + 1], c[i + 2]];
        let (a, b) = ([corner(0), corner(if point { 0 } else { 3 })], [corner(6), corner(9)]);
        let found = segments(a, b);
        let expected = distance(&[a[0], a[1], a[1]], &[b[0], b[1], b[1]]).squared.sqrt();
        prop_assert!((found.squared.sqrt() - expected).abs() <= ROUNDINGS * f64::EPSILON);
        let gap = sub(found.a, found.b);
        prop_assert_eq!(dot(gap, gap), found.squared);
    }

    #[test]
    fn does_not_depend_on_order(c in proptest::array::uniform18(number())) {
        let t = |i: usize| [[c[i], c[i + 1], c[i + 2]], [c[i + 3], c[i + 4], c[i + 5]], [c[i + 6], c[i + 7], c[i + 8]]];
        let (a, b) = (t(0), t(9));
        let straight = distance(&a, &b).squared.sqrt();
        let turned = distance(&[b[2], b[1], b[0]], &[a[1], a[2], a[0]]).squared.sqrt();
        prop_assert!((straight - turned).abs() <= ROUNDINGS * f64::EPSILON);
    }
}

/// Reported against a widely copied implementation, which answers hundreds for two triangles that nearly touch.
#[test]
fn parallel_edges_that_nearly_touch() {
    let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let b = [[0.0, 0.0, 1e-12], [1.0, 1e-13, 1e-12], [0.0, -1.0, 1e-12]];
    assert!((distance(&a, &b).squared.sqrt() - 1e-12).abs() < 1e-16);
}

#[test]
fn degenerate_triangles_have_a_distance() {
    let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    for (flat, expected) in [
        ([[1.0, 1.0, 2.0]; 3], 2.0),
        ([[1.0, 1.0, 2.0], [1.0, 1.0, 3.0], [1.0, 1.0, 2.5]], 2.0),
        ([[-1.0, 1.0, 0.0], [-3.0, 1.0, 0.0], [-2.0, 1.0, 0.0]], 1.0),
        ([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]], 0.0),
    ] {
        assert_eq!(distance(&face, &flat).squared.sqrt(), expected);
        assert_eq!(distance(&flat, &face).squared.sqrt(), expected);
    }
}

/// No edge of either goes through the plane of the other, and rounding leaves no feature pair at exactly 0.
#[test]
fn triangles_that_overlap_in_one_plane_have_a_common_point() {
    let a = [[-0.5, -0.5, 0.5], [0.5, -0.5, 0.5], [0.5, 0.5, 0.5]];
    let b = [[-0.25, -0.375, 0.5], [0.25, 0.375, 0.5], [0.25, -0.375, 0.5]]
        .map(|[x, y, z]| [x - 0.06422826322905792, y + 0.09904016040369307, z]);
    let found = distance(&a, &b);
    assert_eq!(found.squared, 0.0);
    let gap = |point: Vector, t: &Triangle| distance(&[point; 3], t).squared.sqrt();
    assert!(gap(found.a, &a) <= 1e-15 && gap(found.b, &b) <= 1e-15, "{found:?}");
}
