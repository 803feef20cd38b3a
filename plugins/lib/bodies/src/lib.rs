#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod body;
mod gjk;
mod simplex;
mod surface;
mod vertices;

pub use body::{Body, Side, TOLERANCE};
pub use gjk::{Found, Pair};
pub use surface::Surface;
pub use vertices::Vertices;
