//! The slow trusted answer.
