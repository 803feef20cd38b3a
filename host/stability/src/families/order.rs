//! The order of the questions: what an answer must not depend on.

use nalgebra::Vector3;
use ocb_core::pose::Pose;

use crate::draw::Draw;
use crate::shapes::{ball, cuboid};
use crate::{Family, Harder, Made, Parameter, Posed, Question};

pub const FAMILIES: [Family; 2] = [
    Family {
        id: "coherence",
        name: "Jumps along a path",
        sentence: "Poses along a path in steps of this length, then the same ones shuffled: the answers are the same.",
        source: "Coal issue 379, box2d issue 734.",
        parameter: Parameter { name: "step", steps: &[0.001, 0.01, 0.1, 1.0], harder: Harder::Up, continuous: false },
        beyond: false,
        all_contacts: false,
        make: coherence,
    },
    Family {
        id: "determinism",
        name: "Asked again",
        sentence: "The same question with so many others in between: the same answer to the last bit.",
        source: "rapier issue 868, manifold issue 1275.",
        parameter: Parameter {
            name: "questions in between",
            steps: &[1.0, 10.0, 100.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: determinism,
    },
];

/// Poses on the path.
const LENGTH: usize = 12;

fn coherence(draw: &mut Draw, step: f64) -> Made {
    let (a, b) = (cuboid(Vector3::repeat(0.75)).mesh()?, ball(2).mesh()?);
    let (turn, from, along) = (draw.rotation(), draw.direction() * 1.6, draw.direction() * step);
    let posed = |i: usize| Posed::new(&a, &b, Pose { linear: turn, translation: from + along * i as f64 });
    let mut questions: Vec<Question> = (0..LENGTH).map(|i| posed(i).into()).collect();
    let mut order: Vec<usize> = (0..LENGTH).collect();
    draw.shuffle(&mut order);
    questions.extend(order.iter().map(|&i| Question { same_as: Some(i), ..posed(i).into() }));
    Ok(questions)
}

fn determinism(draw: &mut Draw, between: f64) -> Made {
    let (a, b) = (cuboid(Vector3::repeat(0.75)).mesh()?, ball(2).mesh()?);
    let mut any = || {
        let pose = Pose { linear: draw.rotation(), translation: draw.direction() * draw.between(1.0, 2.5) };
        Posed::new(&a, &b, pose)
    };
    let first = any();
    let mut questions = vec![Question::from(first.clone())];
    questions.extend((0..between as usize).map(|_| Question::from(any())));
    questions.push(Question { same_as: Some(0), ..first.into() });
    Ok(questions)
}
