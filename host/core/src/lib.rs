//! The domain of OpenCollBench, pure: same input, same output.
//!
//! Nothing here does I/O, starts a process, reads a clock or knows a plugin. Its only threads are those of rayon, and they change
//! no result. The words are those of `GLOSSARY.md`.
#![forbid(unsafe_code)]

// Pairs of triangles that make trouble are drawn by one file, for the tests in here and for those that see the crate
// from outside.
#[cfg(test)]
extern crate self as ocb_core;

pub mod agreement;
pub mod bvh;
pub mod colormap;
pub mod comparison;
pub mod configuration;
pub mod export;
pub mod guessing;
pub mod heatmap;
pub mod instance;
pub mod lod;
pub mod mesh;
pub mod numbers;
pub mod oracle;
pub mod pose;
pub mod query;
pub mod record;
pub mod reduce;
pub mod resolution;
pub mod sampling;
pub mod scene;
pub mod selection;
pub mod sequential;
pub mod statistics;
pub mod stock;
pub mod units;
pub mod validation;
pub mod workload;
pub mod xml;
