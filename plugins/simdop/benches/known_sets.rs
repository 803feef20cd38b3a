//! Times on the known sets: `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-simdop`.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_simdop::SimDop;
use support::algorithm::with;

fn main() {
    support::timing::bench(
        &[
            ("simdop", || with::<SimDop>(&[])),
            ("simdop k = 26", || with(&[("k", 26.0)])),
            ("simdop AVX2", || with(&[("width", 8.0)])),
            ("simdop portable", || with(&[("width", 1.0)])),
        ],
        |object| Some(object.bytes()),
    );
}
