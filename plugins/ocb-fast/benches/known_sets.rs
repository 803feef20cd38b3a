//! ocb-fast on the known sets, on each set of instructions; arguments are the names of meshes to try instead.
//!
//! `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-fast`, beside `cargo bench -p ocb-box-tree` as a peer.

#[path = "../../common/tests/support/mod.rs"]
mod support;
#[path = "../../common/tests/support/timing.rs"]
mod timing;

use ocb_fast::Fast;
use opencollbench_plugin::Parameters;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    for (name, width) in [("AVX-512", 16.0), ("AVX2", 8.0), ("portable", 1.0)] {
        let make = || {
            let mut fast = Fast::default();
            fast.set("width", width).expect("the parameter exists");
            fast
        };
        let meshes = if asked.is_empty() { &timing::MESHES } else { &asked[..] };
        timing::table(&format!("ocb-fast {name}"), meshes, make, |mesh| Some(mesh.bytes()));
    }
    if asked.is_empty() {
        timing::table("ocb-fast", &timing::LADDER, Fast::default, |mesh| Some(mesh.bytes()));
    }
}
