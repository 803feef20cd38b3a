#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod balls;
mod closed;
mod lattice;
mod nearest;
mod samples;

pub use balls::{Ball, BallNode, BallTree};
pub use closed::odd_edges;
pub use lattice::{Bounds, Lattice, inside};
pub use nearest::{Nearest, point_to_triangle};
pub use samples::cover;
