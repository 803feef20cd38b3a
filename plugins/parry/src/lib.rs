#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod counted;
mod wrapper;

use opencollbench_plugin::About;
use parry3d_f64 as parry;
pub use wrapper::Parry;

const ABOUT: About = About {
    id: c"parry",
    name: c"parry",
    version: c"0.31.1",
    authors: c"S\xc3\xa9bastien Crozet and the parry contributors; wrapped by the OpenCollBench contributors",
    license: c"Apache-2.0",
    url: c"https://parry.rs",
    ..About::new()
};

opencollbench_plugin::export!(Parry: distance contacts counters);

/// From the interface's precision to parry's.
fn narrow(x: f64) -> parry::math::Real {
    x
}

/// And back.
fn widen(x: parry::math::Real) -> f64 {
    x
}
