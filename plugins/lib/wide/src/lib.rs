#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![expect(clippy::needless_range_loop, reason = "kernels number axes, edges and lanes, of several arrays at once")]

pub mod fast;
mod local;
pub mod simdop;
mod wide;

pub use local::{Between, Local};
pub use wide::{Method, Pair, WIDTH, Wide};
