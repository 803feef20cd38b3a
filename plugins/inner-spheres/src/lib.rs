#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use ocb_methods::inner_spheres::InnerSpheres;

opencollbench_plugin::export!(InnerSpheres: distance counts parameters);
