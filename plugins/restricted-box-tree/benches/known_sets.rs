//! Times on the known sets: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-restricted-box-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_restricted_box_tree::RestrictedBoxTree;

fn main() {
    support::timing::bench(&[("restricted-box-tree", RestrictedBoxTree::default)], |_| None);
}
