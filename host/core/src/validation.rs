//! Answers compared with the oracle.
