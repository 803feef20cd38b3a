//! The service over HTTP, with a real engine in a temporary folder.
//!
//! The engine starts the runner and asks plugins, so `cargo build --release` must have built them before; `make test`
//! does so.

mod advice;
mod errors;
mod lists;
mod objects;
mod pages;
mod people;
mod privacy;
mod publishing;
mod runs;
mod stream;
mod support;
mod things;
