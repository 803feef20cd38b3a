//! No luck: answers at every gap of the ladder do not depend on the unit, the place, the winding or the order.

use opencollbench_plugin::{Contacts, Distance, Pose};

use super::algorithm::{Terms, agree};
use super::{Dice, Loaded, Scene, Soup, TRANSLATION};

/// Shares of the size; the last one stands for twice the tolerance of double precision.
const GAPS: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0];

/// Poses of B in front of A at every gap of the ladder that the algorithm can see, and the same way behind the first
/// touch.
fn ladder<'s, A: Distance>(terms: &Terms<A>, soup: &'s Soup, dice: &mut Dice) -> Vec<(f64, Scene<'s>)> {
    let mut loaded = Loaded::with((terms.variants)().swap_remove(0), soup);
    let start = Scene::of(soup, dice.pose(0.3), dice.pose(4.0));
    let near = loaded.distance(&start.pose_a, &start.pose_b);
    let [on_a, on_b] = near.points.expect("points");
    let gaps = GAPS.map(|gap| if gap > 0.0 { gap } else { 2.0 * start.tau() });
    let steps = gaps.into_iter().filter(|gap| *gap > 2.0 * terms.blur).flat_map(|gap| [gap, -gap]);
    let scenes = steps.map(|gap| {
        let mut scene = start;
        for (k, axis) in TRANSLATION.into_iter().enumerate() {
            scene.pose_b.0[axis] += (on_a[k] - on_b[k]) * (1.0 - gap / near.distance);
        }
        (gap, scene)
    });
    scenes.collect()
}

pub fn at_every_gap<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(14, 8);
    let mut variants = terms.load(&soup);
    let (mut dice, mut behind, mut hits) = (Dice(21), 0, 0);
    for _ in 0..6 {
        for (gap, scene) in ladder(terms, &soup, &mut dice) {
            let truth = scene.truth();
            if gap > 0.0 {
                let off = (truth.distance - gap).abs();
                assert!(truth.contacts.is_empty() && off <= scene.tau() + terms.blur, "the ladder's step {gap}");
            } else {
                behind += 1;
                hits += usize::from(!truth.contacts.is_empty());
            }
            variants.iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
        }
    }
    assert!(3 * hits >= 2 * behind, "only {hits} of {behind} steps behind the first touch collide");
}

/// Scaling by a power of two is free of error: all answers must scale with it.
pub fn in_every_unit<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(14, 8);
    let scenes = ladder(terms, &soup, &mut Dice(22));
    let mut here = terms.load(&soup);
    for exponent in [-300, -60, -20, -3, 10, 40, 300] {
        let unit = 2f64.powi(exponent);
        let mut there = terms.load(&soup.moved(unit, 0.0));
        for (gap, scene) in &scenes {
            let [far_a, far_b] = [scene.pose_a, scene.pose_b].map(|mut pose| {
                TRANSLATION.iter().for_each(|&axis| pose.0[axis] *= unit);
                pose
            });
            for (here, there) in here.iter_mut().zip(&mut there) {
                let contacts = here.contacts(&scene.pose_a, &scene.pose_b);
                assert_eq!(there.contacts(&far_a, &far_b), contacts, "at {gap}, unit 2^{exponent}");
                // Squares of lengths, and volumes, must be numbers.
                if exponent.abs() < 100 {
                    let near = there.distance(&far_a, &far_b).distance / unit;
                    let expected = here.distance(&scene.pose_a, &scene.pose_b).distance;
                    let off = (near - expected).abs();
                    assert!(off <= scene.tau() + terms.blur, "{near} and {expected} at {gap}, unit 2^{exponent}");
                }
            }
        }
    }
}

/// Other units round the mesh and the poses, and so does a place far from the object's origin; then only the size of the
/// numbers counts.
pub fn in_odd_units_and_places<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(14, 8);
    let scenes = ladder(terms, &soup, &mut Dice(23));
    for (unit, offset) in [(1e-3, 0.0), (1e6 / 3.0, 0.0), (1.0, 100.0), (0.7, 1e4), (1e-6, 1.0)] {
        let moved = soup.moved(unit, offset);
        let mut variants = terms.load(&moved);
        // Turning about the old origin: t + R o becomes the translation of the moved object.
        let adapted = |pose: &Pose| {
            let (mut moved, r) = (*pose, pose.rotation());
            for (k, axis) in TRANSLATION.into_iter().enumerate() {
                moved.0[axis] = pose.0[axis] * unit - (r[k][0] + r[k][1] + r[k][2]) * offset;
            }
            moved
        };
        for (_, scene) in &scenes {
            let scene = Scene::of(&moved, adapted(&scene.pose_a), adapted(&scene.pose_b));
            let truth = scene.truth();
            variants.iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
        }
    }
}

pub fn whatever_the_winding_and_the_order<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(14, 8);
    let turned = soup.triangles.iter().rev().enumerate().map(|(i, &[a, b, c])| match i % 3 {
        0 => [a, c, b],
        1 => [b, c, a],
        _ => [c, b, a],
    });
    let turned = Soup { positions: soup.positions.clone(), triangles: turned.collect() };
    let mut variants = terms.load(&turned);
    let mut dice = Dice(24);
    for _ in 0..3 {
        for (_, scene) in ladder(terms, &soup, &mut dice) {
            let mut truth = scene.truth();
            let last = soup.triangles.len() as u32 - 1;
            truth.contacts.iter_mut().for_each(|(a, b)| (*a, *b) = (last - *a, last - *b));
            truth.contacts.sort_unstable();
            let scene = Scene::of(&turned, scene.pose_a, scene.pose_b);
            variants.iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
        }
    }
}
