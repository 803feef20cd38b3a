//! What the tests of the whole house share: where things are, the `ocb` command, a running service.

pub mod place;
pub mod postgres;
pub mod process;
pub mod seaweed;
pub mod service;
pub mod wire;
