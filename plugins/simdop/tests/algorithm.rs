//! SIMDop answers as every algorithm must, with each set of directions and of instructions, and counts.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_simdop::SimDop;
use opencollbench_plugin::{Collision, Counts, Pose};
use support::algorithm::{Terms, with};
use support::{Loaded, Soup};

algorithm!(Terms::exact(|| {
    [(18.0, 16.0), (6.0, 16.0), (14.0, 8.0), (26.0, 1.0)]
        .map(|(k, width)| with::<SimDop>(&[("k", k), ("width", width)]))
        .into()
}));

#[test]
fn counts_a_query_by_hand() {
    // Two triangles in a root: its DOP against each, then one that is left against both.
    let soup = Soup {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [5., 0., 0.], [6., 0., 0.], [5., 1., 0.]],
        triangles: vec![[0, 1, 2], [3, 4, 5]],
    };
    let mut simdop = Loaded::<SimDop>::new(&soup);
    let (mut tests_a, mut tests_b) = ([0; 2], [0; 2]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let mut above = Pose::IDENTITY;
    above.0[11] = 0.5;
    assert_eq!(simdop.collide_counting(&Pose::IDENTITY, &above, &mut counts), Collision::Apart);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (2, 0));
    // The second of B lies on the first of A; the first of B is far away.
    let mut aside = Pose::IDENTITY;
    aside.0[3] = -5.0;
    assert_eq!(simdop.collide_counting(&Pose::IDENTITY, &aside, &mut counts), Collision::Pair(0, 1));
    assert_eq!((counts.bv_tests, counts.primitive_tests), (2 + 2 + 2, 1));
    assert_eq!((counts.tests_a, counts.tests_b), (&mut [1, 0][..], &mut [0, 1][..]));
}
