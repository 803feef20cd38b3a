//! The culling hierarchy of oracle and sampling.
