//! Scalars become colours.
