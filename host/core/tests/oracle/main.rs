//! The proof of the oracle, by ways that share nothing with it: integers over all simplices of nine differences
//! (`common::reference`), CGAL's exact kernel, listed answers, all pairs instead of a hierarchy, and relations that hold
//! whatever the answer. `tests/oracle-check/faults.toml` lists faults that these tests must find.

#[path = "../common/mod.rs"]
mod common;

mod brute_force;
mod cgal;
mod extremes;
mod margins;
mod meshes;
mod pairs;
mod relations;
mod rounding;
mod stability;
