//! What bounding volumes tell apart is apart: against all pairs of triangles, in the very numbers that exact leaves compare,
//! at extreme sizes, ratios and places, where the objects touch in a point or nearly so.

use ocb_triangles::Triangle;
use opencollbench_plugin::{Collision, Contacts, Distance, Pose};

use super::algorithm::{Terms, agree};
use super::{Dice, Loaded, Scene, Soup, TRANSLATION, apply, shared_file};

/// Distances of a corner from the middle of a triangle, in the smaller object's size.
const GAPS: [f64; 11] = [0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-2, 1.0];

/// Small triangles in a cube of side 2, some of them slivers.
fn scattered(dice: &mut Dice) -> Vec<Triangle> {
    let count = dice.pick(1, 24);
    let mut signed = |size: f64| size * (2.0 * dice.roll() - 1.0);
    let triangles = (0..count).map(|_| {
        let at: [f64; 3] = [signed(1.0), signed(1.0), signed(1.0)];
        let thin = [1.0, 1.0, 1e-3, 1e-7][(signed(2.0) + 2.0) as usize % 4];
        let mut corner = |size: f64| at.map(|x| x + signed(0.3 * size));
        [at, corner(1.0), corner(thin)]
    });
    triangles.collect()
}

/// A corner of B comes to the middle of a triangle of A, or nearly so.
fn touching<'s>(dice: &mut Dice, a: &'s Soup, b: &'s Soup, gap: f64) -> Scene<'s> {
    let mut scene = Scene { a, b, pose_a: dice.pose(a.size()), pose_b: dice.pose(0.0) };
    let target = a.view().corners(dice.pick(0, a.triangles.len() as i32) as usize);
    let target = apply(&scene.pose_a, std::array::from_fn(|k| (target[0][k] + target[1][k] + target[2][k]) / 3.0));
    let corner = apply(&scene.pose_b, b.view().corners(dice.pick(0, b.triangles.len() as i32) as usize)[0]);
    for (k, axis) in TRANSLATION.into_iter().enumerate() {
        scene.pose_b.0[axis] = target[k] - corner[k] + gap;
    }
    scene
}

pub fn tells_nothing_apart_that_meets<A: Distance + Contacts>(terms: &Terms<A>) {
    let mut dice = Dice(31);
    for case in 0..600 {
        // Each object in its own unit, and away from its origin by up to ten times its size.
        let size_a = 2f64.powi(dice.pick(-60, 60));
        let size_b = size_a * 2f64.powi(dice.pick(-30, 30));
        let [a, b] = [size_a, size_b].map(|size| {
            let offset = size * f64::from(dice.pick(-3, 12).max(0));
            Soup::of(&scattered(&mut dice)).moved(size, offset)
        });
        let sign = [1.0, -1.0][dice.pick(0, 2) as usize];
        let scene = touching(&mut dice, &a, &b, sign * GAPS[case % GAPS.len()] * size_a.min(size_b));
        for scene in [scene, scene.swapped()] {
            let truth = scene.truth();
            for algorithm in (terms.variants)() {
                agree(terms, &mut Loaded::two(algorithm, scene.a, scene.b), &scene, &truth);
            }
        }
    }
}

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

/// Pairs of small objects with exact answers: inputs that broke other libraries, and families of degenerate ones.
pub fn on_pairs_that_broke_others<A: Distance + Contacts>(terms: &Terms<A>) {
    let text = String::from_utf8(shared_file("stability", "pairs.txt")).expect("text");
    assert_eq!(text.lines().count(), 1092);
    for line in text.lines() {
        let (left, right) = line.split_once('|').expect("the truth after a bar");
        let words: Vec<&str> = left.split_whitespace().collect();
        let name = words[0];
        let numbers: Vec<f64> = words[4..].iter().map(|word| number(word)).collect();
        let truth: Vec<f64> = right.split_whitespace().map(number).collect();
        let [hit, distance, margin, size] = [truth[0], truth[1], truth[2], truth[3]];
        let corners = numbers.as_chunks::<3>().0.as_chunks::<3>().0;
        let (a, b) = corners.split_at(words[2].parse::<usize>().expect("a count"));
        let tau = 32.0 * f64::EPSILON / 2.0 * 3.0 * size;
        for algorithm in (terms.variants)() {
            let mut loaded = Loaded::two(algorithm, &Soup::of(a), &Soup::of(b));
            let found = loaded.collide(&Pose::IDENTITY, &Pose::IDENTITY) != Collision::Apart;
            assert!(!found || distance <= tau, "{name}: a collision at distance {distance:e}");
            assert!(found || hit == 0.0 || margin <= tau, "{name}: missed with margin {margin:e}");
            let near = loaded.distance(&Pose::IDENTITY, &Pose::IDENTITY).distance;
            assert!((near - distance).abs() <= tau, "{name}: {near:e} instead of {distance:e}");
        }
    }
}
