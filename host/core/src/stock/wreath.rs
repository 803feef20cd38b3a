//! A wreath: twisted twigs, leaves all around, berries.

use std::f64::consts::TAU;

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::{block, lathe, smooth, torus_grid};

/// Many small separate leaves on a ring; the more triangles, the more leaves and berries.
pub fn wreath(mut detail: Detail) -> Soup {
    let mut soup = Soup::default();
    let leaves = (detail.triangles / 50).clamp(8, 240);
    let twigs = if detail.triangles < 2_000 { 1 } else { 3 };
    for i in 0..twigs {
        twig(&mut soup, &mut detail, f64::from(i) / f64::from(twigs), if twigs == 1 { 0.0 } else { 0.05 });
    }
    for i in 0..leaves {
        leaf(&mut soup, &mut detail, i, leaves);
    }
    for i in 0..leaves / 6 {
        berry(&mut soup, &mut detail, i, leaves / 6);
    }
    soup
}

/// Outwards, upwards and along the ring at an angle (turns).
fn frame(angle: f64) -> [Vector; 3] {
    let (sin, cos) = libm::sincos(TAU * angle);
    [Vector::new(cos, sin, 0.0), Vector::z(), Vector::new(-sin, cos, 0.0)]
}

/// A place around the ring's center line: `angle` and `roll` in turns, at a distance from the line.
fn around(angle: f64, roll: f64, distance: f64) -> (Point, Vector) {
    let [out, up, _] = frame(angle);
    let (sin, cos) = libm::sincos(TAU * roll);
    let away = cos * out + sin * up;
    (Point::from(out + distance * away), away)
}

fn twig(soup: &mut Soup, detail: &mut Detail, phase: f64, offset: f64) {
    let part = detail.part();
    let center = |u: f64| around(u, 7.0 * u + phase, offset).0;
    soup.add(torus_grid(part.steps(TAU, 12), part.steps(TAU * 0.05, 3), |u, v| {
        let along = (center(u + 1e-4) - center(u - 1e-4)).normalize();
        let across = along.cross(&Vector::z()).normalize();
        let (sin, cos) = libm::sincos(TAU * v);
        center(u) + 0.045 * (cos * across + sin * along.cross(&across))
    }));
}

/// A leaf that grows out of the ring and lies back along it; the places follow the golden angle, so that they never
/// line up.
fn leaf(soup: &mut Soup, detail: &mut Detail, i: u32, of: u32) {
    let part = detail.part();
    let (i, of) = (f64::from(i), f64::from(of));
    let angle = (i + 0.5) / of;
    let roll = (i * 0.381_966_011_250_105_1).fract();
    let (root, away) = around(angle, roll, 0.03);
    let along = frame(angle)[2];
    let direction = (0.75 * along + 0.8 * away).normalize();
    let side = direction.cross(&away).normalize();
    let normal = side.cross(&direction);
    let size = 0.3 + 0.08 * libm::sin(5.0 * i);
    let wide = 0.3 * size;
    let n = [part.steps(size, 2), part.steps(2.0 * wide, 1), 1];
    soup.add(block(n, |u| {
        let t = 0.5 + 0.5 * u.x;
        // Widest before the middle, pointed but never without width; curled back towards the tip.
        let width = wide * (0.06 + 1.7 * t.sqrt() * libm::pow(1.0 - t, 0.8));
        let thick = 0.014 * (1.05 - u.y * u.y) * (1.05 - 0.8 * t);
        let curl = 0.25 * size * t * t - 0.3 * wide * u.y * u.y * width / wide;
        root + direction * (size * t) + side * (width * u.y) - normal * curl + normal * (thick * u.z)
    }));
}

fn berry(soup: &mut Soup, detail: &mut Detail, i: u32, of: u32) {
    let part = detail.part();
    let angle = (f64::from(i) + 0.2) / f64::from(of);
    let (at, _) = around(angle, 0.125 + (f64::from(i) * 0.381_966_011_250_105_1).fract() * 0.25, 0.19);
    let r = 0.05;
    let ball =
        lathe(part, &smooth(part, &[(0.0, -r), (0.71 * r, -0.71 * r), (r, 0.0), (0.71 * r, 0.71 * r), (0.0, r)], 2), 4);
    soup.add_at(ball, |p| at + p.coords);
}
