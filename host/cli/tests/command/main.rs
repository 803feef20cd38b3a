//! The `ocb` binary, every command, good and bad.
//!
//! It starts the runner and asks plugins, so `cargo build --release` must have built them before; `make test` does so.

mod admin;
mod advise;
mod bench;
mod campaign;
mod data;
mod errors;
mod generate;
mod look;
mod record;
mod replay;
mod scene;
mod serve;
mod settings;
mod stability;
mod suite;
mod support;
mod truth;
