//! box-tree answers as every algorithm must, and counts.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_box_tree::BoxTree;
use opencollbench_plugin::{Collision, Counts, Pose};
use support::algorithm::{Terms, with};
use support::{Loaded, Soup};

algorithm!(Terms::exact(|| [2.0, 1.0, 32.0].map(|size| with::<BoxTree>(&[("leaf_size", size)])).into()));

#[test]
fn counts_a_query_by_hand() {
    // Two triangles each, one leaf each: one box test finds the leaves apart or not, and four pairs of triangles follow.
    let soup = Soup {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [1, 3, 2]],
    };
    let mut tree = Loaded::<BoxTree>::new(&soup);
    let (mut tests_a, mut tests_b) = ([0; 2], [0; 2]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let mut above = Pose::IDENTITY;
    above.0[11] = 0.5;
    assert_eq!(tree.collide_counting(&Pose::IDENTITY, &above, &mut counts), Collision::Apart);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (1, 0));
    // Tilted about x through y = 0.5: the boxes meet; both triangles of B cross A.
    let tilted = Pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.5, 0.0, 1.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1.0]);
    assert_ne!(tree.collide_counting(&Pose::IDENTITY, &tilted, &mut counts), Collision::Apart);
    assert_eq!(counts.bv_tests, 2);
    assert_eq!(counts.primitive_tests, u64::from(counts.tests_a.iter().sum::<u32>()));
    assert_eq!(counts.tests_a.iter().sum::<u32>(), counts.tests_b.iter().sum::<u32>());
    assert!((1..=4).contains(&counts.primitive_tests));
}
