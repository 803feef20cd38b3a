#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use ocb_methods::parry::double::Parry as Double;
pub use ocb_methods::parry::single::Parry as Single;

opencollbench_plugin::export!(Double: distance contacts counts scene, Single: distance contacts counts scene);
