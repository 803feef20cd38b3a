//! What the tests and benches of the plugins share. Included by path, so each uses a part of it.
#![allow(dead_code, unused_imports, unused_macros, reason = "each test binary uses a part")]

#[macro_use]
pub mod algorithm;
pub mod convex;
pub mod extremes;
pub mod known;
pub mod ladder;
mod loaded;
mod scene;
mod soup;
pub mod timing;

pub use known::{known_mesh, known_poses, known_set, shared_file};
pub use loaded::Loaded;
pub use scene::{Scene, Truth};
pub use soup::{Dice, Soup, TRANSLATION, apply};
