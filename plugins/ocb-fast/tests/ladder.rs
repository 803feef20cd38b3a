//! No luck: answers at every gap of the ladder do not depend on the instructions, the unit, the place, winding or order.

#[path = "../../common/tests/support/mod.rs"]
mod support;

use ocb_fast::Fast;
use opencollbench_plugin::{Collision, Parameters, Pose};
use support::{Dice, Loaded, Reference, Soup, tau};

/// Shares of the size; the last one stands for twice the tolerance of double precision.
const GAPS: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1.5e-14];

fn with_width(soup: &Soup, width: f64) -> Loaded<Fast> {
    let mut fast = Fast::default();
    fast.set("width", width).expect("the parameter exists");
    Loaded::with(fast, soup)
}

/// Poses of B in front of A at every gap of the ladder, and the same way behind the first touch.
fn ladder(soup: &Soup, dice: &mut Dice) -> (Pose, Vec<(f64, Pose)>) {
    let mut fast = Loaded::<Fast>::new(soup);
    let (pose_a, start) = (dice.pose(0.3), dice.pose(4.0));
    let near = fast.distance(&pose_a, &start);
    let [on_a, on_b] = near.points.expect("points");
    let steps = GAPS.iter().flat_map(|&gap| [gap, -gap]);
    let poses = steps.map(|gap| {
        let mut pose = start;
        for (k, axis) in [3, 7, 11].into_iter().enumerate() {
            pose.0[axis] += (on_a[k] - on_b[k]) * (1.0 - gap / near.distance);
        }
        (gap, pose)
    });
    (pose_a, poses.collect())
}

#[test]
fn at_every_gap_on_all_instructions() {
    let soup = Soup::torus(14, 8);
    let reference = Reference(&soup);
    let (mut dice, mut hits) = (Dice(21), 0);
    for _ in 0..6 {
        let (pose_a, poses) = ladder(&soup, &mut dice);
        for (gap, pose) in poses {
            let (contacts, distance) = (reference.contacts(&pose_a, &pose), reference.distance(&pose_a, &pose));
            let tau = tau(&soup, &pose);
            assert!(gap < 0.0 || contacts.is_empty() && (distance - gap).abs() <= tau, "the ladder's step {gap}");
            hits += usize::from(!contacts.is_empty());
            for width in [1.0, 8.0, 16.0] {
                let mut fast = with_width(&soup, width);
                assert_eq!(fast.contacts(&pose_a, &pose), contacts, "at {gap}, width {width}");
                assert_eq!(fast.collide(&pose_a, &pose) == Collision::Apart, contacts.is_empty());
                let near = fast.distance(&pose_a, &pose).distance;
                assert!((near - distance).abs() <= tau, "{near} instead of {distance} at {gap}, width {width}");
            }
        }
    }
    assert!(hits >= 24, "only {hits} of 36 steps behind the first touch collide");
}

/// Scaling by a power of two is free of error: all answers must scale with it exactly.
#[test]
fn in_every_unit() {
    let soup = Soup::torus(14, 8);
    let (pose_a, poses) = ladder(&soup, &mut Dice(22));
    let mut here = Loaded::<Fast>::new(&soup);
    for exponent in [-300, -60, -20, -3, 10, 40, 300] {
        let unit = 2f64.powi(exponent);
        let scaled = |pose: &Pose| {
            let mut pose = *pose;
            for axis in [3, 7, 11] {
                pose.0[axis] *= unit;
            }
            pose
        };
        let positions = soup.positions.iter().map(|p| p.map(|x| x * unit)).collect();
        let mut there = Loaded::<Fast>::new(&Soup { positions, triangles: soup.triangles.clone() });
        for (gap, pose) in &poses {
            let contacts = here.contacts(&pose_a, pose);
            assert_eq!(there.contacts(&scaled(&pose_a), &scaled(pose)), contacts, "at {gap}, unit 2^{exponent}");
            // Squares of lengths, and volumes, must be numbers.
            if exponent.abs() < 100 {
                let (near, expected) = (there.distance(&scaled(&pose_a), &scaled(pose)), here.distance(&pose_a, pose));
                assert_eq!(near.distance / unit, expected.distance, "at {gap}, unit 2^{exponent}");
            }
        }
    }
}

/// Other units round the mesh and the poses, and so does a place far from the object's origin; then only the size of the
/// numbers counts.
#[test]
fn in_odd_units_and_far_from_the_origin() {
    let soup = Soup::torus(14, 8);
    for (unit, offset) in [(1e-3, 0.0), (1e6 / 3.0, 0.0), (1.0, 100.0), (0.7, 1e4), (1e-6, 1.0)] {
        let positions = soup.positions.iter().map(|p| p.map(|x| x * unit + offset)).collect();
        let moved = Soup { positions, triangles: soup.triangles.clone() };
        let reference = Reference(&moved);
        let mut fast = Loaded::<Fast>::new(&moved);
        let (pose_a, poses) = ladder(&soup, &mut Dice(23));
        for (gap, pose) in poses {
            // Turning about the old origin: t + R o becomes the translation of the moved object.
            let adapted = |pose: &Pose| {
                let mut moved = *pose;
                let r = pose.rotation();
                for (k, axis) in [3, 7, 11].into_iter().enumerate() {
                    moved.0[axis] = pose.0[axis] * unit - (r[k][0] + r[k][1] + r[k][2]) * offset;
                }
                moved
            };
            let (pose_a, pose) = (adapted(&pose_a), adapted(&pose));
            let tau = tau(&moved, &pose) + tau(&moved, &pose_a);
            if gap.abs() * unit > tau {
                let contacts = reference.contacts(&pose_a, &pose);
                assert_eq!(fast.contacts(&pose_a, &pose), contacts, "{unit} {offset} at {gap}");
            }
            let (near, expected) = (fast.distance(&pose_a, &pose).distance, reference.distance(&pose_a, &pose));
            assert!((near - expected).abs() <= tau, "{near} instead of {expected}");
        }
    }
}

#[test]
fn whatever_the_winding_and_the_order() {
    let soup = Soup::torus(14, 8);
    let count = soup.triangles.len() as u32;
    let turned = soup.triangles.iter().rev().enumerate().map(|(i, &[a, b, c])| match i % 3 {
        0 => [a, c, b],
        1 => [b, c, a],
        _ => [c, b, a],
    });
    let turned = Soup { positions: soup.positions.clone(), triangles: turned.collect() };
    let (mut fast, mut other) = (Loaded::<Fast>::new(&soup), Loaded::<Fast>::new(&turned));
    let mut dice = Dice(24);
    for _ in 0..6 {
        let (pose_a, poses) = ladder(&soup, &mut dice);
        for (gap, pose) in poses {
            let mut contacts = other.contacts(&pose_a, &pose);
            contacts.iter_mut().for_each(|(a, b)| (*a, *b) = (count - 1 - *a, count - 1 - *b));
            contacts.sort_unstable();
            assert_eq!(contacts, fast.contacts(&pose_a, &pose), "at {gap}");
            let (near, expected) = (other.distance(&pose_a, &pose).distance, fast.distance(&pose_a, &pose).distance);
            assert!((near - expected).abs() <= tau(&soup, &pose));
        }
    }
}
