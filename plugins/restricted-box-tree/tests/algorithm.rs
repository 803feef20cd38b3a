//! restricted-box-tree answers as every algorithm must.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_restricted_box_tree::RestrictedBoxTree;
use support::algorithm::Terms;

algorithm!(Terms { stride: 100, ..Terms::exact(|| vec![RestrictedBoxTree::default()]) });
