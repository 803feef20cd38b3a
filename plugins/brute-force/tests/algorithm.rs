//! brute-force answers as every algorithm must: its boxes leave nothing out.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_brute_force::BruteForce;
use opencollbench_plugin::{Counts, Pose};
use support::algorithm::Terms;
use support::{Loaded, Soup};

algorithm!(Terms { stride: 500, ..Terms::exact(|| vec![BruteForce]) });

#[test]
fn counts_a_query_by_hand() {
    // Four triangles against four, in one place: 8 boxes against the other object's, then 4 x 4 boxes, but the query
    // ends with the first pair, which is the first triangle and itself.
    let soup = Soup::scraps();
    let mut counts = Counts::default();
    let pose = Pose::IDENTITY;
    Loaded::<BruteForce>::new(&soup).collide_counting(&pose, &pose, &mut counts);
    assert_eq!((counts.bv_tests, counts.primitive_tests), (8 + 4, 1));
}
