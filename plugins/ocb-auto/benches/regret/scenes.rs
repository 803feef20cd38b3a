//! A mixed set of scenes: objects of many shapes, sizes and numbers of triangles, far apart, close, touching and deep in
//! each other.

use ocb_wide::{Wide, fast};
use opencollbench_plugin::Pose;

use super::support::{Dice, Loaded, Soup, TRANSLATION, known_mesh};

/// Two objects in many poses of B.
pub struct Setting {
    /// Names of both objects.
    pub objects: [&'static str; 2],
    pub a: Soup,
    pub b: Soup,
    pub poses: Vec<Pose>,
}

/// Names of both objects, and B's size in its own unit.
const PAIRS: [(&str, &str, f64); 16] = [
    ("bunny16k", "bunny16k", 1.0),
    ("dragon16k", "knot16k", 1.0),
    ("knot16k", "teapot", 0.7),
    ("teapot", "homer", 1.0),
    ("fandisk", "rocker-arm", 1.0),
    ("homer", "fandisk", 0.3),
    ("fcl_env", "fcl_rob", 0.5),
    ("bunny1k", "dragon1k", 1.0),
    ("dragon16k", "bunny1k", 0.05),
    ("knot16k", "dragon1k", 0.05),
    ("fandisk", "homer", 0.1),
    ("teapot", "rocker-arm", 0.1),
    ("rocker-arm", "cube", 0.2),
    ("homer", "torus", 0.1),
    ("torus", "torus", 1.0),
    ("cube", "cube", 1.0),
];

/// Distances, in the sum of the radii. What is below 0 is how far B is moved on from the first contact.
const GAPS: [f64; 8] = [1.0, 0.3, 0.1, 1e-2, 1e-4, -1e-3, -3e-2, -0.3];

/// Poses for each gap.
const POSES: usize = 12;

/// An object of length 1 across.
fn object(name: &str) -> Soup {
    match name {
        "cube" => cube(),
        "torus" => Soup::torus(16, 8).moved(0.35, 0.0),
        _ => known_mesh(name),
    }
}

fn cube() -> Soup {
    let corner = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.29 } else { -0.29 });
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Soup { positions: (0..8).map(corner).collect(), triangles }
}

/// All of them.
pub fn settings() -> Vec<Setting> {
    let of_pair = |&(a, b, size): &(&'static str, &'static str, f64)| {
        let (soup_a, soup_b) = (object(a), object(b).moved(size, 0.0));
        let poses = poses(&soup_a, &soup_b, 0.5 + 0.5 * size);
        Setting { objects: [a, b], a: soup_a, b: soup_b, poses }
    };
    PAIRS.iter().map(of_pair).collect()
}

/// Random rotations and directions; along the line to the middle of A as far as it must be.
fn poses(a: &Soup, b: &Soup, radii: f64) -> Vec<Pose> {
    let mut loaded = Loaded::two(Wide::<fast::Fast>::default(), a, b);
    let mut dice = Dice(17);
    let mut poses = Vec::new();
    for gap in GAPS {
        for _ in 0..POSES {
            let start = dice.pose(3.0 * radii);
            let at = |way: f64| {
                let mut pose = start;
                TRANSLATION.iter().for_each(|&axis| pose.0[axis] *= 1.0 - way / (3.0 * radii));
                pose
            };
            let mut way = 0.0;
            while way < 3.0 * radii {
                let left = loaded.distance(&Pose::IDENTITY, &at(way)).distance - gap.max(1e-4) * radii;
                if left <= 1e-3 * gap.abs() * radii {
                    break;
                }
                way += left;
            }
            let pose = at((way - gap.min(0.0) * radii).min(3.0 * radii));
            poses.push(pose);
        }
    }
    poses
}
