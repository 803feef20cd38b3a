#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod advice;
mod certificate;
mod choice;
mod cover;
mod detail;
mod errors;
mod ladder;
mod method;
mod point;
mod points;
mod proxy;
mod question;
mod scene;
mod share;
mod shelf;
mod stand_ins;
mod target;
mod timing;
mod watch;

pub use advice::{Advice, HeldOut, LevelFacts, Scene, advise};
pub use certificate::{Certificate, Doubt, Paper, VERSION};
pub use choice::Levels;
pub use detail::Detail;
pub use ladder::{Level, ladder, simplified};
pub use point::{Kind, Point, Unit};
pub use question::{Hybrid, Question, Told};
pub use scene::{CONFIGURATIONS, HELD_OUT, sample, usual_distances};
pub use share::Share;
pub use shelf::Shelf;
pub use stand_ins::LeftOut;
pub use timing::Measured;
pub use watch::{Unwatched, Watch};
