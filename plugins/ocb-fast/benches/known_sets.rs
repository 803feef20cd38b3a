//! Times on the known sets, on each set of instructions: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-fast`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_fast::Fast;
use support::algorithm::with;

fn main() {
    support::timing::bench(
        &[
            ("ocb-fast AVX-512", || with::<Fast>(&[("width", 16.0)])),
            ("ocb-fast AVX2", || with(&[("width", 8.0)])),
            ("ocb-fast portable", || with(&[("width", 1.0)])),
        ],
        |object| Some(object.bytes()),
    );
}
