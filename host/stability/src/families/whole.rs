//! Whole objects: deep in each other, inside each other, the same twice, thousands of contacts.

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;

use crate::draw::Draw;
use crate::shapes::{ball, comb, cuboid};
use crate::{Family, Harder, Made, Parameter, Posed, Question};

pub const FAMILIES: [Family; 4] = [
    Family {
        id: "many-contacts",
        name: "Thousands of contacts",
        sentence: "Two combs stand crosswise in each other, every blade through every other; all contacts are asked for.",
        source: "Buffers for contacts that are too small: Genesis pull request 3223.",
        parameter: Parameter { name: "blades", steps: &[4.0, 8.0, 16.0, 32.0], harder: Harder::Up, continuous: false },
        beyond: false,
        all_contacts: true,
        make: many_contacts,
    },
    Family {
        id: "deep",
        name: "Deep in each other",
        sentence: "A ball of 512 triangles in another one, their centres so far apart.",
        source: "Times that grow by an order of magnitude; Bullet issue 1623.",
        parameter: Parameter {
            name: "distance of the centres / radius",
            steps: &[0.01, 0.03, 0.1, 0.3, 1.0, 1.7],
            harder: Harder::Down,
            continuous: true,
        },
        beyond: false,
        all_contacts: false,
        make: deep,
    },
    Family {
        id: "containment",
        name: "One inside the other",
        sentence: "A cube inside a cube without touching it: as surfaces apart, as solid bodies in collision.",
        source: "FCL issues 78 and 492, Coal issue 134, trimesh issue 2223.",
        parameter: Parameter {
            name: "size of the inner one / size of the outer one",
            steps: &[0.1, 0.5, 0.9, 0.99, 0.999, 0.9999],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: containment,
    },
    Family {
        id: "identical",
        name: "The same object twice",
        sentence: "An object in its own place, as it is and after a quarter turn: everything touches everything.",
        source: "Guigue-Devillers and libccd call some of them apart.",
        parameter: Parameter {
            name: "triangles",
            steps: &[8.0, 32.0, 128.0, 512.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: identical,
    },
];

fn many_contacts(draw: &mut Draw, blades: f64) -> Made {
    let n = blades as usize;
    let comb = comb(n, 1.0 / blades).mesh()?;
    let quarter = Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0);
    let lift = Vector3::new(0.3 / blades, draw.between(0.1, 0.6), 1.0 - 0.4 / blades);
    Ok(vec![Posed::new(&comb, &comb, Pose { linear: quarter, translation: lift }).into()])
}

fn deep(draw: &mut Draw, apart: f64) -> Made {
    let ball = ball(3).mesh()?;
    let ask = |_| -> Question {
        let pose = Pose { linear: draw.rotation(), translation: draw.direction() * apart };
        Posed::new(&ball, &ball, pose).into()
    };
    Ok((0..2).map(ask).collect())
}

fn containment(draw: &mut Draw, ratio: f64) -> Made {
    let outer = cuboid(Vector3::repeat(1.0)).mesh()?;
    let inner = cuboid(Vector3::repeat(ratio)).mesh()?;
    let aside = draw.direction() * 0.2 * (1.0 - ratio);
    let posed = Posed::new(&outer, &inner, Pose { linear: Matrix3::identity(), translation: aside });
    let solid = Question { solid: true, ..posed.clone().into() };
    Ok(vec![posed.into(), solid])
}

fn identical(draw: &mut Draw, triangles: f64) -> Made {
    let object = ball((libm::log2(triangles / 8.0) / 2.0).round() as u32).mesh()?;
    let quarter = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let turn = draw.rotation();
    let together = |linear: Matrix3<f64>| {
        let mut posed = Posed::new(&object, &object, Pose { linear, translation: Vector3::zeros() });
        if linear == turn {
            posed.configuration.pose_a.linear = turn;
        }
        posed
    };
    Ok([Matrix3::identity(), quarter, turn].map(|linear| together(linear).into()).to_vec())
}
