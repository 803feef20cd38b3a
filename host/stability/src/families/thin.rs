//! Triangles that are hardly any: slivers, and those without area.

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;

use super::near::{inside, tip_down};
use crate::draw::Draw;
use crate::shapes::{Point, Soup, Triangle, normal, single};
use crate::{Family, Harder, Made, Parameter, Posed};

pub const FAMILIES: [Family; 2] = [
    Family {
        id: "slivers",
        name: "Slivers",
        sentence: "A needle as many times as long as wide stands before a triangle, and through it.",
        source: "parry in f32; Jolt pull request 2065; pytorch3d issue 1045.",
        parameter: Parameter {
            name: "length / width",
            steps: &[1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7],
            harder: Harder::Up,
            continuous: true,
        },
        beyond: false,
        all_contacts: false,
        make: slivers,
    },
    Family {
        id: "zero-area",
        name: "Without area",
        sentence: "Beside a proper triangle there are so many points and segments that are stored as triangles.",
        source: "three-mesh-bvh issue 762, geometry3Sharp issue 85, parry issue 76, bvh issue 44.",
        parameter: Parameter {
            name: "triangles without area",
            steps: &[1.0, 3.0, 9.0, 27.0, 81.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: zero_area,
    },
];

fn slivers(draw: &mut Draw, aspect: f64) -> Made {
    let face = draw.triangle();
    let up = normal(&face);
    let needle: Triangle =
        [Point::origin(), Point::new(1.0, 0.0, 0.0), Point::new(draw.between(0.3, 0.7), 1.0 / aspect, 0.0)];
    let (turn, foot) = (tip_down(draw, &needle, &up), inside(draw, &face));
    let (a, b) = (single(face)?, single(needle)?);
    let at = |height: f64| Pose { linear: turn, translation: foot.coords + up * height };
    // Along the face as well: the long edge decides.
    let along = (face[1] - face[0]).normalize();
    let flat = Matrix3::from_columns(&[along, up, along.cross(&up)]);
    let beside = Pose { linear: flat, translation: foot.coords + up * 0.05 - along * 0.5 };
    let poses = [at(0.05), at(-0.3), beside];
    Ok(poses.map(|pose| Posed::new(&a, &b, pose).into()).to_vec())
}

fn zero_area(draw: &mut Draw, count: f64) -> Made {
    let proper = draw.triangle();
    let mut empty = |_| -> Triangle {
        let (p, q) = (draw.triangle()[0], draw.triangle()[1]);
        match draw.below(3) {
            0 => [p, p, p],
            1 => [p, p, q],
            _ => [p, nalgebra::center(&p, &q), q],
        }
    };
    let dust: Vec<Triangle> = (0..count as usize).map(&mut empty).collect();
    let (a, b) = (Soup::of(&[&[proper][..], &dust].concat()).mesh()?, single(draw.triangle())?);
    let mut apart = || draw.direction() * draw.between(4.0, 6.0);
    let (far, near) = (apart(), draw.direction() * 2.0);
    let through = inside(draw, &proper).coords;
    let turn = draw.rotation();
    let at = |translation: Vector3<f64>| Pose { linear: turn, translation };
    Ok([far, near, through].map(|t| Posed::new(&a, &b, at(t)).into()).to_vec())
}
