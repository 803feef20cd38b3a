//! Runs one plugin in a jailed process and measures it from outside.
//!
//! The threat model, the layers in their order and the limits stand in `sandbox/README.md`. The way of a trial:
//! [`Launcher::start`] -> a jail with a runner that has closed itself off -> the look from outside -> the plugin is
//! loaded, the objects are built -> [`Session::pass`] or single questions -> [`Session::finish`].

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
compile_error!("the jail is written for Linux on x86-64: its system call list and floating-point care are per machine");

mod brought;
pub mod clock;
#[doc(hidden)]
pub mod confine;
#[doc(hidden)]
pub mod control;
mod cpus;
pub mod descriptor;
pub mod doctor;
#[doc(hidden)]
pub mod doorbell;
mod evidence;
mod exchange;
pub mod gate;
pub mod given;
#[doc(hidden)]
pub mod inside;
pub mod integrity;
pub mod launch;
pub mod launcher;
pub mod layers;
mod memory;
mod null;
mod opened;
pub mod outcome;
pub mod pass;
pub mod policy;
#[doc(hidden)]
pub mod protocol;
pub mod question;
#[doc(hidden)]
pub mod seccomp;
pub mod session;
#[doc(hidden)]
pub mod shared;
mod speed;
pub mod text;
#[doc(hidden)]
pub mod trial;
mod usage;
mod verify;
pub mod work;

pub use clock::{ClockFacts, ClockKind};
pub use descriptor::{Descriptor, Parameter};
pub use gate::{Build, Facts, Inspection, Rejection};
pub use launch::Killer;
pub use launcher::{Launcher, Objects, Trial};
pub use layers::Profile;
pub use outcome::{DeniedCall, Ending, Outcome, Phase};
pub use pass::{Batched, Observation, PassFacts, PassPlan, Time};
pub use policy::{ClockChoice, Policy};
pub use protocol::MAX_BATCH;
pub use question::Question;
pub use session::{Batch, Sample, Session, SetUp};
