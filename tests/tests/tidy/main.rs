//! The invariants of ARCHITECTURE.md that reading the repository can check.

mod counting;
mod cycles;
mod files;
mod floors;
mod licences;
mod plugins;
mod sources;
