//! A castle: walls, towers, a gate and a keep.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::{cornered, cuboid, lathe};

/// Half side of the square of walls.
const WALL: f64 = 1.0;

/// Curtain walls with battlements, corner towers with cone roofs, a gatehouse and a keep inside. Finer ones have more
/// merlons, round turrets and a portcullis.
pub fn castle(mut detail: Detail) -> Soup {
    let mut soup = Soup::default();
    let merlons = (detail.triangles / 300).clamp(2, 9) as usize;
    let fine = detail.triangles >= 3_000;
    add_box(&mut soup, &mut detail, [0.0, 0.0, -0.04], [1.45, 1.45, 0.06]);
    for side in 0..4 {
        wall(&mut soup, &mut detail, side, merlons);
        let corner = quarter(Vector::new(WALL, WALL, 0.0), side);
        tower(&mut soup, &mut detail, corner, 0.2, 0.85, fine);
    }
    // The keep, and the gatehouse in the front wall, which is left open in the middle.
    add_box(&mut soup, &mut detail, [0.1, 0.15, 0.5], [0.36, 0.3, 0.5]);
    for i in 0..merlons.min(5) {
        let t = if merlons > 1 { i as f64 / (merlons.min(5) - 1) as f64 * 2.0 - 1.0 } else { 0.0 };
        for side in [-1.0, 1.0] {
            add_box(&mut soup, &mut detail, [0.1 + 0.31 * t, 0.15 + 0.26 * side, 1.03], [0.05, 0.045, 0.07]);
        }
    }
    tower(&mut soup, &mut detail, Vector::new(-0.28, 0.45, 0.0), 0.16, 1.3, fine);
    for side in [-1.0, 1.0] {
        add_box(&mut soup, &mut detail, [0.26 * side, -WALL, 0.36], [0.1, 0.17, 0.37]);
    }
    add_box(&mut soup, &mut detail, [0.0, -WALL, 0.62], [0.18, 0.13, 0.14]);
    if fine {
        for i in 0..6 {
            add_box(&mut soup, &mut detail, [-0.14 + 0.056 * f64::from(i), -WALL - 0.02, 0.3], [0.01, 0.01, 0.3]);
        }
        for i in 0..4 {
            add_box(&mut soup, &mut detail, [0.0, -WALL - 0.02, 0.12 + 0.1 * f64::from(i)], [0.17, 0.008, 0.008]);
        }
    }
    soup
}

fn add_box(soup: &mut Soup, detail: &mut Detail, center: [f64; 3], half: [f64; 3]) {
    soup.add(cuboid(detail.part(), Point::from(Vector3::from(center)), Vector3::from(half)));
}

/// Turned about the z axis by quarters, exactly.
fn quarter(p: Vector, turns: usize) -> Vector {
    (0..turns).fold(p, |p, _| Vector::new(-p.y, p.x, p.z))
}

/// One curtain wall with merlons on top; side 0 is the front and has a gap for the gate.
fn wall(soup: &mut Soup, detail: &mut Detail, side: usize, merlons: usize) {
    // Along x at y = -WALL for the front, turned for the others.
    let mut piece = |center: Vector, half: Vector| {
        soup.add_at(cuboid(detail.part(), Point::origin(), half), |p| Point::from(quarter(p.coords + center, side)));
    };
    if side == 0 {
        for left in [-1.0, 1.0] {
            piece(Vector::new(0.55 * left, -WALL, 0.26), Vector::new(0.4, 0.07, 0.28));
        }
    } else {
        piece(Vector::new(0.0, -WALL, 0.26), Vector::new(0.95, 0.07, 0.28));
    }
    for i in 0..merlons {
        let x = 0.68 * (2.0 * (i as f64 + 0.5) / merlons as f64 - 1.0);
        if side > 0 || x.abs() > 0.4 {
            // Wide enough to leave equal gaps, slightly sunk into the wall.
            let width = (0.34 / merlons as f64).min(0.08);
            piece(Vector::new(x, -WALL - 0.035, 0.59), Vector::new(width, 0.03, 0.07));
        }
    }
}

/// A round tower with a projecting parapet and a cone roof.
fn tower(soup: &mut Soup, detail: &mut Detail, at: Vector, radius: f64, height: f64, fine: bool) {
    let part = detail.part();
    let outline = [
        (0.0, -0.01),
        (1.15 * radius, -0.01),
        (radius, 0.15 * height),
        (radius, 0.85 * height),
        (1.25 * radius, 0.92 * height),
        (1.25 * radius, height),
        (0.0, height),
    ];
    let outline: &[(f64, f64)] =
        if fine { &outline } else { &[(0.0, -0.01), (radius, -0.01), (1.1 * radius, height), (0.0, height)] };
    soup.add_at(lathe(part, &cornered(part, outline), 6), |p| p + at);
    let roof = [(0.0, height - 0.02), (1.05 * radius, height - 0.02), (0.0, height + 2.4 * radius)];
    let part = detail.part();
    soup.add_at(lathe(part, &cornered(part, &roof), 6), |p| p + at);
    if fine {
        for i in 0..8 {
            let (sin, cos) = libm::sincos(TAU * (f64::from(i) + 0.5) / 8.0);
            let middle = at + Vector::new(1.17 * radius * cos, 1.17 * radius * sin, height + 0.03);
            let half = Vector::new(0.06 * radius, 0.22 * radius, 0.05);
            soup.add_at(cuboid(detail.part(), Point::origin(), half), |p| {
                Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z) + middle
            });
        }
    }
}
