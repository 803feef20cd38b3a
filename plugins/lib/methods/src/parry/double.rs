//! parry in f64.

#[path = "counted.rs"]
mod counted;
#[path = "wrapper.rs"]
mod wrapper;

use opencollbench_plugin::About;
use parry3d_f64 as library;
pub use wrapper::Parry;

const ABOUT: About = About {
    // `make plugins-native` compiles it once more, for this CPU.
    id: if option_env!("OCB_VARIANT").is_some() { c"parry-native" } else { c"parry" },
    name: if option_env!("OCB_VARIANT").is_some() { c"parry-native" } else { c"parry" },
    version: c"0.31.1",
    authors: c"S\xc3\xa9bastien Crozet and the parry contributors; wrapped by the OpenCollBench contributors",
    license: c"Apache-2.0",
    url: c"https://parry.rs",
    ..About::new()
};

/// From the interface's precision to parry's.
fn narrow(x: f64) -> library::math::Real {
    x
}

/// And back.
fn widen(x: library::math::Real) -> f64 {
    x
}
