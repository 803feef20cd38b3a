//! Numbers: another unit of length, far from the origin, a speck beside a mountain, the ends of the exponent.

use nalgebra::{Matrix3, Vector3};
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;

use super::near::{inside, tip_down};
use crate::draw::Draw;
use crate::shapes::{Soup, normal};
use crate::{Family, Harder, Made, Parameter, Posed, Question};

pub const FAMILIES: [Family; 4] = [
    Family {
        id: "units",
        name: "Another unit of length",
        sentence: "The same scene, multiplied by a power of two, which rounds nothing.",
        source: "PQP, FCL, Coal, parry, openGJK and libccd have lengths in them that do not scale.",
        parameter: Parameter {
            name: "scale, power of two",
            steps: &[-40.0, -30.0, -20.0, -15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0, 30.0, 40.0],
            harder: Harder::Outward,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: |draw, k| scaled(draw, 2f64.powi(k as i32), 1.0),
    },
    Family {
        id: "offset",
        name: "Far from the origin",
        sentence: "Both objects stand so far from the origin; half of the way is in their coordinates, half in their poses.",
        source: "openGJK issue 52, mujoco_warp pull request 1613, Bullet issue 2157.",
        parameter: Parameter {
            name: "offset",
            steps: &[1.0, 16.0, 256.0, 4096.0, 65536.0, 1048576.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: offset,
    },
    Family {
        id: "size-ratio",
        name: "Speck and mountain",
        sentence: "A is so many times as large as B.",
        source: "libccd issue 17, mujoco_warp pull request 1430, parry in f32.",
        parameter: Parameter {
            name: "size of A / size of B",
            steps: &[1.0, 16.0, 256.0, 4096.0, 65536.0, 1048576.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: |draw, ratio| scaled(draw, 1.0, ratio),
    },
    Family {
        id: "exponents",
        name: "Ends of the exponent",
        sentence: "Coordinates whose squares are too small or too large for a number; beyond 1e18 the host refuses them.",
        source: "FCL and Coal answer the largest number, or 0.",
        parameter: Parameter {
            name: "scale, power of ten",
            steps: &[-300.0, -200.0, -150.0, -60.0, -30.0, 0.0, 9.0, 15.0, 17.0, 300.0],
            harder: Harder::Outward,
            continuous: false,
        },
        beyond: true,
        all_contacts: false,
        make: |draw, k| {
            // The nearest power of two, exactly.
            scaled(draw, 2f64.powi((k * std::f64::consts::LOG2_10).round() as i32), 1.0)
        },
    },
];

/// Before a face, through it, and well apart; everything times `unit`, A times `ratio` as well.
fn scaled(draw: &mut Draw, unit: f64, ratio: f64) -> Made {
    let (a, b) = (draw.triangle(), draw.triangle());
    let up = normal(&a);
    let (turn, foot) = (tip_down(draw, &b, &up), inside(draw, &a));
    let mesh = |corners: [nalgebra::Point3<f64>; 3], factor: f64| Soup::of(&[corners]).map(|p| p * factor).exact();
    let (mesh_a, mesh_b) = (mesh(a, unit * ratio)?, mesh(b, unit)?);
    let aside = draw.direction() * draw.between(3.0, 5.0);
    let over = |height: f64| foot.coords * ratio + up * height - turn * b[0].coords;
    let places = [over(1e-3), over(0.25), over(-0.25), over(1.0) + aside];
    let ask = |place: Vector3<f64>| -> Question {
        Posed::new(&mesh_a, &mesh_b, Pose { linear: turn, translation: place * unit }).into()
    };
    Ok(places.map(ask).to_vec())
}

fn offset(draw: &mut Draw, by: f64) -> Made {
    // On a grid of eighths, so that the shifted coordinates are numbers of single precision.
    let mut corners = || draw.triangle().map(|p| p.map(|x| (x * 8.0).round() / 8.0));
    let (mut a, mut b) = (corners(), corners());
    while Mesh::new(a.to_vec(), vec![[0, 1, 2]]).is_err() || Mesh::new(b.to_vec(), vec![[0, 1, 2]]).is_err() {
        (a, b) = (corners(), corners());
    }
    let far = Vector3::repeat(by);
    let shifted = |t: [nalgebra::Point3<f64>; 3]| Soup::of(&[t]).map(|p| p + far).exact();
    let (mesh_a, mesh_b) = (shifted(a)?, shifted(b)?);
    let up = normal(&a);
    let foot = inside(draw, &a);
    let ask = |height: f64| -> Question {
        let lift = foot.coords + up * height - b[0].coords;
        let mut posed = Posed::new(&mesh_a, &mesh_b, Pose { linear: Matrix3::identity(), translation: far + lift });
        posed.configuration.pose_a.translation = far;
        posed.into()
    };
    Ok([2.5, 0.25, -0.25].map(ask).to_vec())
}
