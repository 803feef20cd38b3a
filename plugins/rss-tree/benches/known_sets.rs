//! Times on the known sets, depth first and nearest first: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-rss-tree`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_rss_tree::RssTree;
use support::algorithm::with;

fn main() {
    support::timing::bench(
        &[("rss-tree", RssTree::default), ("rss-tree queue", || with(&[("queue_size", 1e6)]))],
        |_| None,
    );
}
