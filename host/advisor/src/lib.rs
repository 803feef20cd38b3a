#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod advice;
mod choice;
mod detail;
mod errors;
mod ladder;
mod method;
mod parts;
mod points;
mod proxy;
mod question;
mod scene;
mod stand_ins;
mod timing;
mod work;

pub use advice::{Scene, advise};
pub use ladder::{Level, ladder, simplified};
pub use question::{Hybrid, Told};
pub use scene::sample;
pub use work::work;
