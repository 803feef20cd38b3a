//! box-tree on the known sets, as a peer for others; arguments are the names of meshes to try instead.
//!
//! `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-box-tree`

#[path = "../../common/tests/support/mod.rs"]
mod support;
#[path = "../../common/tests/support/timing.rs"]
mod timing;

use ocb_box_tree::BoxTree;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    let meshes = if asked.is_empty() { &[timing::MESHES.as_slice(), &timing::LADDER].concat() } else { &asked };
    timing::table("box-tree", meshes, BoxTree::default, |_| None);
}
