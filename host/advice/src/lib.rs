//! What the advisor is asked and what it says, and certificates of levels of detail.
//!
//! The work itself is in `host/advisor`, a program that links libraries of others and runs in the jail. This crate links none,
//! so the service, the command and the values of the API are built from it alone.
#![forbid(unsafe_code)]

mod advice;
mod certificate;
mod cover;
mod point;
mod question;
mod share;
mod target;
mod watch;
pub mod work;

pub use advice::{Advice, Detail, HeldOut, LeftOut, LevelFacts, Levels, Measured};
pub use certificate::{Certificate, Doubt, Paper, VERSION};
pub use point::{Kind, Point, Unit};
pub use question::{CONFIGURATIONS, HELD_OUT, Question, usual_distances};
pub use share::Share;
pub use watch::{Unwatched, Watch};
