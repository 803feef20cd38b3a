#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod boxes;
pub mod fit;
mod leaves;
mod nearest;
mod plain;
mod query;
mod relative;
mod tree;
mod volume;

pub use boxes::Boxes;
pub use leaves::Leaves;
pub use nearest::Search;
pub use plain::{Method, Plain};
pub use query::{Open, Query};
pub use relative::{Relative, SHARE};
pub use tree::Tree;
pub use volume::{Hierarchy, Volume};
