//! The jailed process.
fn main() {}
