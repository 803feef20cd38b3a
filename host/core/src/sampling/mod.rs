//! Finding configurations.
