//! Times on the known sets, for every k: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-dop-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_dop_tree::DopTree;
use support::algorithm::with;

fn main() {
    support::timing::bench(
        &[
            ("dop-tree 6", || with::<DopTree>(&[("k", 6.0)])),
            ("dop-tree 14", || with(&[("k", 14.0)])),
            ("dop-tree 18", || with(&[("k", 18.0)])),
            ("dop-tree 26", || with(&[("k", 26.0)])),
        ],
        |_| None,
    );
}
