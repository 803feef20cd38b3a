//! The closed parts that objects are built from.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::builder::{Detail, Point, Soup, Vector};

/// A cube's surface in steps of `n`, mapped by `point` from [-1, 1]^3 (a box, a bent rail, a leaf).
pub fn block(n: [usize; 3], point: impl Fn(Vector) -> Point) -> Soup {
    let mut soup = Soup::default();
    let mut known = BTreeMap::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [0, n[axis]] {
            for (i, j) in (0..n[u]).flat_map(|i| (0..n[v]).map(move |j| (i, j))) {
                let mut corner = |di: usize, dj: usize| {
                    let mut at = [0; 3];
                    (at[axis], at[u], at[v]) = (side, i + di, j + dj);
                    *known.entry(at).or_insert_with(|| {
                        let unit = |k: usize| 2.0 * at[k] as f64 / n[k] as f64 - 1.0;
                        soup.positions.push(point(Vector::new(unit(0), unit(1), unit(2))));
                        soup.positions.len() as u32 - 1
                    })
                };
                let mut quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if side == 0 {
                    quad.reverse();
                }
                let [a, b, c, d] = quad;
                soup.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    soup
}

/// An axis-aligned box around `center` with half sides `half`.
pub fn cuboid(mut detail: Detail, center: Point, half: Vector) -> Soup {
    let n = [0, 1, 2].map(|k| detail.part().steps(2.0 * half[k], 1));
    block(n, |u| center + half.component_mul(&u))
}

/// A surface closed both ways, like a torus: `point(u, v)` with u and v from 0 to 1 (1 excluded).
pub fn torus_grid(nu: usize, nv: usize, point: impl Fn(f64, f64) -> Point) -> Soup {
    let mut soup = Soup::default();
    for i in 0..nu {
        soup.positions.extend((0..nv).map(|j| point(i as f64 / nu as f64, j as f64 / nv as f64)));
    }
    let at = |i: usize, j: usize| ((i % nu) * nv + j % nv) as u32;
    for (i, j) in (0..nu).flat_map(|i| (0..nv).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        soup.triangles.extend([[a, b, c], [a, c, d]]);
    }
    soup
}

/// A solid of revolution about the z axis. The profile runs from the axis to the axis as (radius, height); rings get as
/// many vertices as their length asks for, at least `least`.
pub fn lathe(detail: Detail, profile: &[(f64, f64)], least: usize) -> Soup {
    let mut soup = Soup::default();
    let rings: Vec<(u32, usize)> = profile
        .iter()
        .map(|&(r, z)| {
            let n = if r > 0.0 { detail.steps(TAU * r, least.max(3)) } else { 1 };
            let start = soup.positions.len() as u32;
            soup.positions.extend((0..n).map(|i| {
                let (sin, cos) = libm::sincos(TAU * i as f64 / n as f64);
                Point::new(r * cos, r * sin, z)
            }));
            (start, n)
        })
        .collect();
    for pair in rings.windows(2) {
        zip(&mut soup.triangles, pair[0], pair[1]);
    }
    soup
}

/// Triangles between two rings (first vertex, number of vertices), always taking the nearer next vertex.
fn zip(triangles: &mut Vec<[u32; 3]>, (start_a, a): (u32, usize), (start_b, b): (u32, usize)) {
    let at = |start: u32, i: usize, n: usize| start + (i % n) as u32;
    let (mut i, mut j) = (0, 0);
    let (end_a, end_b) = (if a == 1 { 0 } else { a }, if b == 1 { 0 } else { b });
    while i < end_a || j < end_b {
        // Compare (i + 1/2) / a with (j + 1/2) / b in whole numbers.
        let advance_a = j == end_b || (i < end_a && (2 * i + 1) * b <= (2 * j + 1) * a);
        let (p, q) = (at(start_a, i, a), at(start_b, j, b));
        if advance_a {
            i += 1;
            triangles.push([p, at(start_a, i, a), q]);
        } else {
            j += 1;
            triangles.push([p, at(start_b, j, b), q]);
        }
    }
}

/// A profile with corners: each stretch cut by its length.
pub fn cornered(detail: Detail, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut profile = vec![points[0]];
    for pair in points.windows(2) {
        let ((r0, z0), (r1, z1)) = (pair[0], pair[1]);
        let n = detail.steps(libm::hypot(r1 - r0, z1 - z0), 1);
        profile.extend((1..=n).map(|i| {
            let t = i as f64 / n as f64;
            if i == n { (r1, z1) } else { (r0 + t * (r1 - r0), z0 + t * (z1 - z0)) }
        }));
    }
    profile
}

/// A smooth profile through points (Catmull-Rom), cut into at least `least` stretches.
pub fn smooth(detail: Detail, points: &[(f64, f64)], least: usize) -> Vec<(f64, f64)> {
    let curve: Vec<Point> = points.iter().map(|&(r, z)| Point::new(r, z, 0.0)).collect();
    let n = detail.steps(length(&curve), least);
    let last = points.len() - 1;
    (0..=n)
        .map(|i| match i {
            0 => points[0],
            i if i == n => points[last],
            _ => {
                let p = spline(&curve, i as f64 / n as f64);
                // The spline may swing across the axis between control points.
                (p.x.max(1e-3 * points.iter().map(|q| q.0).fold(0.0, f64::max)), p.y)
            }
        })
        .collect()
}

/// Length of a polyline.
pub fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

/// The Catmull-Rom spline through points, `t` from 0 to 1.
pub fn spline(points: &[Point], t: f64) -> Point {
    let spans = points.len() - 1;
    let x = t.clamp(0.0, 1.0) * spans as f64;
    let i = (x as usize).min(spans - 1);
    let s = x - i as f64;
    let (p1, p2) = (points[i].coords, points[i + 1].coords);
    let p0 = if i > 0 { points[i - 1].coords } else { 2.0 * p1 - p2 };
    let p3 = if i + 2 < points.len() { points[i + 2].coords } else { 2.0 * p2 - p1 };
    let (a, b, c) = (p2 - p0, 2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3, 3.0 * p1 - p0 - 3.0 * p2 + p3);
    Point::from(p1 + 0.5 * s * (a + s * (b + s * c)))
}

/// A tube of `sides` around `centers`, closed by flat ends; `radius` is given per center.
///
/// The cross-section is carried along without twist.
pub fn tube(centers: &[Point], radius: impl Fn(usize) -> f64, sides: usize) -> Soup {
    let last = centers.len() - 1;
    let tangent = |i: usize| (centers[(i + 1).min(last)] - centers[i.saturating_sub(1)]).normalize();
    let mut soup = Soup::default();
    let first = tangent(0);
    let helper = if first.x.abs() < 0.6 { Vector::x() } else { Vector::y() };
    let mut across = first.cross(&helper).normalize();
    for (i, center) in centers.iter().enumerate() {
        let along = tangent(i);
        across = (across - along * along.dot(&across)).normalize();
        let up = along.cross(&across);
        soup.positions.extend((0..sides).map(|j| {
            let (sin, cos) = libm::sincos(TAU * j as f64 / sides as f64);
            center + radius(i) * (cos * across + sin * up)
        }));
    }
    let at = |i: usize, j: usize| (i * sides + j % sides) as u32;
    for (i, j) in (0..last).flat_map(|i| (0..sides).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        soup.triangles.extend([[a, b, c], [a, c, d]]);
    }
    for (end, inwards) in [(0, true), (last, false)] {
        let middle = soup.positions.len() as u32;
        soup.positions.push(centers[end]);
        soup.triangles.extend((0..sides).map(|j| {
            let (a, b) = (at(end, j), at(end, j + 1));
            if inwards { [b, a, middle] } else { [a, b, middle] }
        }));
    }
    soup
}

/// A tube along the spline through `points`; `radius` is given by the place from 0 to 1, `thick` is about its size.
pub fn bent_tube(detail: Detail, points: &[Point], thick: f64, radius: impl Fn(f64) -> f64) -> Soup {
    let n = detail.steps(length(points), points.len().min(4));
    let centers: Vec<Point> = (0..=n).map(|i| spline(points, i as f64 / n as f64)).collect();
    tube(&centers, |i| radius(i as f64 / n as f64), detail.steps(TAU * thick, 3))
}

/// A torus about the z axis.
pub fn torus(detail: Detail, radius: f64, thick: f64) -> Soup {
    torus_grid(detail.steps(TAU * radius, 5), detail.steps(TAU * thick, 3), |u, v| {
        let (sin_u, cos_u) = libm::sincos(TAU * u);
        let (sin_v, cos_v) = libm::sincos(TAU * v);
        let r = radius + thick * cos_v;
        Point::new(r * cos_u, r * sin_u, thick * sin_v)
    })
}
