//! The plugin interface of OpenCollBench. The C headers in `include/` are the specification, [`raw`] is their mirror;
//! Rust authors implement [`Algorithm`] and call [`export!`].
//!
//! ```
//! use opencollbench_plugin::{About, Algorithm, Answer, Collision, Count, Mesh, Placed};
//!
//! /// Says that everything collides. Fast, and wrong.
//! #[derive(Default)]
//! struct Pessimist;
//!
//! impl Algorithm for Pessimist {
//!     const ABOUT: About = About { id: c"pessimist", name: c"Pessimist", ..About::new() };
//!     type Object = ();
//!     fn load_mesh(&mut self, _mesh: Mesh<'_>) -> Answer<()> {
//!         Ok(())
//!     }
//!     fn collide(&mut self, _a: Placed<'_, Self>, _b: Placed<'_, Self>, _work: &mut impl Count) -> Answer<Collision> {
//!         Ok(Collision::Somewhere)
//!     }
//! }
//!
//! opencollbench_plugin::export!(Pessimist);
//! ```

mod algorithm;
mod count;
#[doc(hidden)]
pub mod export;
#[cfg(feature = "layout")]
pub mod layout;
pub mod raw;

pub use algorithm::{
    About, Algorithm, Answer, Capability, Collision, ContactList, Contacts, Distance, Mesh, Parameter, Parameters,
    Placed, Pose, Query, Refusal, Scene, Separation,
};
pub use count::{Count, Counts, Uncounted};

/// The code in the guide compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
