//! Runs, queue, store and registry: everything between a request and its heatmap.

pub mod model;
