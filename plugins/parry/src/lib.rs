//! parry.
