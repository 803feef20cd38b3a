//! Files of every format: what is written is read back bit by bit, and no file makes the readers panic.
//!
//! A comparison with another reader on real files belongs beside these, in a module of its own.

mod peers;
mod round_trip;
mod truncated;
mod write;
