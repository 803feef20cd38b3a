//! obb-tree answers as every algorithm must.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_obb_tree::ObbTree;
use support::algorithm::Terms;

algorithm!(Terms::exact(|| vec![ObbTree::default()]));
