//! Box tree.
