//! ocb-fast answers as every algorithm must, on each set of instructions, and counts.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_fast::Fast;
use opencollbench_plugin::{Collision, Counts, Pose};
use support::algorithm::{Terms, with};
use support::{Loaded, Soup};

algorithm!(Terms::exact(|| [16.0, 8.0, 1.0].map(|width| with::<Fast>(&[("width", width)])).into()));

#[test]
fn counts_a_query_by_hand() {
    // Two strips of five triangles: a root with two leaves each, of four triangles and of one.
    let soup = Soup {
        positions: (0..7).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.0]).collect(),
        triangles: (0..5).map(|i| [i, i + 1, i + 2]).collect(),
    };
    let mut fast = Loaded::<Fast>::new(&soup);
    let (mut tests_a, mut tests_b) = ([0; 5], [0; 5]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let mut above = Pose::IDENTITY;
    above.0[11] = 0.5;
    assert_eq!(fast.collide_counting(&Pose::IDENTITY, &above, &mut counts), Collision::Apart);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (4, 0));
    // Upright through y = 0.5, along x: crosses all.
    let upright = Pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.5, 0.0, 1.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1.0]);
    assert_ne!(fast.collide_counting(&Pose::IDENTITY, &upright, &mut counts), Collision::Apart);
    assert_eq!(counts.bv_tests, 8);
    assert_eq!(counts.primitive_tests, u64::from(counts.tests_a.iter().sum::<u32>()));
    assert_eq!(counts.tests_a.iter().sum::<u32>(), counts.tests_b.iter().sum::<u32>());
    // No plane separates any of four from any of four: they fill the lanes, and the first contact is among them.
    assert_eq!(counts.primitive_tests, 16);
}
