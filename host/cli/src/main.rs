//! The ocb command.
fn main() {}
