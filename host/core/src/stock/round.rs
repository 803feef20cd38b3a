//! Sphere, torus knot, gear: one closed surface each.

use std::f64::consts::{PI, TAU};

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::{lathe, torus_grid};

/// A sphere of nearly equal triangles.
pub fn sphere(detail: Detail) -> Soup {
    let n = detail.steps(PI, 2);
    let profile: Vec<(f64, f64)> = (0..=n)
        .map(|i| {
            let (sin, cos) = libm::sincos(PI * i as f64 / n as f64);
            (if i == 0 || i == n { 0.0 } else { sin }, cos)
        })
        .collect();
    let mut soup = Soup::default();
    soup.add(lathe(detail, &profile, 3));
    soup
}

/// A tube around the (2, 5) torus knot.
pub fn torus_knot(mut detail: Detail) -> Soup {
    let detail = detail.part();
    let (tube, length) = (0.17, 16.0);
    let center = |u: f64| {
        let (turn, wind) = (2.0 * TAU * u, 5.0 * TAU * u);
        let ((sin, cos), (sin_wind, cos_wind)) = (libm::sincos(turn), libm::sincos(wind));
        let r = 1.0 + 0.42 * cos_wind;
        Point::new(r * cos, r * sin, 0.42 * sin_wind)
    };
    // The steps along make up for the rounding of the few steps around, so that the count has no gaps.
    let around = detail.steps(TAU * tube, 3);
    let along = (length * TAU * tube * detail.density().powi(2) / around as f64).round() as usize;
    let mut soup = Soup::default();
    soup.add(torus_grid(along.max(40), around, |u, v| {
        let along: Vector = (center(u + 1e-4) - center(u - 1e-4)).normalize();
        // The outward direction of the torus that the knot lies on; never parallel to the knot.
        let (sin, cos) = libm::sincos(2.0 * TAU * u);
        let hub = Point::new(cos, sin, 0.0);
        let across = along.cross(&(center(u) - hub)).normalize();
        let (sin, cos) = libm::sincos(TAU * v);
        center(u) + tube * (cos * across + sin * along.cross(&across))
    }));
    soup
}

/// A spur gear of 16 teeth with a bore; finer ones have a hub and a thinner web between hub and rim.
pub fn gear(mut detail: Detail) -> Soup {
    const TEETH: usize = 16;
    const PLAIN: [(f64, f64); 4] = [(0.25, -0.2), (1.0, -0.2), (1.0, 0.2), (0.25, 0.2)];
    const HUBBED: [(f64, f64); 12] = [
        (0.2, -0.3),
        (0.38, -0.3),
        (0.4, -0.09),
        (0.74, -0.09),
        (0.77, -0.2),
        (1.0, -0.2),
        (1.0, 0.2),
        (0.77, 0.2),
        (0.74, 0.09),
        (0.4, 0.09),
        (0.38, 0.3),
        (0.2, 0.3),
    ];
    let section: &[(f64, f64)] = if detail.triangles < 3_000 { &PLAIN } else { &HUBBED };
    let (root, tip) = (0.86, 1.08);

    // Once around: (angle, radius of the outermost part). A tooth is root, flank, tip, flank.
    let pitch = TAU / TEETH as f64;
    let mut around = Vec::new();
    for tooth in 0..TEETH {
        let corners = [(0.0, root), (0.34, root), (0.46, tip), (0.88, tip), (1.0, root)];
        for pair in corners.windows(2) {
            let ((f0, r0), (f1, r1)) = (pair[0], pair[1]);
            let n = detail.part().steps(libm::hypot(pitch * (f1 - f0), r1 - r0), 1);
            around.extend((0..n).map(|i| {
                let t = i as f64 / n as f64;
                (pitch * (tooth as f64 + f0 + t * (f1 - f0)), r0 + t * (r1 - r0))
            }));
        }
    }
    // Around the section, outermost points marked by radius 1.
    let mut outline = Vec::new();
    for (i, &(r0, z0)) in section.iter().enumerate() {
        let (r1, z1) = section[(i + 1) % section.len()];
        let n = detail.part().steps(libm::hypot(r1 - r0, z1 - z0), 1);
        outline.extend((0..n).map(|k| (r0 + k as f64 / n as f64 * (r1 - r0), z0 + k as f64 / n as f64 * (z1 - z0))));
    }
    let rim = section.iter().map(|p| p.0).filter(|&r| r < 1.0).fold(0.0, f64::max);
    let mut soup = Soup::default();
    soup.add(torus_grid(around.len(), outline.len(), |u, v| {
        let (angle, outer) = around[(u * around.len() as f64).round() as usize];
        let (r, z) = outline[(v * outline.len() as f64).round() as usize];
        let r = if r > rim { rim + (r - rim) / (1.0 - rim) * (outer - rim) } else { r };
        let (sin, cos) = libm::sincos(angle);
        Point::new(r * cos, r * sin, z)
    }));
    soup
}
