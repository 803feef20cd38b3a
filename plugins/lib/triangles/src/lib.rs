#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod distance;
mod frame;
mod meet;
pub mod vector;

pub use distance::{Closest, distance, distance_below, segments};
pub use frame::{Frame, skew};
pub use meet::meet;

/// Three corners, in one frame with whatever it is compared with.
pub type Triangle = [vector::Vector; 3];
