//! A corner before a face, an edge before an edge: by how little may they miss each other, or meet?

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::pose::Pose;

use super::DECADES;
use crate::draw::Draw;
use crate::shapes::{Point, Triangle, normal, single};
use crate::{Family, Harder, Made, Parameter, Posed};

const GAP: Parameter = Parameter { name: "gap", steps: DECADES, harder: Harder::Down, continuous: true };

pub const FAMILIES: [Family; 3] = [
    Family {
        id: "vertex-face",
        name: "Corner before a face",
        sentence: "A corner of one triangle stands before the face of another, or reaches through it, by the gap.",
        source: "Wrong in Coal, libccd and parry below 1e-6 to 1e-9.",
        parameter: GAP,
        beyond: false,
        all_contacts: false,
        make: vertex_face,
    },
    Family {
        id: "edge-edge",
        name: "Edge before an edge",
        sentence: "An edge passes an edge, or cuts through it, by the gap.",
        source: "Wrong in Coal and parry below 1e-7.",
        parameter: GAP,
        beyond: false,
        all_contacts: false,
        make: edge_edge,
    },
    Family {
        id: "exact-touch",
        name: "Exact touch",
        sentence: "A corner lies exactly on a face, an edge or a corner of a grid that gets finer; any answer is allowed, \
                   and it must come.",
        source: "CGAL issue 2319, libccd issue 68.",
        parameter: Parameter {
            name: "grid spacing",
            steps: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0],
            harder: Harder::Down,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: exact_touch,
    },
];

/// A point of the triangle, well inside.
pub fn inside(draw: &mut Draw, t: &Triangle) -> Point {
    let weights = Vector3::from_fn(|_, _| draw.between(0.2, 1.0));
    Point::from((t[0].coords * weights.x + t[1].coords * weights.y + t[2].coords * weights.z) / weights.sum())
}

/// A rotation that puts the first corner of `t` at the end of the triangle against `up`.
pub fn tip_down(draw: &mut Draw, t: &Triangle, up: &Vector3<f64>) -> Matrix3<f64> {
    loop {
        let turn = draw.rotation();
        if t[1..].iter().all(|p| up.dot(&(turn * (p - t[0]))) > 0.3 * (p - t[0]).norm()) {
            return turn;
        }
    }
}

fn vertex_face(draw: &mut Draw, gap: f64) -> Made {
    let (a, b) = (draw.triangle(), draw.triangle());
    let up = normal(&a);
    let (turn, foot) = (tip_down(draw, &b, &up), inside(draw, &a));
    let (mesh_a, mesh_b) = (single(a)?, single(b)?);
    let at = |height: f64| Pose { linear: turn, translation: foot.coords + up * height - turn * b[0].coords };
    Ok([gap, -gap].map(|height| Posed::new(&mesh_a, &mesh_b, at(height)).into()).to_vec())
}

fn edge_edge(draw: &mut Draw, gap: f64) -> Made {
    // Both have the edge along their own first axis, with the origin on it, and the third corner to one side.
    let mut edge = || {
        let (left, top) = (draw.between(0.3, 0.7), draw.between(-0.3, 0.3));
        [[-left, 0.0], [1.0 - left, 0.0], [top, 0.9]].map(|[x, y]| Point3::new(x, y, 0.0).map(|x| f64::from(x as f32)))
    };
    let (mesh_a, mesh_b) = (single(edge())?, single(edge())?);
    let common = draw.rotation();
    let angle = draw.between(0.5, 2.6);
    let (sine, cosine) = libm::sincos(angle);
    // A hangs below its edge, B stands on its own, turned about the line between.
    let below = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0);
    let above = Matrix3::new(cosine, 0.0, sine, sine, 0.0, -cosine, 0.0, 1.0, 0.0);
    let posed = |height: f64| {
        let mut posed = Posed::new(&mesh_a, &mesh_b, Pose::identity());
        posed.configuration.pose_a = Pose { linear: common * below, translation: Vector3::zeros() };
        posed.configuration.pose_b =
            Pose { linear: common * above, translation: common * Vector3::new(0.0, 0.0, height) };
        posed
    };
    Ok([gap, -gap].map(|height| posed(height).into()).to_vec())
}

fn exact_touch(draw: &mut Draw, spacing: f64) -> Made {
    // A power of two near the spacing, so that every sum is exact.
    let grid = 2f64.powi(libm::log2(spacing).round() as i32);
    let a = single([Point::new(0.0, 0.0, 0.0), Point::new(4.0, 0.0, 0.0), Point::new(0.0, 4.0, 0.0)])?;
    let (left, height) = (draw.below(3) as f64 - 1.0, 1.0 + draw.below(2) as f64);
    let b = single([Point::origin(), Point::new(left, 1.0, height), Point::new(1.0, -left, height + 1.0)])?;
    let places = [(1.0 + grid, 1.0), (1.0 + grid, 0.0), (0.0, 0.0)];
    let still = |(x, y)| Pose { linear: Matrix3::identity(), translation: Vector3::new(x, y, 0.0) };
    Ok(places.map(|place| Posed::new(&a, &b, still(place)).into()).to_vec())
}
