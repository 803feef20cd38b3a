#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use ocb_methods::voxmap_pointshell::VoxmapPointshell;

opencollbench_plugin::export!(VoxmapPointshell: counts parameters);
