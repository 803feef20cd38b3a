//! parry's triangle meshes: the same wrapper around the same library in both of its precisions.

pub mod double;
pub mod single;
