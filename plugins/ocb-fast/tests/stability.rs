//! Pairs of small objects with exact answers: inputs that broke other libraries, and families of degenerate ones.

use ocb_fast::{Fast, Object};
use opencollbench_plugin::{Algorithm, Collision, Distance, Mesh, Placed, Pose, Uncounted};

#[path = "../../common/tests/support/mod.rs"]
mod support;

/// A number in C99's hexadecimal notation.
fn number(word: &str) -> f64 {
    let (sign, digits) = word.strip_prefix('-').map_or((1.0, word), |rest| (-1.0, rest));
    let Some((mantissa, exponent)) = digits.strip_prefix("0x").and_then(|rest| rest.split_once('p')) else {
        return word.parse().expect("a number");
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hexadecimal digits");
    let exponent: i32 = exponent.parse().expect("an exponent");
    sign * digits as f64 * 2f64.powi(-4 * fraction.len() as i32) * 2f64.powi(exponent)
}

fn load(fast: &mut Fast, coordinates: &[f64]) -> Object {
    let positions = coordinates.as_chunks::<3>().0;
    let triangles: Vec<[u32; 3]> = (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    fast.load_mesh(Mesh { positions, triangles: &triangles }).expect("the mesh loads")
}

/// Answers within the project's tolerance: 32 roundings at the size of the scene.
fn check(name: &str, a: &[f64], b: &[f64], pose: &Pose, [hit, distance, margin, size]: [f64; 4]) {
    let mut fast = Fast::default();
    let (a, b) = (load(&mut fast, a), load(&mut fast, b));
    let tau = 32.0 * f64::EPSILON / 2.0 * 3.0 * size;
    let places = |a, b| (Placed { object: a, pose: &Pose::IDENTITY }, Placed { object: b, pose });
    let (of_a, of_b) = places(&a, &b);
    let found = fast.collide(of_a, of_b, &mut Uncounted).expect("an answer") != Collision::Apart;
    assert!(!found || distance <= tau, "{name}: a collision at distance {distance:e}");
    assert!(found || hit == 0.0 || margin <= tau, "{name}: missed with margin {margin:e}");
    let near = fast.distance(of_a, of_b, &mut Uncounted).expect("an answer").distance;
    assert!((near - distance).abs() <= tau, "{name}: {near:e} instead of {distance:e}");
}

fn lines(file: &str) -> Vec<String> {
    let bytes = support::shared_file("stability", file);
    String::from_utf8(bytes).expect("text").lines().map(str::to_owned).collect()
}

#[test]
fn pairs() {
    let lines = lines("pairs.txt");
    assert_eq!(lines.len(), 1092);
    for line in lines {
        let (left, right) = line.split_once('|').expect("the truth after a bar");
        let words: Vec<&str> = left.split_whitespace().collect();
        let numbers: Vec<f64> = words[4..].iter().map(|word| number(word)).collect();
        let truth: Vec<f64> = right.split_whitespace().map(number).collect();
        let (a, b) = numbers.split_at(9 * words[2].parse::<usize>().expect("a count"));
        check(words[0], a, b, &Pose::IDENTITY, [truth[0], truth[1], truth[2], truth[3]]);
    }
}
