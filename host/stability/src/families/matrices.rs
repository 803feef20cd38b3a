//! Matrices that are no rotations. The plugin interface promises rotations, so a wrong answer here is no fault; a crash is.

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;

use crate::draw::Draw;
use crate::shapes::{ball, cuboid};
use crate::{Family, Harder, Made, Parameter, Posed, Question, Rule};

pub const FAMILIES: [Family; 3] = [
    Family {
        id: "affine",
        name: "Stretched and mirrored",
        sentence: "The matrix differs from a rotation by this much: (1 - x) R, a shear, one and a half times R, a mirror image.",
        source: "Boxes in a hierarchy are often turned back with the transposed matrix.",
        parameter: Parameter {
            name: "difference from a rotation",
            steps: &[1e-6, 1e-3, 0.5, 2.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: true,
        all_contacts: false,
        make: affine,
    },
    Family {
        id: "drift",
        name: "Drifted rotation",
        sentence: "A rotation with this error in its entries, as many small steps leave it; the answer may be off by four \
                   times as much.",
        source: "FCL pull request 371.",
        parameter: Parameter {
            name: "error of an entry",
            steps: &[1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4],
            harder: Harder::Up,
            continuous: true,
        },
        beyond: true,
        all_contacts: false,
        make: drift,
    },
    Family {
        id: "not-a-number",
        name: "NaN and infinity",
        sentence: "Between two ordinary questions, a matrix with NaN (1) or an infinite translation (2), of which any answer \
                   is allowed; objects with NaN (3) are refused by the host.",
        source: "FCL and Coal answer \"collision, distance 0\"; ifc-lite pull request 3561.",
        parameter: Parameter { name: "kind", steps: &[1.0, 2.0, 3.0], harder: Harder::Up, continuous: false },
        beyond: true,
        all_contacts: false,
        make: not_a_number,
    },
];

/// Apart, close and in each other.
const DISTANCES: [f64; 3] = [2.5, 1.8, 0.8];

fn affine(draw: &mut Draw, difference: f64) -> Made {
    let (a, b) = (cuboid(Vector3::repeat(0.5)).mesh()?, ball(2).mesh()?);
    let map = match difference {
        x if x < 1e-4 => Matrix3::identity() * (1.0 - x),
        x if x < 0.1 => Matrix3::new(1.0, x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        x if x < 1.0 => Matrix3::identity() * (1.0 + x),
        _ => Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0)),
    };
    let ask = |distance: f64| -> Question {
        let pose = Pose { linear: draw.rotation() * map, translation: draw.direction() * distance };
        Posed::new(&a, &b, pose).into()
    };
    Ok(DISTANCES.map(ask).to_vec())
}

fn drift(draw: &mut Draw, error: f64) -> Made {
    let (a, b) = (cuboid(Vector3::repeat(0.5)).mesh()?, ball(2).mesh()?);
    let ask = |distance: f64| {
        let translation = draw.direction() * distance;
        let linear = draw.rotation() + Matrix3::from_fn(|_, _| draw.between(-error, error));
        let norm = 3.0 * error;
        let posed = Posed::new(&a, &b, Pose { linear, translation });
        Question { rule: Rule::Within(4.0 * norm * (1.5 + distance)), ..posed.into() }
    };
    Ok(DISTANCES.map(ask).to_vec())
}

fn not_a_number(draw: &mut Draw, kind: f64) -> Made {
    let (mut object, b) = (ball(2), cuboid(Vector3::repeat(0.5)).mesh()?);
    if kind == 3.0 {
        let at = draw.below(object.positions.len());
        object.positions[at].y = f64::NAN;
    }
    let a = object.mesh()?;
    let usual = Posed::new(&a, &b, Pose { linear: draw.rotation(), translation: draw.direction() * 2.0 });
    let mut strange = usual.clone();
    match kind {
        1.0 => strange.configuration.pose_b.linear[(0, 0)] = f64::NAN,
        _ => strange.configuration.pose_b.translation.x = f64::INFINITY,
    }
    let strange = Question { rule: Rule::Lasting, ..strange.into() };
    let again = Question { same_as: Some(0), ..usual.clone().into() };
    Ok(vec![usual.into(), strange, again])
}
