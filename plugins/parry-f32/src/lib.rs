#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use ocb_methods::parry::single::Parry;

opencollbench_plugin::export!(Parry: distance contacts counts);
