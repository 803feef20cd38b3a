#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![expect(clippy::duplicate_mod, reason = "parry's wrapper is one source for two precisions")]

pub mod convex_parts;
pub mod inner_spheres;
pub mod parry;
pub mod voxmap_pointshell;
