//! obb-tree answers as every contestant must.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_obb_tree::ObbTree;
use support::contestant::Terms;

contestant!(Terms::exact(|| vec![ObbTree::default()]));
