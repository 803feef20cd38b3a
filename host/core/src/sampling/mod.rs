//! How configurations are found.

mod approach;
mod low_discrepancy;
mod paper_pattern;
pub mod sphere;
mod window;
