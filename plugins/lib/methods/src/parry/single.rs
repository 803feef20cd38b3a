//! parry in f32.

#[path = "counted.rs"]
mod counted;
#[path = "wrapper.rs"]
mod wrapper;

use opencollbench_plugin::{About, Capability};
use parry3d as library;
pub use wrapper::Parry;

const ABOUT: About = About {
    // `make plugins-native` compiles it once more, for this CPU.
    id: if option_env!("OCB_VARIANT").is_some() { c"parry-f32-native" } else { c"parry-f32" },
    name: if option_env!("OCB_VARIANT").is_some() {
        c"parry, single precision-native"
    } else {
        c"parry, single precision"
    },
    version: c"0.31.1",
    authors: c"S\xc3\xa9bastien Crozet and the parry contributors; wrapped by the OpenCollBench contributors",
    license: c"Apache-2.0",
    url: c"https://parry.rs",
    capabilities: &[Capability::SinglePrecision],
    ..About::new()
};

/// From the interface's precision to parry's.
fn narrow(x: f64) -> library::math::Real {
    x as library::math::Real
}

/// And back.
fn widen(x: library::math::Real) -> f64 {
    f64::from(x)
}
