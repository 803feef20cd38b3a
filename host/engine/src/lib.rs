//! Runs, queue, store and registry: everything between a request and its heatmap.
//!
//! One handle, [`Engine`], serves the web server and the command line alike; its values ([`model`]) are the JSON of both.

mod config;
mod engine;
mod error;
pub mod model;

pub use config::EngineConfig;
pub use engine::Engine;
pub use error::{EngineError, Result};
