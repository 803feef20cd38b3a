//! Times on the known sets: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-box-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_box_tree::BoxTree;

fn main() {
    support::timing::bench(&[("box-tree", BoxTree::default)], |_| None);
}
