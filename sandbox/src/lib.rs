//! Runs one plugin in a jailed process and measures it from outside.
//!
//! The threat model, the layers in their order and the limits stand in `sandbox/README.md`.

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
compile_error!("the jail is written for Linux on x86-64: its system call list and floating-point care are per machine");

pub mod descriptor;
pub mod outcome;
pub mod policy;
pub mod session;

pub use descriptor::{Descriptor, Parameter};
pub use outcome::{Ending, Outcome, Phase};
pub use policy::{ClockChoice, Policy};
pub use session::{ClockFacts, ClockKind, Killer, Launcher, Sample, Session, Trial};
