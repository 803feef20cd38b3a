//! The two objects: a dented ball of 32 triangles, and a corner of four. Small, so that a question costs an honest
//! algorithm little beside the work of its class, and large enough for a set in which no two questions are alike.

use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Names of the files.
pub const FILES: [&str; 2] = ["ball.obj", "corner.obj"];

/// Writes both.
pub fn write(folder: &Path) {
    let (corners, triangles) = ball();
    let corner = [[0.0, 0.0, 0.0], [0.7, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 0.5]];
    let texts = [obj(&corners, &triangles), obj(&corner, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])];
    for (name, text) in FILES.iter().zip(texts) {
        fs::write(folder.join(name), text).expect("an object's file");
    }
}

type Point = [f64; 3];

fn obj(points: &[Point], triangles: &[[usize; 3]]) -> String {
    let mut text = String::new();
    for [x, y, z] in points {
        writeln!(text, "v {x} {y} {z}").expect("text");
    }
    for [a, b, c] in triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("text");
    }
    text
}

/// An octahedron whose triangles are cut in four, the new corners lifted onto the sphere; then pressed flat and sheared.
fn ball() -> (Vec<Point>, Vec<[usize; 3]>) {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let minus = |p: Point| p.map(|c| -c);
    let mut points = vec![x, minus(x), y, minus(y), z, minus(z)];
    let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mut between = |i: usize, j: usize| {
        let sum: Point = std::array::from_fn(|c| points[i][c] + points[j][c]);
        let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        let lifted = sum.map(|c| c / length);
        points.iter().position(|p| *p == lifted).unwrap_or_else(|| {
            points.push(lifted);
            points.len() - 1
        })
    };
    let mut triangles = Vec::new();
    for [a, b, c] in faces {
        let (d, e, f) = (between(a, b), between(b, c), between(c, a));
        triangles.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
    }
    (points.iter().map(|[x, y, z]| [*x, 0.8 * y, 0.7 * z + 0.1 * x]).collect(), triangles)
}
