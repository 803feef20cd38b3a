//! Times on the known sets: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-sphere-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_sphere_tree::SphereTree;

fn main() {
    support::timing::bench(&[("sphere-tree", SphereTree::default)], |_| None);
}
