//! A chandelier: thin parts far apart, extremely concave.

use std::f64::consts::TAU;

use super::builder::{Detail, Point, Soup};
use super::solids::{bent_tube, cornered, lathe, smooth, torus};

/// Stem, arms with candles, hanging drops, strings of beads and a chain. Coarse ones have fewer arms, and the beads and
/// the upper tier come with the triangles for them.
pub fn lustre(mut detail: Detail) -> Soup {
    let (arms, upper) = match detail.triangles {
        ..1_500 => (4, 0),
        1_500..6_000 => (6, 0),
        6_000..20_000 => (8, 4),
        _ => (10, 5),
    };
    let mut soup = Soup::default();
    let stem = [
        (0.0, -0.92),
        (0.05, -0.88),
        (0.15, -0.76),
        (0.05, -0.62),
        (0.2, -0.4),
        (0.26, -0.24),
        (0.09, -0.02),
        (0.05, 0.3),
        (0.12, 0.44),
        (0.04, 0.6),
        (0.04, 0.84),
        (0.0, 0.9),
    ];
    let part = detail.part();
    soup.add(lathe(part, &smooth(part, &stem, 9), 5));
    if detail.triangles >= 2_000 {
        chain(&mut soup, &mut detail);
    }
    for i in 0..arms {
        let angle = i as f64 / arms as f64;
        arm(&mut soup, &mut detail, angle, 1.0, -0.25);
        if detail.triangles >= 6_000 {
            beads(&mut soup, &mut detail, angle, angle + 1.0 / arms as f64);
        }
    }
    for i in 0..upper {
        arm(&mut soup, &mut detail, (i as f64 + 0.3) / upper as f64, 0.55, 0.3);
    }
    soup
}

fn turn(p: Point, angle: f64) -> Point {
    let (sin, cos) = libm::sincos(TAU * angle);
    Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z)
}

/// One arm of reach `size` from height `z`, with cup, candle, flame and a hanging drop. `angle` in turns.
fn arm(soup: &mut Soup, detail: &mut Detail, angle: f64, size: f64, z: f64) {
    let at = |r: f64, h: f64| Point::new(size * r, 0.0, z + size * h);
    let curve = [at(0.08, 0.02), at(0.35, -0.26), at(0.7, -0.26), at(0.97, -0.08), at(1.0, 0.1)];
    let thick = 0.028 * size.sqrt();
    soup.add_at(bent_tube(detail.part(), &curve, thick, |t| thick * (1.25 - 0.5 * t)), |p| turn(p, angle));

    let tip = at(1.0, 0.1);
    let mut on_tip = |profile: &[(f64, f64)], rounded: bool, least: usize| {
        let part = detail.part();
        let profile = if rounded { smooth(part, profile, 3) } else { cornered(part, profile) };
        soup.add_at(lathe(part, &profile, least), |p| turn(Point::new(p.x + tip.x, p.y, p.z + tip.z), angle));
    };
    on_tip(&[(0.0, -0.03), (0.08, 0.0), (0.11, 0.05), (0.0, 0.03)], false, 4);
    on_tip(&[(0.0, 0.01), (0.036, 0.012), (0.034, 0.26), (0.0, 0.27)], false, 3);
    on_tip(&[(0.0, 0.262), (0.024, 0.3), (0.0, 0.38)], true, 3);
    on_tip(&[(0.0, -0.28), (0.035, -0.2), (0.012, -0.1), (0.0, -0.02)], true, 4);
}

/// A string of beads, hanging in a parabola from one arm to the next (angles in turns).
fn beads(soup: &mut Soup, detail: &mut Detail, from: f64, to: f64) {
    let count = 9;
    for k in 0..count {
        let t = (k as f64 + 0.5) / count as f64;
        let sag = 0.22 * 4.0 * t * (1.0 - t);
        let (a, b) = (turn(Point::new(0.97, 0.0, 0.0), from), turn(Point::new(0.97, 0.0, 0.0), to));
        let at = Point::from(a.coords.lerp(&b.coords, t)) - nalgebra::Vector3::new(0.0, 0.0, 0.2 + sag);
        let part = detail.part();
        let r = 0.024;
        let bead = lathe(part, &smooth(part, &[(0.0, -r), (r, 0.0), (0.0, r)], 2), 4);
        soup.add_at(bead, |p| at + p.coords);
    }
}

/// Links above the stem, each turned a quarter against the last.
fn chain(soup: &mut Soup, detail: &mut Detail) {
    for link in 0..6 {
        let ring = torus(detail.part(), 0.05, 0.012);
        let z = 0.94 + 0.085 * f64::from(link);
        let flat = |p: Point| if link % 2 == 0 { Point::new(p.y, p.z, p.x) } else { Point::new(p.z, p.y, p.x) };
        soup.add_at(ring, |p| flat(p) + nalgebra::Vector3::new(0.0, 0.0, z));
    }
}
