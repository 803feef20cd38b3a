//! A turned wooden chair.

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::{bent_tube, block, lathe, smooth};

/// Seat, four splayed turned legs, stretchers, back posts with spindles and a curved top rail.
pub fn chair(mut detail: Detail) -> Soup {
    let mut soup = Soup::default();
    seat(&mut soup, &mut detail);
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        leg(&mut soup, &mut detail, x, y);
    }
    // Stretchers: left, right, and one between them.
    let foot = |x: f64, y: f64, z: f64| Point::new(x * (0.43 - 0.1 * z), y * (0.43 - 0.1 * z), z);
    for x in [-1.0, 1.0] {
        stick(&mut soup, &mut detail, &[foot(x, -1.0, 0.3), foot(x, 1.0, 0.3)], 0.018);
    }
    stick(&mut soup, &mut detail, &[Point::new(-0.4, 0.0, 0.3), Point::new(0.4, 0.0, 0.3)], 0.018);

    for x in [-1.0, 1.0] {
        let post = [Point::new(0.36 * x, 0.36, 0.84), Point::new(0.38 * x, 0.45, 1.3), Point::new(0.4 * x, 0.53, 1.75)];
        stick(&mut soup, &mut detail, &post, 0.034);
    }
    let spindles = if detail.triangles < 1_500 { 3 } else { 6 };
    for i in 0..spindles {
        let x = 2.0 * (f64::from(i) + 0.5) / f64::from(spindles) - 1.0;
        let back = 0.06 * (1.0 - x * x);
        let spindle = [
            Point::new(0.28 * x, 0.37, 0.84),
            Point::new(0.3 * x, 0.44 + 0.5 * back, 1.2),
            Point::new(0.33 * x, 0.5 + back, 1.58),
        ];
        stick(&mut soup, &mut detail, &spindle, 0.016);
    }
    rail(&mut soup, &mut detail);
    soup
}

/// A round stick, a little thicker in the middle.
fn stick(soup: &mut Soup, detail: &mut Detail, points: &[Point], thick: f64) {
    // Straight ones get a middle point, so that the swelling shows.
    let points = match points {
        [a, b] => vec![*a, nalgebra::center(a, b), *b],
        _ => points.to_vec(),
    };
    soup.add(bent_tube(detail.part(), &points, thick, |t| thick * (0.8 + 0.8 * t * (1.0 - t))));
}

fn seat(soup: &mut Soup, detail: &mut Detail) {
    let part = detail.part();
    let (half, thick) = (0.48, 0.05);
    let n = part.steps(2.0 * half, 2);
    soup.add(block([n, n, part.steps(2.0 * thick, 1)], |u| {
        // A rounded square, hollowed a little where one sits; the edge is rounded off towards top and bottom.
        let square = u.x.abs().max(u.y.abs());
        let round = (u.x * u.x + u.y * u.y).sqrt().max(1e-9);
        let pull = 1.0 - 0.55 * (1.0 - square / round) * square;
        let edge = 1.0 - 0.06 * u.z * u.z;
        let hollow = 0.03 * (1.0 - u.x * u.x) * (1.0 - u.y * u.y);
        Point::new(half * u.x * pull * edge, half * u.y * pull * edge, 0.86 + thick * u.z - hollow * (0.5 + 0.5 * u.z))
    }));
}

/// A turned leg, leaning outwards; `x` and `y` give the corner.
fn leg(soup: &mut Soup, detail: &mut Detail, x: f64, y: f64) {
    let part = detail.part();
    let turned = [
        (0.0, 0.0),
        (0.022, 0.004),
        (0.03, 0.12),
        (0.024, 0.25),
        (0.042, 0.32),
        (0.028, 0.4),
        (0.046, 0.58),
        (0.03, 0.7),
        (0.034, 0.83),
        (0.0, 0.835),
    ];
    soup.add_at(lathe(part, &smooth(part, &turned, 6), 5), |p| {
        let lean = Vector::new(x * (0.43 - 0.1 * p.z), y * (0.43 - 0.1 * p.z), 0.0);
        p + lean
    });
}

fn rail(soup: &mut Soup, detail: &mut Detail) {
    let part = detail.part();
    let n = [part.steps(1.0, 3), part.steps(0.06, 1), part.steps(0.26, 1)];
    soup.add(block(n, |u| {
        let bow = 0.06 * (1.0 - u.x * u.x);
        let crest = 0.05 * (1.0 - u.x * u.x);
        let top = 0.5 + 0.5 * u.z;
        Point::new(
            0.47 * u.x,
            0.515 + bow + 0.03 * u.y * (1.0 - 0.3 * u.z * u.z) + 0.02 * top,
            1.66 + 0.11 * u.z + crest * top,
        )
    }));
}
