#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use ocb_methods::convex_parts::ConvexParts;

opencollbench_plugin::export!(ConvexParts: distance counts parameters);
