//! `meet` against separating axes in exact integer arithmetic, on a grid so coarse that touching, coplanar and degenerate
//! triangles are common.

use ocb_triangles::meet;
use proptest::prelude::*;

type Point = [i64; 3];

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whether no plane orthogonal to an axis separates the triangles strictly. The axes are those of two convex polytopes
/// (normals and edge products), those of two coplanar ones (normals of the edges in each plane), and, for triangles that
/// are segments or points, those of the plane through both, the line through both, and the edges.
fn meet_by_axes(a: [Point; 3], b: [Point; 3]) -> bool {
    let edges = |t: [Point; 3]| [sub(t[1], t[0]), sub(t[2], t[1]), sub(t[0], t[2])];
    let (edges_a, edges_b) = (edges(a), edges(b));
    let all_edges: Vec<Point> = edges_a.into_iter().chain(edges_b).collect();
    let mut normals = vec![cross(edges_a[0], edges_a[1]), cross(edges_b[0], edges_b[1])];
    normals.extend(edges_a.iter().flat_map(|&e| edges_b.iter().map(move |&f| cross(e, f))));
    let between = sub(b[0], a[0]);
    normals.extend(all_edges.iter().map(|&e| cross(e, between)));
    let in_plane = normals.iter().flat_map(|&n| all_edges.iter().map(move |&e| cross(n, e)));
    let mut axes = normals.iter().copied().chain(in_plane).chain(all_edges.iter().copied()).chain([between]);
    !axes.any(|axis| {
        let along = |p: Point| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
        let [min_a, min_b] = [a, b].map(|t| t.map(along).into_iter().min());
        let [max_a, max_b] = [a, b].map(|t| t.map(along).into_iter().max());
        max_a < min_b || max_b < min_a
    })
}

fn triangle(range: i64) -> impl Strategy<Value = [Point; 3]> {
    let number = move || -range..=range;
    let point = move || [number(), number(), number()];
    [point(), point(), point()]
}

fn float(t: [Point; 3]) -> ocb_triangles::Triangle {
    t.map(|p| p.map(|x| x as f64 / 8.0))
}

fn check(a: [Point; 3], b: [Point; 3]) {
    let expected = meet_by_axes(a, b);
    for shift in 0..3 {
        let turned = [b[shift], b[(shift + 1) % 3], b[(shift + 2) % 3]];
        let flipped = [turned[1], turned[0], turned[2]];
        assert_eq!(meet(&float(a), &float(turned)), expected, "{a:?} {turned:?}");
        assert_eq!(meet(&float(flipped), &float(a)), expected, "{flipped:?} {a:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn agrees_with_separating_axes(a in triangle(2), b in triangle(2)) {
        check(a, b);
    }

    #[test]
    fn agrees_in_a_plane(a in triangle(3), b in triangle(3)) {
        // x + 2 y - z = 0, and no projection of that plane is a line.
        let flat = |t: [Point; 3]| t.map(|[x, y, _]| [x, y, x + 2 * y]);
        check(flat(a), flat(b));
    }

    #[test]
    fn agrees_in_a_plane_seen_edge_on(a in triangle(3), b in triangle(3)) {
        let flat = |t: [Point; 3]| t.map(|[x, y, _]| [x, y, 1]);
        check(flat(a), flat(b));
    }
}

#[test]
fn one_inside_the_other_in_a_plane_meets() {
    check([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[1, 1, 0], [2, 1, 0], [1, 2, 0]]);
}

#[test]
fn a_point_on_a_face_meets_and_beside_it_does_not() {
    check([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[1, 1, 0]; 3]);
    check([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[5, 5, 0]; 3]);
}
