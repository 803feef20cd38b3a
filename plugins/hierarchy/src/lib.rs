#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod fit;
mod nearest;
mod query;
mod relative;
mod tree;
mod volume;

pub use nearest::Search;
pub use query::{Open, Query};
pub use relative::{Relative, SHARE};
pub use tree::{Node, Tree};
pub use volume::Volume;
