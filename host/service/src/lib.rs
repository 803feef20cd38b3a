//! Runs, queue, store and registry: everything between a request and its heatmap.
//!
//! One handle, [`Engine`], serves the web server and the command line alike; its values ([`ocb_model`]) are the JSON of both.
#![forbid(unsafe_code)]

mod accounts;
mod advice;
mod attempts;
mod audit;
pub mod backup;
mod blobs;
mod blocking;
pub mod board;
mod cache;
mod campaigns;
mod charts;
mod citations;
mod classes;
mod config;
mod engine;
mod error;
mod examples;
pub mod figures;
mod house;
mod idle;
mod locks;
mod machines;
#[cfg_attr(not(feature = "mail"), allow(dead_code))]
mod mail;
mod notices;
mod objects;
mod open;
mod owned;
mod parts;
mod plugins;
mod quotas;
mod rate_limits;
mod requests;
mod results;
mod runs;
mod sets;
mod stability;
mod store;
pub mod suite;
mod tasks;
mod time_limit;
mod visibility;
mod workloads;

/// An asynchronous function whose future comes in a box. All that others call are such: the machine behind a future is
/// compiled where it is polled, and so the whole engine once more for every program around it.
pub(crate) use async_recursion::async_recursion as boxed;
pub use config::{Ceilings, EngineConfig, Profile, SlurmJobs};
pub use ocb_lab::{LabError, sha256_hex};
use ocb_lab::{columns, configurations, machine, measure, replay};

pub use accounts::SESSION;
pub use board::ask::board_csv;
pub use campaigns::campaign_csv;
pub use charts::ask::{chart_csv, chart_parquet};
pub use engine::Engine;
pub use error::{EngineError, Result};
pub use machines::Handing;
pub use mail::{MailServer, Pace};
pub use ocb_chart as chart;
pub use ocb_lab::advisor as advising;
pub use ocb_lab::algorithm::Runner;
pub use ocb_lab::check::Extent;
pub use ocb_lab::measure::Stop;
pub use ocb_lab::recording::{self, Recording};
pub use ocb_lab::replay::Unpacked;
pub use ocb_lab::stability::Selection as StabilitySelection;
pub use ocb_lab::worker;
pub use ocb_lab::{reduce, scene_file, scene_import, truth, workload};
pub use ocb_model as model;
pub use ocb_sandbox::{doctor, given};
pub use owned::archive::Contents;
pub use plugins::MAX_PLUGIN_BYTES;
pub use quotas::Visitor;
pub use rate_limits::RateLimit;
pub use requests::Made;
pub use sets::SetJob;
pub use sets::saved::MAX_CONFIGURATION_BYTES;
pub use time_limit::in_time;
