//! Solid bodies: what lies inside collides.

use ocb_brute_force::BruteForce;
use opencollbench_plugin::{Algorithm, Mesh, Placed, Pose, Refusal, Uncounted};

type Body = <BruteForce as Algorithm>::Object;

/// Cubes (centre x, half side) as one mesh.
fn cubes(all: &[(f64, f64)]) -> Body {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for &(x, half) in all {
        let first = positions.len() as u32;
        for i in 0..8 {
            let at = |bit: u32| if i >> bit & 1 == 1 { half } else { -half };
            positions.push([x + at(0), at(1), at(2)]);
        }
        for [a, b, c, d] in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
            triangles.extend([[a, b, c], [a, c, d]].map(|t: [u32; 3]| t.map(|corner| corner + first)));
        }
    }
    BruteForce.load_mesh(Mesh { positions: &positions, triangles: &triangles }).expect("a body")
}

fn inside(a: &Body, b: &Body) -> Result<bool, Refusal> {
    let pose = Pose::IDENTITY;
    BruteForce.inside(Placed { object: a, pose: &pose }, Placed { object: b, pose: &pose }, &mut Uncounted)
}

#[test]
fn inside_outside_and_in_a_cavity() {
    let (whole, grain) = (cubes(&[(0.0, 1.0)]), cubes(&[(0.1, 0.25)]));
    assert_eq!(inside(&whole, &grain), Ok(true));
    assert_eq!(inside(&grain, &whole), Ok(true));
    assert_eq!(inside(&whole, &cubes(&[(3.0, 0.25)])), Ok(false));
    let hollow = cubes(&[(0.0, 1.0), (0.0, 0.5)]);
    assert_eq!(inside(&hollow, &grain), Ok(false));
    assert_eq!(inside(&hollow, &cubes(&[(0.75, 0.125)])), Ok(true));
    // The second part of one in the only part of the other.
    assert_eq!(inside(&cubes(&[(9.0, 1.0), (0.0, 0.5)]), &whole), Ok(true));
}
