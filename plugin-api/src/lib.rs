//! The plugin interface of OpenCollBench: the C headers in `include/` are the specification, [`raw`] is their mirror.

#[cfg(feature = "layout")]
pub mod layout;
pub mod raw;
