//! dop-tree answers as every algorithm must, with every k.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_dop_tree::DopTree;
use opencollbench_plugin::Parameters;
use support::algorithm::{Terms, with};

algorithm!(Terms::exact(|| [18.0, 6.0, 14.0, 26.0].map(|k| with::<DopTree>(&[("k", k)])).into()));

#[test]
fn a_k_that_is_none_is_refused() {
    assert!(DopTree::default().set("k", 8.0).is_err());
}
