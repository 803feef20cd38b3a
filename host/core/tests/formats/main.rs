//! Files of every format: what is written is read back bit by bit, and no file makes the readers panic.

mod peers;
mod robots;
mod round_trip;
mod truncated;
mod write;
