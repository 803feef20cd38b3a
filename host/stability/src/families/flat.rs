//! Flat sides on flat sides: triangles in one plane, boxes on boxes, planes that are nearly parallel.

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;

use super::DECADES;
use crate::draw::Draw;
use crate::shapes::{Point, Soup, cuboid, single};
use crate::{Family, Harder, Made, Parameter, Posed};

pub const FAMILIES: [Family; 4] = [
    Family {
        id: "coplanar",
        name: "In one plane",
        sentence: "Two triangles lie in one plane, exactly or up to rounding after a rotation, side by side at the gap.",
        source: "Wrong in Coal, libccd, parry and openGJK.",
        parameter: Parameter { name: "gap", steps: DECADES, harder: Harder::Down, continuous: true },
        beyond: false,
        all_contacts: false,
        make: coplanar,
    },
    Family {
        id: "stacked-boxes",
        name: "Box on a box",
        sentence: "A box stands on another one, over it or into it by the gap.",
        source: "FCL issues 106, 493 and 502, libccd issue 25.",
        parameter: Parameter {
            name: "gap",
            steps: &[1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2],
            harder: Harder::Down,
            continuous: true,
        },
        beyond: false,
        all_contacts: false,
        make: stacked_boxes,
    },
    Family {
        id: "near-parallel",
        name: "Nearly parallel",
        sentence: "Two triangles a thousandth apart, in planes that differ by the angle.",
        source: "Distances wrong in openGJK and in CGAL's inexact kernel.",
        parameter: Parameter { name: "angle, radians", steps: DECADES, harder: Harder::Down, continuous: true },
        beyond: false,
        all_contacts: false,
        make: near_parallel,
    },
    Family {
        id: "ties",
        name: "Many nearest pairs",
        sentence: "Two plates cut into equal squares face each other, so that very many pairs are equally near.",
        source: "trimesh issue 1055.",
        parameter: Parameter {
            name: "squares",
            steps: &[1.0, 4.0, 16.0, 64.0, 144.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: ties,
    },
];

fn coplanar(draw: &mut Draw, gap: f64) -> Made {
    let turn = if draw.coin() { draw.rotation() } else { Matrix3::identity() };
    let mut eighth = |from: i32, to: i32| f64::from(from + draw.below((to - from) as usize) as i32) / 8.0;
    // A's edge lies on the second axis, B's corner comes to it from the other side.
    let a = [[0.0, -1.0], [0.0, 1.0], [-eighth(4, 9), eighth(-8, 8)]];
    let b = [[0.0, eighth(-6, 6)], [eighth(3, 9), eighth(1, 9)], [eighth(3, 9), eighth(-8, 0)]];
    let place = |corners: [[f64; 2]; 3]| single(corners.map(|[x, y]| Point::from(turn * Vector3::new(x, y, 0.0))));
    let (a, b) = (place(a)?, place(b)?);
    let aside = |by: f64| Pose { linear: Matrix3::identity(), translation: turn * Vector3::new(by, 0.0, 0.0) };
    Ok([gap, -gap].map(|by| Posed::new(&a, &b, aside(by)).into()).to_vec())
}

fn stacked_boxes(draw: &mut Draw, gap: f64) -> Made {
    let (a, b) = (cuboid(Vector3::repeat(0.5)).mesh()?, cuboid(Vector3::new(0.25, 0.375, 0.5)).mesh()?);
    let aside = Vector3::new(draw.between(-0.2, 0.2), draw.between(-0.1, 0.1), 0.0);
    let on = |by: f64| Pose { linear: Matrix3::identity(), translation: aside + Vector3::new(0.0, 0.0, 1.0 + by) };
    Ok([gap, -gap].map(|by| Posed::new(&a, &b, on(by)).into()).to_vec())
}

fn near_parallel(draw: &mut Draw, angle: f64) -> Made {
    const GAP: f64 = 1e-3;
    let mut flat = || {
        let mut corner = |x: f64, y: f64| Point::new(x + draw.between(-0.2, 0.2), y + draw.between(-0.2, 0.2), 0.0);
        single([corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)])
    };
    let (a, b) = (flat()?, flat()?);
    let common = draw.rotation();
    let (sine, cosine) = libm::sincos(angle);
    let tilt = Matrix3::new(1.0, 0.0, 0.0, 0.0, cosine, -sine, 0.0, sine, cosine);
    // High enough for the lower end to stay above A.
    let lift = Vector3::new(draw.between(-0.3, 0.3), 0.0, GAP + 1.3 * sine);
    let mut posed = Posed::new(&a, &b, Pose { linear: common * tilt, translation: common * lift });
    posed.configuration.pose_a.linear = common;
    Ok(vec![posed.into()])
}

fn ties(draw: &mut Draw, squares: f64) -> Made {
    let n = squares.sqrt() as usize;
    let at = |i: usize, j: usize| Point::new(i as f64 / n as f64, j as f64 / n as f64, 0.0);
    let cells = (0..n * n).flat_map(|k| {
        let (i, j) = (k / n, k % n);
        let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[p, q, r], [p, r, s]]
    });
    let plate = Soup::of(&cells.collect::<Vec<_>>()).mesh()?;
    let turned = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);
    let lift = Vector3::new(0.0, 1.0, 0.25 + draw.unit());
    Ok(vec![Posed::new(&plate, &plate, Pose { linear: turned, translation: lift }).into()])
}
