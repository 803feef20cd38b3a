//! Sphere, torus knot, gear: one closed surface each.

use std::f64::consts::{PI, TAU};

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::{lathe, torus_grid};

/// A sphere of nearly equal triangles.
pub fn sphere(detail: Detail) -> Soup {
    let n = detail.steps(PI, 2);
    let profile: Vec<(f64, f64)> = (0..=n)
        .map(|i| {
            let (sin, cos) = (PI * i as f64 / n as f64).sin_cos();
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
        let r = 1.0 + 0.42 * wind.cos();
        Point::new(r * turn.cos(), r * turn.sin(), 0.42 * wind.sin())
    };
    let mut soup = Soup::default();
    soup.add(torus_grid(detail.steps(length, 40), detail.steps(TAU * tube, 3), |u, v| {
        let along: Vector = (center(u + 1e-4) - center(u - 1e-4)).normalize();
        // The outward direction of the torus that the knot lies on; never parallel to the knot.
        let hub = Point::new((2.0 * TAU * u).cos(), (2.0 * TAU * u).sin(), 0.0);
        let across = along.cross(&(center(u) - hub)).normalize();
        let (sin, cos) = (TAU * v).sin_cos();
        center(u) + tube * (cos * across + sin * along.cross(&across))
    }));
    soup
}
