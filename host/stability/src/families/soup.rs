//! What holds an object together: nothing must be relied on, for a mesh is any set of triangles.

use nalgebra::{Matrix3, Vector3};
use ocb_core::mesh::{Mesh, MeshError};
use ocb_core::pose::Pose;

use crate::draw::Draw;
use crate::shapes::{Soup, Triangle, ball, cuboid, single};
use crate::{Family, Harder, Made, Parameter, Posed, Question};

pub const FAMILIES: [Family; 6] = [
    Family {
        id: "broken-mesh",
        name: "Broken mesh",
        sentence: "A ball of which this share of the faces is missing, turned inside out or cut loose from its neighbours.",
        source: "PhysX issue 289, Jolt pull request 1879.",
        parameter: Parameter {
            name: "share",
            steps: &[0.0, 0.1, 0.3, 0.6, 0.9],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: broken,
    },
    Family {
        id: "smallest",
        name: "Hardly a mesh",
        sentence: "Two triangles, one, and none, which the host refuses.",
        source: "python-fcl ends the process, Coal raises an error.",
        parameter: Parameter { name: "triangles", steps: &[0.0, 1.0, 2.0], harder: Harder::Down, continuous: false },
        beyond: false,
        all_contacts: false,
        make: smallest,
    },
    Family {
        id: "index",
        name: "Index out of range",
        sentence: "A triangle names a vertex so far behind the last one; the host refuses it, so no method sees it.",
        source: "python-fcl ends the process.",
        parameter: Parameter {
            name: "vertices too far",
            steps: &[1.0, 1e3, 1e6],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: index,
    },
    Family {
        id: "retriangulation",
        name: "Cut more finely",
        sentence: "A box whose flat sides are cut into more and more triangles: the same surface, so the same answers.",
        source: "libigl issue 2381.",
        parameter: Parameter {
            name: "triangles",
            steps: &[12.0, 48.0, 192.0, 768.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: retriangulation,
    },
    Family {
        id: "jitter",
        name: "Shaken vertices",
        sentence: "Every vertex of a box on a box is moved by up to this length.",
        source: "What a pipeline of programs does to coordinates.",
        parameter: Parameter {
            name: "length",
            steps: &[1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4],
            harder: Harder::Up,
            continuous: true,
        },
        beyond: false,
        all_contacts: false,
        make: jitter,
    },
    Family {
        id: "split-planes",
        name: "On the split plane",
        sentence: "So many triangles with one common centroid, on which every rule to divide them fails.",
        source: "three-mesh-bvh issue 465, parry issue 107, bvh issue 119.",
        parameter: Parameter {
            name: "triangles",
            steps: &[3.0, 5.0, 9.0, 17.0, 33.0, 65.0, 129.0],
            harder: Harder::Up,
            continuous: false,
        },
        beyond: false,
        all_contacts: false,
        make: split_planes,
    },
];

/// Over, through, and apart, turned any way.
fn around(draw: &mut Draw, a: &std::sync::Arc<Mesh>, b: &std::sync::Arc<Mesh>, distances: &[f64]) -> Vec<Question> {
    let ask = |&distance: &f64| {
        let pose = Pose { linear: draw.rotation(), translation: draw.direction() * distance };
        Posed::new(a, b, pose).into()
    };
    distances.iter().map(ask).collect()
}

fn broken(draw: &mut Draw, share: f64) -> Made {
    let whole = ball(2);
    let corners = |t: &[u32; 3]| t.map(|i| whole.positions[i as usize]);
    let kept = whole.triangles.iter().filter_map(|t| {
        let [p, q, r] = corners(t);
        match (draw.unit() < share, draw.below(3)) {
            (false, _) => Some([p, q, r]),
            (true, 0) => None,
            (true, 1) => Some([q, p, r]),
            // A hair of its own way.
            (true, _) => Some([p, q, r].map(|p| p * 1.001)),
        }
    });
    let (a, b) = (Soup::of(&kept.collect::<Vec<_>>()).mesh()?, ball(1).mesh()?);
    Ok(around(draw, &a, &b, &[0.5, 1.2, 2.1, 3.0]))
}

fn smallest(draw: &mut Draw, triangles: f64) -> Made {
    let some: Vec<Triangle> = (0..triangles as usize).map(|_| draw.triangle()).collect();
    let (a, b) = (Soup::of(&some).mesh()?, single(draw.triangle())?);
    Ok(around(draw, &a, &b, &[0.1, 3.0, 6.0]))
}

fn index(draw: &mut Draw, too_far: f64) -> Made {
    let mut soup = ball(0);
    let last = soup.positions.len() as u32;
    let at = draw.below(soup.triangles.len());
    soup.triangles[at][draw.below(3)] = last + too_far as u32 - 1;
    let refused: Result<_, MeshError> = soup.mesh();
    Ok(around(draw, &refused?, &ball(0).mesh()?, &[3.0]))
}

fn retriangulation(draw: &mut Draw, triangles: f64) -> Made {
    let mut soup = cuboid(Vector3::new(0.5, 0.75, 1.0));
    while soup.triangles.len() < triangles as usize {
        soup = soup.subdivided();
    }
    let (a, b) = (soup.mesh()?, cuboid(Vector3::repeat(0.5)).mesh()?);
    let mut questions = around(draw, &a, &b, &[0.3, 1.2, 2.5]);
    // Flat on a side, where the cuts run.
    let on = Vector3::new(1.0 + 1e-4, 0.125, 0.25);
    questions.push(Posed::new(&a, &b, Pose { linear: Matrix3::identity(), translation: on }).into());
    Ok(questions)
}

fn jitter(draw: &mut Draw, length: f64) -> Made {
    let mut shaken = || cuboid(Vector3::repeat(0.5)).map(|p| p + draw.vector() * length).exact();
    let (a, b) = (shaken()?, shaken()?);
    let on = |gap: f64| Pose { linear: Matrix3::identity(), translation: Vector3::new(0.1, -0.2, 1.0 + gap) };
    Ok([1e-3, -1e-3].map(|gap| Posed::new(&a, &b, on(gap)).into()).to_vec())
}

fn split_planes(draw: &mut Draw, triangles: f64) -> Made {
    // Three corners that add up to nothing, whatever the turn.
    let one = |_| {
        let (p, q) = (draw.triangle()[0].coords, draw.triangle()[1].coords);
        [p, q, -(p + q)].map(nalgebra::Point3::from)
    };
    let fan: Vec<Triangle> = (0..triangles as usize).map(one).collect();
    let (a, b) = (Soup::of(&fan).mesh()?, single(draw.triangle())?);
    Ok(around(draw, &a, &b, &[0.1, 1.5, 4.0]))
}
