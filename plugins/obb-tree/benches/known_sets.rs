//! Times on the known sets: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-obb-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_obb_tree::ObbTree;

fn main() {
    support::timing::bench(&[("obb-tree", ObbTree::default)], |_| None);
}
