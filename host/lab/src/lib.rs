//! What measures and checks: algorithms in the jail, their times, their answers, and the files in which these are kept.
//!
//! It knows no store, no account and nothing of HTTP, so that a machine that only measures can be built from it.
#![forbid(unsafe_code)]

pub mod advisor;
pub mod algorithm;
pub mod check;
pub mod columns;
pub mod configurations;
mod error;
pub mod job;
pub mod machine;
pub mod measure;
pub mod mesh_file;
pub mod pairing;
pub mod recording;
pub mod reduce;
pub mod replay;
mod repro;
pub mod scene_file;
pub mod scene_import;
pub mod stability;
pub mod table;
pub mod truth;
pub mod worker;
pub mod workload;

use std::time::{SystemTime, UNIX_EPOCH};

use ocb_model as model;
use sha2::{Digest, Sha256};

pub use error::{LabError, Result};

/// SHA-256 in lower-case hex.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Microseconds since the Unix epoch.
pub fn now_us() -> i64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_micros() as i64)
}
